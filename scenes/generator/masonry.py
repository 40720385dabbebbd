# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Arches, pierced walls, ribs and groin vaults, each a list of closed solids in metres, +y up."""

import math

from .lofts import loft
from .solids import cross, extrude, plate, sub, unit

POINT = 0.3  # how far beyond the middle a vault's arcs have their centres; 0 would be round


def spread(first, last, count):
    """`count` + 1 equally spaced numbers."""
    return [first + (last - first) * k / count for k in range(count + 1)]


def arch(half, radius, steps):
    """Points (u, rise) of an arch over [-half, half] from arcs of `radius`, `steps` on each side:
    round where `radius` is `half`, pointed where it is more."""
    beyond = radius - half
    steepest = math.acos(beyond / radius)
    right = [(radius * math.cos(a) - beyond, radius * math.sin(a))
             for a in spread(0.0, steepest, steps)]
    return [(-u, rise) for u, rise in right] + right[-2::-1]


def arcade(arches, first, last, springing, top, near, far):
    """A wall along z between the planes x = `near` and `far`, borne at the height `springing` and
    pierced by `arches`, a list of (centre, points of the arch)."""
    soffit = [(first, 0.0)]
    soffit += [(centre + u, rise) for centre, points in arches for u, rise in points]
    soffit.append((last, 0.0))

    def face(x):
        def at(k, v):
            low = springing + soffit[k][1]
            return x, low + (top - low) * v, soffit[k][0]
        return at

    return [plate(range(len(soffit)), (0, 1), face(near), face(far))]


def openings(arches, first, last, base, springing, top, place, near, far):
    """A wall with openings that have upright sides from `base` to `springing` and an arch above.
    `place(u, y, w)` puts it into space; w goes from `near` to `far`."""
    outline = [(first, base)]
    for centre, points in arches:
        outline.append((centre + points[0][0], base))
        outline += [(centre + u, springing + rise) for u, rise in points]
        outline.append((centre + points[-1][0], base))
    outline += [(last, base), (last, top), (first, top)]
    return [extrude(outline, place, near, far)]


def bar(path, across, section):
    """A bar along `path`, in a plane that the unit vector `across` is perpendicular to. `section`
    is its convex outline: (along `across`, out of the arch)."""
    rings = []
    for k, centre in enumerate(path):
        along = unit(sub(path[min(k + 1, len(path) - 1)], path[max(k - 1, 0)]))
        out = cross(across, along)
        rings.append([tuple(centre[i] + a * across[i] + b * out[i] for i in range(3))
                      for a, b in section])
    return loft(rings)


def moulding(width, below, above):
    """The section of a rib with bevelled edges: it hangs `below` its path and reaches `above`."""
    w, edge = 0.5 * width, 0.24 * width
    return [(-w, above), (-w, -0.45 * below), (-w + edge, -0.8 * below), (-edge * 0.5, -below),
            (edge * 0.5, -below), (w - edge, -0.8 * below), (w, -0.45 * below), (w, above)]


def vault_height(share):
    """The height of a vault's arch, 1 at its crown, at a share of the way to its springing."""
    share = min(abs(share), 1.0)
    high = (1.0 + POINT) ** 2
    return math.sqrt(max(high - (share + POINT) ** 2, 0.0) / (high - POINT * POINT))


def vault_shares(steps):
    """Shares of the way from springing (-1) to springing (1), closer where the arch is steep."""
    steepest = math.acos(POINT / (1.0 + POINT))
    right = [(1.0 + POINT) * math.cos(a) - POINT for a in spread(0.0, steepest, steps)][:-1]
    return [-s for s in right] + [0.0] + right[::-1]


def groin_vault(half_x, half_z, rise, thick, steps):
    """One bay of a groin vault around the y axis that springs from y = 0. Along x it reaches into
    the walls; along z it ends inside of the ribs between the bays."""
    shares = vault_shares(steps)
    along_z = [0.985 * shares[0], *shares[1:-1], 0.985 * shares[-1]]
    along_x = [-1.07, *shares, 1.07]

    def face(lift):
        return lambda s, t: (s * half_x, lift + rise * max(vault_height(s), vault_height(t)),
                             t * half_z)

    def turned(i, j):
        """Whether the groin of this quarter runs along the other diagonal of a cell."""
        return (along_x[i] + along_x[i + 1] > 0.0) != (along_z[j] + along_z[j + 1] > 0.0)

    return [plate(along_x, along_z, face(0.0), face(thick), turned=turned)]


def vault_rib(x, z, rise, section, steps, foot):
    """A rib of a vault around the y axis, from (-x, -z) to (x, z) at the springing, y = 0;
    it goes on straight for `foot` below."""
    length = math.sqrt(x * x + z * z)
    path = [(s * x, rise * vault_height(s), s * z) for s in vault_shares(steps)]
    path = [(-x, -foot, -z), *path, (x, -foot, z)]
    return bar(path, (-z / length, 0.0, x / length), section)


def archivolt(half, radius, section, steps, foot):
    """The moulding around an arch in the plane x = 0 that springs from y = 0; it goes on straight
    for `foot` below."""
    points = [(0.0, rise, u) for u, rise in arch(half, radius, steps)]
    path = [(0.0, -foot, points[0][2]), *points, (0.0, -foot, points[-1][2])]
    return bar(path, (-1.0, 0.0, 0.0), section)


def band(rings):
    """A solid through rings of points that closes upon itself."""
    count, many = len(rings[0]), len(rings)
    positions, triangles = [p for ring in rings for p in ring], []
    for k in range(many):
        for s in range(count):
            a, b = k * count + s, k * count + (s + 1) % count
            c, d = (k + 1) % many * count + s, (k + 1) % many * count + (s + 1) % count
            triangles += [(a, b, d), (a, d, c)]
    return positions, triangles


def pendentives(half, thick, segments, steps):
    """What leads from a square of half width `half`, where it springs at y = 0, to the circle in
    it: a sphere through its corners, cut off by the square."""
    rings = []
    for k in range(segments):
        angle = 2.0 * math.pi * k / segments
        x, z = math.cos(angle), math.sin(angle)
        reach = (half + 0.35) / max(abs(x), abs(z))
        inner = [(r, math.sqrt(max(2.0 * half * half - r * r, 0.0)))
                 for r in spread(half - 0.08, reach, steps)]
        outer = [(r, y + thick) for r, y in reversed(inner)]
        rings.append([(r * x, y, r * z) for r, y in inner + outer])
    return [band(rings)]
