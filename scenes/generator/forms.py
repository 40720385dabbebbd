# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Bevelled, bent and turned solids, and meshes of several materials that many nodes place."""

import math

from .solids import box, cross, dot, finish, revolve, sub, unit


def times(a, b):
    """The quaternion (x, y, z, w) that turns as `b` and then as `a`."""
    return (a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2])


def turn(x=0.0, y=0.0, z=0.0):
    """The quaternion of turns about x, then y, then z, in degrees."""
    turned = (0.0, 0.0, 0.0, 1.0)
    for axis, degrees in enumerate((x, y, z)):
        half = 0.5 * math.radians(degrees)
        one = [0.0, 0.0, 0.0, math.cos(half)]
        one[axis] = math.sin(half)
        turned = times(one, turned)
    return turned


def rotated(solid, quaternion):
    """A solid turned about the origin."""
    axis, w = quaternion[:3], quaternion[3]

    def place(p):
        t = tuple(2.0 * c for c in cross(axis, p))
        u = cross(axis, t)
        return tuple(p[i] + w * t[i] + u[i] for i in range(3))

    return [place(p) for p in solid[0]], solid[1]


def _outwards(positions, polygons):
    """Triangles of a convex body's faces, counter-clockwise from outside."""
    count = len(positions)
    centre = tuple(math.fsum(p[k] for p in positions) / count for k in range(3))
    found = []
    for polygon in polygons:
        for k in range(1, len(polygon) - 1):
            a, b, c = polygon[0], polygon[k], polygon[k + 1]
            n = cross(sub(positions[b], positions[a]), sub(positions[c], positions[a]))
            found.append((a, b, c) if dot(n, sub(positions[a], centre)) > 0.0 else (a, c, b))
    return found


def bevelled(lo, hi, bevel):
    """A box whose edges and corners are cut off; finish it with a crease of 50 degrees."""
    signs = (0, 1)
    index, positions = {}, []
    for corner in ((i, j, k) for i in signs for j in signs for k in signs):
        for axis in range(3):
            p = [(hi[a] if corner[a] else lo[a]) for a in range(3)]
            for other in range(3):
                if other != axis:
                    p[other] += -bevel if corner[other] else bevel
            index[corner, axis] = len(positions)
            positions.append(tuple(p))
    polygons = [[index[corner, axis] for axis in range(3)]
                for corner in ((i, j, k) for i in signs for j in signs for k in signs)]

    def at(axis, values):
        """The corner whose coordinates on the axes after `axis` are `values`."""
        corner = [0, 0, 0]
        for step, value in enumerate(values):
            corner[(axis + step) % 3] = value
        return tuple(corner)

    for axis in range(3):
        second = (axis + 1) % 3
        for s in signs:
            ring = ((0, 0), (1, 0), (1, 1), (0, 1))
            polygons.append([index[at(axis, (s, *pair)), axis] for pair in ring])
            for t in signs:
                first, last = at(axis, (s, t, 0)), at(axis, (s, t, 1))
                polygons.append([index[first, axis], index[first, second], index[last, second],
                                 index[last, axis]])
    return positions, _outwards(positions, polygons)


def lofted(rings):
    """A solid through rings of equally many points, closed at both ends by their means."""
    count = len(rings[0])
    ends = [tuple(math.fsum(p[k] for p in ring) / count for k in range(3))
            for ring in (rings[0], rings[-1])]
    triangles, last = [], 2 + (len(rings) - 1) * count
    for k in range(count):
        n = (k + 1) % count
        for row in range(len(rings) - 1):
            a, b = 2 + row * count + k, 2 + row * count + n
            triangles += [(a, a + count, b + count), (a, b + count, b)]
        triangles += [(0, 2 + k, 2 + n), (1, last + n, last + k)]
    return ends + [p for ring in rings for p in ring], triangles


def rounded(width, depth, radius, steps, y):
    """The outline of a rectangle with round corners, at a height."""
    points = []
    for quarter, (sx, sz) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for k in range(steps + 1):
            angle = 0.5 * math.pi * (quarter + k / steps)
            points.append((sx * (0.5 * width - radius) + radius * math.cos(angle), y,
                           sz * (0.5 * depth - radius) + radius * math.sin(angle)))
    return points


def cushion(width, depth, height, radius, edge, steps=4, bend=lambda p: p):
    """A slab on the origin with a round outline and round edges of radius `edge`."""
    rings = []
    for k in range(2 * steps + 2):
        top = k > steps
        angle = 0.5 * math.pi * ((k - 1) if top else k) / steps
        inset = edge * (1.0 - math.sin(angle))
        y = edge - edge * math.cos(angle) if not top else height - edge - edge * math.cos(angle)
        rings.append([bend(p) for p in rounded(width - 2.0 * inset, depth - 2.0 * inset,
                                               max(radius - inset, 0.25 * radius), steps, y)])
    return lofted(rings)


def _frames(points):
    """Two unit vectors across a path at each of its points, without twist."""
    count, found, across = len(points), [], None
    for k in range(count):
        t = unit(sub(points[min(k + 1, count - 1)], points[max(k - 1, 0)]))
        if across is None:
            axis = min(range(3), key=lambda i: (round(abs(t[i]), 6), i))
            across = tuple(1.0 if i == axis else 0.0 for i in range(3))
        along = dot(across, t)
        across = unit(tuple(a - along * c for a, c in zip(across, t)))
        found.append((across, cross(t, across)))
    return found


def cable(points, radius, sides):
    """A round bar along a path; `radius` is a number or one for each point."""
    radii = [radius] * len(points) if isinstance(radius, float) else radius
    rings = []
    for centre, (u, v), r in zip(points, _frames(points), radii):
        ring = []
        for s in range(sides):
            angle = 2.0 * math.pi * s / sides
            cu, cv = r * math.cos(angle), r * math.sin(angle)
            ring.append(tuple(centre[i] + cu * u[i] + cv * v[i] for i in range(3)))
        rings.append(ring)
    return lofted(rings)


def rod(first, last, radius, sides):
    """A straight round bar whose ends are bevelled."""
    length = math.sqrt(dot(sub(last, first), sub(last, first)))
    bevel = min(0.2 * radius, 0.2 * length) / length
    share = (0.0, bevel, 1.0 - bevel, 1.0)
    points = [tuple(a + (b - a) * t for a, b in zip(first, last)) for t in share]
    return cable(points, [0.8 * radius, radius, radius, 0.8 * radius], sides)


def disc(radius, y0, y1, bevel, segments):
    """A round slab about +y with bevelled edges."""
    return revolve([(radius - bevel, y0), (radius, y0 + bevel), (radius, y1 - bevel),
                    (radius - bevel, y1)], segments)


def sheet(width, depth, thick):
    """A thin slab that lies on the origin."""
    return box((-0.5 * width, 0.0, -0.5 * depth), (0.5 * width, thick, 0.5 * depth))


def compound(builder, name, parts):
    """A mesh of several materials: `parts` lists (material, solids, crease in degrees)."""
    return builder.document.add_mesh(name, [
        builder.document.primitive(finish(solids, crease_degrees=crease),
                                   builder.materials[material])
        for material, solids, crease in parts])


def repainted(builder, name, mesh, changes):
    """The same mesh, its data stored once, with some materials changed for others."""
    swap = {builder.materials[a]: builder.materials[b] for a, b in changes.items()}
    primitives = builder.document.json["meshes"][mesh]["primitives"]
    return builder.document.add_mesh(name, [
        {**p, "material": swap.get(p["material"], p["material"])} for p in primitives])


def put(builder, name, mesh=None, at=(0.0, 0.0, 0.0), rotation=None, scale=None, parent=None):
    """A node, below `parent` where there is one; its index. Lengths in metres."""
    fields = {} if mesh is None else {"mesh": mesh}
    if any(at):
        fields["translation"] = [round(c, 6) for c in at]
    if rotation:
        fields["rotation"] = [round(c, 9) + 0.0 for c in rotation]
    if scale:
        fields["scale"] = [round(c, 6) for c in scale]
    if parent is None:
        return builder.document.add_node(name, **fields)
    return builder.document.add_child(name, parent, **fields)
