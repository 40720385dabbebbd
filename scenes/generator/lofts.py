# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Closed solids made of rings of points: rods, bent bars, cushions, boxes with rounded corners."""

import math

from .solids import cross, plate, sub, unit


def loft(rings):
    """A solid through rings of as many points each, closed by a pole amid the first and last."""
    count, positions = len(rings[0]), [p for ring in rings for p in ring]
    first, last = len(positions), len(positions) + 1
    for ring in (rings[0], rings[-1]):
        positions.append(tuple(math.fsum(p[k] for p in ring) / count for k in range(3)))
    triangles, top = [], (len(rings) - 1) * count
    for k in range(count):
        n = (k + 1) % count
        for row in range(len(rings) - 1):
            a, b = row * count + k, row * count + n
            triangles += [(a, b, b + count), (a, b + count, a + count)]
        triangles += [(first, n, k), (last, top + k, top + n)]
    return positions, triangles


def rounded(half_x, half_z, radius, steps=4):
    """The outline, as (x, z), of a rectangle with rounded corners."""
    points = []
    for k, (sx, sz) in enumerate(((1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0))):
        for s in range(steps + 1):
            angle = 0.5 * math.pi * (k + s / steps)
            points.append((sx * (half_x - radius) + radius * math.cos(angle),
                           sz * (half_z - radius) + radius * math.sin(angle)))
    return points


def rounded_box(half_x, half_z, y0, y1, radius, bevel, steps=4):
    """A box about the y axis with rounded upright edges and bevelled ones above and below."""
    def ring(inset, y):
        outline = rounded(half_x - inset, half_z - inset, radius - 0.7 * inset, steps)
        return [(x, y, z) for x, z in outline]
    return loft([ring(bevel, y0), ring(0.0, y0 + bevel), ring(0.0, y1 - bevel), ring(bevel, y1)])


def pillow(half_x, half_z, thick, radius, bend=lambda x, y, z: (x, y, z), crown=0.0, steps=4):
    """A cushion on y = 0 with round edges and a top that swells by `crown`; `bend` moves every
    point of it."""
    edge, arc = 0.5 * thick, 6

    def ring(inset, y, share=1.0):
        outline = rounded(half_x - inset, half_z - inset, max(radius - inset, 0.1 * radius), steps)
        return [bend(share * x, y, share * z) for x, z in outline]

    rings = [ring(edge, 0.0, share) for share in (0.35, 0.7)]
    for k in range(arc + 1):
        angle = math.pi * (k / arc - 0.5)
        rings.append(ring(edge * (1.0 - math.cos(angle)), edge * (1.0 + math.sin(angle))))
    rings += [ring(edge, thick + crown * lift, share) for share, lift in ((0.7, 0.6), (0.35, 1.0))]
    return loft(rings)


def rod(start, end, radius, sides=8, end_radius=None):
    """A round bar between two points, which may taper."""
    way = unit(sub(end, start))
    least = min(range(3), key=lambda k: abs(way[k]))
    u = unit(cross(way, tuple(1.0 if k == least else 0.0 for k in range(3))))
    v = cross(way, u)
    rings = []
    for centre, r in ((start, radius), (end, radius if end_radius is None else end_radius)):
        turns = [2.0 * math.pi * s / sides for s in range(sides)]
        rings.append([tuple(centre[k] + r * (math.cos(a) * u[k] + math.sin(a) * v[k])
                            for k in range(3)) for a in turns])
    return loft(rings)


def sweep(path, across, radii, sides=8):
    """A bar of elliptical section along a path in the plane that the unit vector `across` is
    perpendicular to. `radii`: (along `across`, in the plane), one pair or one for each point."""
    rings = []
    for k, centre in enumerate(path):
        tangent = sub(path[min(k + 1, len(path) - 1)], path[max(k - 1, 0)])
        v = unit(cross(tangent, across))
        ru, rv = radii if isinstance(radii, tuple) else radii[k]
        turns = [2.0 * math.pi * s / sides for s in range(sides)]
        rings.append([tuple(centre[i] + ru * math.cos(a) * across[i] + rv * math.sin(a) * v[i]
                            for i in range(3)) for a in turns])
    return loft(rings)


def curve(points, steps):
    """Points on a smooth curve through `points` (Catmull-Rom), `steps` from each to the next."""
    found = []
    for k in range(len(points) - 1):
        a, b, c, d = (points[min(max(k + i, 0), len(points) - 1)] for i in (-1, 0, 1, 2))
        for s in range(steps):
            t = s / steps
            found.append(tuple(
                q + 0.5 * t * (r - p + t * (2.0 * p - 5.0 * q + 4.0 * r - e
                                            + t * (3.0 * (q - r) + e - p)))
                for p, q, r, e in zip(a, b, c, d)))
    return found + [points[-1]]


def hoop(profile, segments):
    """A ring about the y axis whose section is the closed polygon `profile` of (r, y)."""
    count, positions, triangles = len(profile), [], []
    for k in range(segments):
        angle = 2.0 * math.pi * k / segments
        positions += [(r * math.cos(angle), y, r * math.sin(angle)) for r, y in profile]
    for k in range(segments):
        for s in range(count):
            a, b = k * count + s, k * count + (s + 1) % count
            c, d = ((k + 1) % segments * count + s,
                    (k + 1) % segments * count + (s + 1) % count)
            triangles += [(a, b, d), (a, d, c)]
    return positions, triangles


def rim(half_x, half_y, width, z0, z1):
    """A flat rectangular frame about the z axis: `width` from its outline inwards."""
    xs = (-half_x, width - half_x, half_x - width, half_x)
    ys = (-half_y, width - half_y, half_y - width, half_y)
    return plate(xs, ys, lambda x, y: (x, y, z0), lambda x, y: (x, y, z1),
                 lambda i, j: (i, j) != (1, 1))


def turned(solid, axis, degrees):
    """A solid rotated about the axis 0 (x), 1 (y) or 2 (z)."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3

    def point(p):
        q = list(p)
        q[i], q[j] = c * p[i] - s * p[j], s * p[i] + c * p[j]
        return tuple(q)
    return [point(p) for p in solid[0]], solid[1]


def turn_about_y(degrees):
    """The rotation of a node by an angle about the y axis."""
    half = 0.5 * math.radians(degrees)
    return (0.0, math.sin(half), 0.0, math.cos(half))
