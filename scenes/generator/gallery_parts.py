# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The gallery's building blocks, each a list of closed solids in metres, +y up."""

import math

from . import gallery_plan as plan
from .solids import box, extrude, moved, plate, revolve, sphere, tube

FLUTES, STEPS_PER_FLUTE = 20, 5


def _spread(first, last, count):
    return [first + (last - first) * k / count for k in range(count + 1)]


def column():
    """A fluted column with base and capital; origin at its foot."""
    low, high = 0.62, 3.36

    def fluted(r, y, angle):
        end = min(y - low, high - y) / 0.08
        depth = 0.0 if end <= 0.0 else min(1.0, end)
        groove = abs(math.sin(0.5 * FLUTES * angle))
        return r * (1.0 - 0.085 * depth * groove)

    shaft = []
    for y in (low, low + 0.03, low + 0.08, 1.4, 2.2, 2.8, high - 0.08, high - 0.03, high):
        t = (y - low) / (high - low)
        shaft.append((0.335 - 0.045 * t * t, y))  # entasis: it thins towards the top
    base = [(0.43, 0.2), (0.455, 0.24), (0.465, 0.29), (0.455, 0.34), (0.43, 0.38), (0.385, 0.4),
            (0.375, 0.45), (0.395, 0.49), (0.4, 0.53), (0.385, 0.57), (0.345, 0.59)]
    capital = [(0.315, 3.38), (0.325, 3.42), (0.3, 3.45), (0.3, 3.52), (0.33, 3.56),
               (0.39, 3.66), (0.42, 3.74), (0.425, 3.81)]
    return [box((-0.48, -0.05, -0.48), (0.48, 0.22, 0.48)),
            revolve(base + shaft + capital, FLUTES * STEPS_PER_FLUTE, fluted),
            box((-0.47, 3.8, -0.47), (0.47, plan.SPRINGING + 0.03, 0.47))]


def arcade(side):
    """The wall on the columns, pierced by round arches; `side` is -1 or +1."""
    r = 0.5 * plan.BAY - 0.42
    soffit = [(-plan.HALF_LENGTH - 0.3, 0.0)]
    for bay in range(plan.BAYS):
        centre = -plan.HALF_LENGTH + (bay + 0.5) * plan.BAY
        for k in range(33):
            angle = math.pi * k / 32
            soffit.append((centre - r * math.cos(angle), r * math.sin(angle)))
    soffit.append((plan.HALF_LENGTH + 0.3, 0.0))

    def face(x):
        def at(k, v):
            z, rise = soffit[k]
            low = plan.SPRINGING + rise
            return side * x, low + (plan.WALL_TOP - low) * v, z
        return at

    return [plate(range(len(soffit)), (0, 1), face(plan.ARCADE_IN), face(plan.ARCADE_OUT))]


def vault():
    """The barrel vault with a slot along its crown, and the ribs below it."""
    angles = sorted({math.radians(a) for a in (*_spread(-2.0, 182.0, 46), 78.0, 102.0)})
    slot = math.radians(78.0) - 1e-9, math.radians(102.0) - 1e-9
    z_cuts = (-plan.HALF_LENGTH - 0.25, -plan.SLOT, plan.SLOT, plan.HALF_LENGTH + 0.25)

    def shell(radius):
        return lambda a, z: (radius * math.cos(a), plan.VAULT_Y + radius * math.sin(a), z)

    def keep(i, j):
        return not (slot[0] <= angles[i] < slot[1] and j == 1)

    shells = [plate(angles, z_cuts, shell(plan.VAULT_R), shell(plan.VAULT_R + 0.6), keep)]
    bent = _spread(math.radians(-1.0), math.radians(181.0), 40)
    for z in (k * plan.BAY for k in range(-2, 3)):
        shells.append(plate(bent, (z - 0.22, z + 0.22), shell(plan.VAULT_R - 0.16),
                            shell(plan.VAULT_R + 0.1)))
    return shells


def cornice(side):
    """A moulding along the top of the arcade, where the vault springs."""
    profile = [(3.8, 6.14), (3.58, 6.14), (3.58, 6.22), (3.5, 6.26), (3.42, 6.34), (3.38, 6.44),
               (3.38, 6.53), (3.8, 6.53)]
    end = plan.HALF_LENGTH + 0.2
    return [extrude([(side * x, y) for x, y in profile], lambda x, y, z: (x, y, z), -end, end)]


def end_wall(z, windows):
    """The wall at `z`, 0.5 m thick outwards, with windows given as (x0, x1, y0, y1)."""
    xs = sorted({-7.9, 7.9, *(x for w in windows for x in w[:2])})
    ys = sorted({-0.4, 11.2, *(y for w in windows for y in w[2:])})
    outside = z + math.copysign(0.5, z)

    def keep(i, j):
        return not any(w[0] <= xs[i] < w[1] and w[2] <= ys[j] < w[3] for w in windows)

    return [plate(xs, ys, lambda x, y: (x, y, z), lambda x, y: (x, y, outside), keep)]


def podium():
    """The raised end of the nave and the stairs up to it, without any face in common."""
    treads = plan.STEPS - 1
    profile = [(plan.PODIUM_Z - 0.2, -0.1)]
    for k in range(treads):
        near = plan.PODIUM_Z + (treads - k) * plan.TREAD
        profile += [(near, plan.RISER * k if k else -0.1), (near, plan.RISER * (k + 1))]
    profile.append((plan.PODIUM_Z - 0.2, plan.RISER * treads))
    stairs = extrude(profile, lambda z, y, x: (x, y, z), -plan.STAIR_HALF, plan.STAIR_HALF)
    half = plan.PODIUM_HALF
    return [box((-half, -0.08, -plan.HALF_LENGTH - 0.2), (half, plan.PODIUM_Y, plan.PODIUM_Z)),
            stairs]


def baluster():
    """A turned post 0.7 m high; origin at its foot."""
    profile = [(0.05, -0.02), (0.05, 0.05), (0.035, 0.07), (0.03, 0.1), (0.045, 0.18),
               (0.05, 0.24), (0.042, 0.31), (0.026, 0.42), (0.022, 0.54), (0.03, 0.6),
               (0.042, 0.63), (0.042, 0.72)]
    return [revolve(profile, 14)]


def rails():
    """Handrails, kerbs and newel posts of the podium's balustrade."""
    y, parts = plan.PODIUM_Y, []
    for x in (-plan.RAIL_X, plan.RAIL_X):
        inner = math.copysign(plan.STAIR_HALF + 0.16, x)
        front = plan.RAIL_Z
        parts += [box((x - 0.07, y + 0.68, -plan.HALF_LENGTH - 0.1), (x + 0.07, y + 0.78, front)),
                  box((min(x, inner), y + 0.675, front - 0.065),
                      (max(x, inner), y + 0.775, front + 0.065))]
        for post in (x, inner):
            parts.append(box((post - 0.1, y - 0.03, front - 0.1),
                             (post + 0.1, y + 0.86, front + 0.1)))
            parts.append(moved(sphere(3, lambda d: 0.105), (post, y + 0.93, front)))
    return parts


def knot():
    """A trefoil knot whose section swells along the way; centred on the origin."""
    count, path = 300, []
    for k in range(count):
        t = 2.0 * math.pi * k / count
        w = 2.0 + math.cos(3.0 * t)
        position = (0.3 * w * math.cos(2.0 * t), 0.3 * w * math.sin(2.0 * t),
                    0.32 * math.sin(3.0 * t))
        wd = -3.0 * math.sin(3.0 * t)
        tangent = (0.3 * (wd * math.cos(2.0 * t) - 2.0 * w * math.sin(2.0 * t)),
                   0.3 * (wd * math.sin(2.0 * t) + 2.0 * w * math.cos(2.0 * t)),
                   0.96 * math.cos(3.0 * t))
        path.append((position, tangent))

    def section(k, _):
        return 0.135 + 0.03 * math.cos(6.0 * math.pi * k / count)

    return [tube(path, 24, section)]


def wave_height(d):
    """The relief of the coloured stone along a unit direction, in [-1, 1]."""
    return math.sin(5.0 * d[0] + 3.0 * d[1]) * math.cos(4.0 * d[2] - 2.0 * d[1])


def stone():
    """A sphere with a soft relief."""
    return [sphere(5, lambda d: 0.62 * (1.0 + 0.13 * wave_height(d)))]


def vase():
    """A turned vase with an open mouth; origin at its foot."""
    outside = [(0.16, 0.0), (0.18, 0.03), (0.15, 0.07), (0.2, 0.16), (0.29, 0.32), (0.335, 0.5),
               (0.32, 0.68), (0.24, 0.84), (0.15, 0.95), (0.12, 1.03), (0.14, 1.1), (0.19, 1.15)]
    inside = [(0.17, 1.15), (0.12, 1.1), (0.1, 1.03), (0.13, 0.95), (0.22, 0.83), (0.3, 0.67),
              (0.31, 0.5), (0.26, 0.33), (0.12, 0.16)]
    return [revolve(outside + inside, 56)]


def pedestal(width, height):
    """A plinth, a die and a slab; origin at its foot."""
    h, foot = 0.5 * width, 0.5 * width + 0.08
    return [box((-foot, -0.06, -foot), (foot, 0.14, foot)),
            box((-h, 0.1, -h), (h, height - 0.05, h)),
            box((-h - 0.05, height - 0.08, -h - 0.05), (h + 0.05, height, h + 0.05))]


def bench():
    """A stone bench, its length along z; origin on the floor."""
    return [box((-0.24, 0.38, -0.85), (0.24, 0.48, 0.85)),
            box((-0.2, -0.02, -0.66), (0.2, 0.4, -0.5)),
            box((-0.2, -0.02, 0.5), (0.2, 0.4, 0.66))]


def trough(half_length):
    """The channel that hides the strip light, its length along z."""
    profile = [(-0.12, -0.1), (0.12, -0.1), (0.12, 0.08), (0.09, 0.08), (0.09, -0.06),
               (-0.09, -0.06), (-0.09, 0.08), (-0.12, 0.08)]
    return [extrude(profile, lambda x, y, z: (x, y, z), -half_length, half_length)]


def lamp_cord(length):
    """The rod and cap of the hanging lamp; origin at the lamp's centre."""
    return [revolve([(0.012, 0.1), (0.012, length)], 12),
            revolve([(0.09, 0.13), (0.085, 0.17), (0.05, 0.22), (0.02, 0.25)], 28)]
