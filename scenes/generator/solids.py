# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Closed solids as (positions, triangles), and the meshes with attributes made from them."""

import math

SNAP = 1 << 20  # positions are rounded to 1/SNAP m: the same bytes from any C library


class Mesh:
    """What a glTF primitive holds. Optional attributes are empty."""

    def __init__(self, positions, triangles, normals=(), uvs=(), colours=(), tangents=()):
        self.positions, self.triangles = positions, triangles
        self.normals, self.uvs, self.colours = normals, uvs, colours
        self.tangents = tangents


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def unit(v):
    length = math.sqrt(dot(v, v))
    return (v[0] / length, v[1] / length, v[2] / length)


def volume(solid):
    """Signed volume: positive where the triangles are counter-clockwise from outside."""
    positions, triangles = solid
    return math.fsum(dot(positions[a], cross(positions[b], positions[c]))
                     for a, b, c in triangles) / 6.0


def is_closed(triangles):
    """Whether every directed edge has exactly one partner the other way round."""
    edges = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
    return len(set(edges)) == len(edges) and {(b, a) for a, b in edges} == set(edges)


def snapped(solid):
    """Rounds and welds positions, drops triangles that collapse, turns the outside out."""
    index, positions, remap = {}, [], []
    for p in solid[0]:
        p = tuple(round(c * SNAP) / SNAP + 0.0 for c in p)
        remap.append(index.setdefault(p, len(positions)))
        if remap[-1] == len(positions):
            positions.append(p)
    triangles = [tuple(remap[i] for i in t) for t in solid[1]]
    triangles = [t for t in triangles if len(set(t)) == 3]
    if not is_closed(triangles):
        raise ValueError("a solid of the gallery has an open edge")
    if volume((positions, triangles)) < 0.0:
        triangles = [(a, c, b) for a, b, c in triangles]
    return positions, triangles


def _corner_normal(unit_normal, neighbours, cos_crease):
    near = [weighted for n, weighted in neighbours if dot(n, unit_normal) >= cos_crease]
    return unit([math.fsum(n[k] for n in near) for k in range(3)])


def finish(solids, crease_degrees=35.0, uv=None, colour=None, tangent=None):
    """A mesh of solids, smooth across edges flatter than the crease. `uv`, `colour` and `tangent`
    (x, y, z, handedness) are functions of position and normal."""
    mesh = Mesh([], [], [], [], [], [])
    cos_crease = math.cos(math.radians(crease_degrees))
    for positions, triangles in map(snapped, solids):
        around = [[] for _ in positions]
        faces = []
        for a, b, c in triangles:
            n = cross(sub(positions[b], positions[a]), sub(positions[c], positions[a]))
            faces.append(unit(n))
            for i in (a, b, c):
                around[i].append((faces[-1], n))
        index = {}
        for triangle, face in zip(triangles, faces):
            corners = []
            for i in triangle:
                normal = _corner_normal(face, around[i], cos_crease)
                key = (i, tuple(round(c, 5) for c in normal))
                if key not in index:
                    index[key] = len(mesh.positions)
                    mesh.positions.append(positions[i])
                    mesh.normals.append(normal)
                    if uv:
                        mesh.uvs.append(uv(positions[i], normal))
                    if colour:
                        mesh.colours.append(colour(positions[i], normal))
                    if tangent:
                        mesh.tangents.append(tangent(positions[i], normal))
                corners.append(index[key])
            mesh.triangles.append(tuple(corners))
    return mesh


def box(lo, hi):
    positions = [(x, y, z) for x in (lo[0], hi[0]) for y in (lo[1], hi[1]) for z in (lo[2], hi[2])]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return positions, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def plate(columns, rows, front, back, keep=lambda i, j: True, turned=lambda i, j: False):
    """A sheet of real thickness over a grid of `columns` x `rows` parameters, from which the
    cells that `keep` refuses are cut out. `front(u, v)` and `back(u, v)` are its two faces; a
    cell that is `turned` is split along its other diagonal."""
    width, height = len(columns), len(rows)
    positions = [face(u, v) for face in (front, back) for v in rows for u in columns]

    def at(i, j, side):
        return (side * height + j) * width + i

    def kept(i, j):
        return 0 <= i < width - 1 and 0 <= j < height - 1 and keep(i, j)

    triangles = []
    for j in range(height - 1):
        for i in range(width - 1):
            if not kept(i, j):
                continue
            ring = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
            beyond = ((i, j - 1), (i + 1, j), (i, j + 1), (i - 1, j))
            if turned(i, j):
                ring, beyond = ring[1:] + ring[:1], beyond[1:] + beyond[:1]
            a, b, c, d = (at(*p, 0) for p in ring)
            triangles += [(a, b, c), (a, c, d)]
            a, b, c, d = (at(*p, 1) for p in ring)
            triangles += [(a, c, b), (a, d, c)]
            for k in range(4):
                if not kept(*beyond[k]):
                    p, q = ring[k], ring[(k + 1) % 4]
                    a, b, c, d = at(*p, 0), at(*q, 0), at(*q, 1), at(*p, 1)
                    triangles += [(a, c, b), (a, d, c)]
    return positions, triangles


def revolve(profile, segments, radius=lambda r, y, angle: r):
    """A lathe-turned solid about +y. `profile` lists (r, y) upwards; both ends are closed by a
    pole on the axis. `radius` may change r with the angle, as flutes do."""
    positions = [(0.0, profile[0][1], 0.0), (0.0, profile[-1][1], 0.0)]
    for r, y in profile:
        for k in range(segments):
            angle = 2.0 * math.pi * k / segments
            bent = radius(r, y, angle)
            positions.append((bent * math.cos(angle), y, bent * math.sin(angle)))
    triangles = []
    for k in range(segments):
        n = (k + 1) % segments
        for row in range(len(profile) - 1):
            a, b = 2 + row * segments + k, 2 + row * segments + n
            triangles += [(a, a + segments, b + segments), (a, b + segments, b)]
        top = 2 + (len(profile) - 1) * segments
        triangles += [(0, 2 + k, 2 + n), (1, top + n, top + k)]
    return positions, triangles


def tube(path, sides, section):
    """A closed tube: `path` lists (centre, tangent); `section(k, angle)` is its radius."""
    up, positions, count = (0.0, 0.0, 1.0), [], len(path)
    for k, (centre, tangent) in enumerate(path):
        t = unit(tangent)
        u = unit(cross(up, t))
        v = cross(t, u)
        for s in range(sides):
            angle = 2.0 * math.pi * s / sides
            r = section(k, angle)
            cu, cv = r * math.cos(angle), r * math.sin(angle)
            positions.append(tuple(centre[i] + cu * u[i] + cv * v[i] for i in range(3)))
    triangles = []
    for k in range(count):
        for s in range(sides):
            a, b = k * sides + s, k * sides + (s + 1) % sides
            c, d = (k + 1) % count * sides + s, (k + 1) % count * sides + (s + 1) % sides
            triangles += [(a, b, d), (a, d, c)]
    return positions, triangles


def sphere(levels, radius):
    """An octahedron split `levels` times; `radius(direction)` moves its vertices."""
    points = [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0),
              (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    triangles = [(2, 4, 0), (2, 0, 5), (2, 5, 1), (2, 1, 4), (3, 0, 4), (3, 5, 0), (3, 1, 5),
                 (3, 4, 1)]
    for _ in range(levels):
        middle, split = {}, []

        def between(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(unit([p + q for p, q in zip(points[a], points[b])]))
            return middle[key]

        for a, b, c in triangles:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            split += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = split
    return [tuple(radius(p) * c for c in p) for p in points], triangles


def ear_clip(points, ring):
    """Triangles of the simple polygon whose corners are `points[i]` (2-D) for i in `ring`,
    counter-clockwise. Bridges to holes, walked both ways, are allowed."""
    def area(a, b, c):
        return ((points[b][0] - points[a][0]) * (points[c][1] - points[a][1])
                - (points[b][1] - points[a][1]) * (points[c][0] - points[a][0]))

    ring, triangles = list(ring), []
    while len(ring) > 3:
        for k in range(len(ring)):
            a, b, c = ring[k - 1], ring[k], ring[(k + 1) % len(ring)]
            inside = (i for i in ring if i not in (a, b, c) and area(a, b, i) >= 0.0
                      and area(b, c, i) >= 0.0 and area(c, a, i) >= 0.0)
            if area(a, b, c) > 0.0 and next(inside, None) is None:
                triangles.append((a, b, c))
                del ring[k]
                break
        else:
            raise ValueError("the polygon crosses itself")
    return triangles + [tuple(ring)]


def extrude(polygon, place, first, last):
    """A prism: `polygon` lists 2-D corners, `place(x, y, w)` puts them into space at w = first
    and w = last."""
    count = len(polygon)
    turned = math.fsum(p[0] * q[1] - q[0] * p[1]
                       for p, q in zip(polygon, polygon[1:] + polygon[:1])) < 0.0
    cap = ear_clip(polygon, range(count)[::-1] if turned else range(count))
    cap = [(a, c, b) for a, b, c in cap] if turned else cap
    positions = [place(x, y, w) for w in (first, last) for x, y in polygon]
    triangles = [(a, c, b) for a, b, c in cap]
    triangles += [tuple(count + i for i in t) for t in cap]
    for k in range(count):
        n = (k + 1) % count
        triangles += [(k, n, count + n), (k, count + n, count + k)]
    return positions, triangles


def moved(solid, offset):
    return [tuple(c + o for c, o in zip(p, offset)) for p in solid[0]], solid[1]
