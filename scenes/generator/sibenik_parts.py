# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What stands in the cathedral, each a list of closed solids in metres, +y up."""

import math

from . import sibenik_plan as plan
from .lofts import hoop, rod
from .solids import box, extrude, moved, revolve, sphere


def column():
    """A round column: an octagonal base, a capital of two rows of leaves; origin at its foot."""
    low, high = 0.62, 3.72

    def carved(r, y, angle):
        if y < high + 0.1 or y > 4.28:
            return r
        upper = y > 4.02
        swell = min(1.0, (y - (4.02 if upper else high + 0.1)) / 0.16)
        leaf = abs(math.sin(4.0 * angle + (0.5 * math.pi if upper else 0.0)))
        return r * (1.0 + 0.2 * swell * (leaf - 0.45))

    base = [(0.56, 0.2), (0.585, 0.25), (0.585, 0.31), (0.55, 0.36), (0.49, 0.38), (0.475, 0.43),
            (0.5, 0.47), (0.515, 0.51), (0.5, 0.55), (0.45, 0.58)]
    shaft = [(0.43, low), (0.43, 1.6), (0.425, 2.7), (0.41, high - 0.1), (0.41, high - 0.04)]
    neck = [(0.45, high - 0.02), (0.465, high + 0.02), (0.45, high + 0.06), (0.41, high + 0.08)]
    leaves = [(0.41, 3.84), (0.43, 3.9), (0.47, 3.97), (0.52, 4.015), (0.44, 4.03), (0.46, 4.08),
              (0.5, 4.15), (0.56, 4.22), (0.6, 4.27), (0.53, 4.3), (0.55, 4.36)]
    foot = [(0.72 * math.cos(math.pi * (k + 0.5) / 4), 0.72 * math.sin(math.pi * (k + 0.5) / 4))
            for k in range(8)]
    return [extrude(foot, lambda x, z, y: (x, y, z), -0.06, 0.22),
            revolve(base + shaft + neck + leaves, 48, carved),
            box((-0.6, 4.34, -0.6), (0.6, plan.SPRINGING + 0.02, 0.6)),
            box((-0.54, 4.3, -0.54), (0.54, 4.4, 0.54))]


def wall_shaft():
    """A slender shaft from a column up to the vault, half within the wall; origin at its corbel."""
    top = plan.VAULT_Y - 0.3 - plan.SHAFT_Y
    profile = [(0.03, -0.6), (0.1, -0.5), (0.19, -0.3), (0.23, -0.2), (0.23, -0.12), (0.17, -0.06),
               (0.17, top - 0.62), (0.2, top - 0.59), (0.2, top - 0.54), (0.165, top - 0.5),
               (0.18, top - 0.36), (0.25, top - 0.18), (0.3, top - 0.12)]
    return [revolve(profile, 24), box((-0.34, top - 0.14, -0.34), (0.34, top + 0.04, 0.34))]


def colonnette():
    """A column of the triforium; origin at its foot."""
    height = plan.TRIFORIUM_SPRINGING - plan.PARAPET_Y
    profile = [(0.13, -0.02), (0.13, 0.06), (0.115, 0.1), (0.085, 0.12), (0.075, 0.15),
               (0.072, 0.6), (0.068, height - 0.26), (0.085, height - 0.24),
               (0.085, height - 0.21), (0.07, height - 0.19), (0.08, height - 0.12),
               (0.125, height - 0.05)]
    return [revolve(profile, 18),
            box((-0.14, height - 0.06, -0.14), (0.14, height + 0.02, 0.14))]


def tracery():
    """The stone bars of a window in the plane x = 0, at the window's place along z."""
    bars = [box((-0.07, plan.SILL_Y - 0.06, -0.05), (0.07, plan.WINDOW_TOP, 0.05)),
            box((-0.05, plan.WINDOW_SPRINGING - 0.3, -0.86),
                (0.05, plan.WINDOW_SPRINGING - 0.23, 0.86))]
    positions, triangles = hoop([(0.31, -0.06), (0.4, -0.09), (0.4, 0.09), (0.31, 0.06)], 28)
    middle = plan.WINDOW_SPRINGING + 0.26
    return [*bars, ([(y, middle + x, z) for x, y, z in positions], triangles)]


def pew():
    """A bench with a back that looks along -z, its length along x; origin on the floor."""
    half = 1.28
    side = [(-0.28, -0.02), (0.24, -0.02), (0.24, 0.1), (0.2, 0.16), (0.21, 0.98), (0.24, 1.04),
            (0.2, 1.09), (0.12, 1.06), (0.1, 0.94), (0.08, 0.62), (-0.2, 0.58), (-0.27, 0.5),
            (-0.24, 0.12)]
    solids = [extrude(side, lambda z, y, x: (x, y, z), x - 0.03, x + 0.03) for x in (-half, half)]
    spans = ((0.43, 0.465, -0.24, 0.17), (0.5, 0.97, 0.135, 0.165), (0.955, 0.995, 0.11, 0.19),
             (0.1, 0.2, 0.12, 0.145), (0.12, 0.15, 0.13, 0.3))
    for k, (y0, y1, z0, z1) in enumerate(spans):
        end = half - 0.002 * k
        solids.append(box((-end, y0, z0), (end, y1, z1)))
    return solids


def chandelier(length):
    """A ring of candles that hangs on `length` of rod; origin at the ring's centre."""
    iron = [hoop([(0.96, -0.05), (1.02, -0.05), (1.02, 0.05), (0.96, 0.05)], 48),
            hoop([(0.44, 0.3), (0.48, 0.3), (0.48, 0.36), (0.44, 0.36)], 32),
            rod((0.0, 1.15, 0.0), (0.0, length, 0.0), 0.018), moved(sphere(2, lambda d: 0.08),
                                                                   (0.0, 1.2, 0.0))]
    wax = []
    for k in range(12):
        angle = 2.0 * math.pi * (k + 0.5) / 12
        x, z = math.cos(angle), math.sin(angle)
        if k % 3 == 0:
            iron += [rod((0.99 * x, 0.0, 0.99 * z), (0.46 * x, 0.33, 0.46 * z), 0.012, 6),
                     rod((0.46 * x, 0.33, 0.46 * z), (0.02 * x, 1.2, 0.02 * z), 0.012, 6)]
        cup = [(0.02, 0.02), (0.05, 0.08), (0.06, 0.1), (0.03, 0.105)]
        iron.append(moved(revolve(cup, 10), (0.99 * x, 0.0, 0.99 * z)))
        wax.append(moved(revolve([(0.024, 0.09), (0.022, 0.32), (0.012, 0.335)], 10),
                         (0.99 * x, 0.0, 0.99 * z)))
    return iron, wax


def candlestick():
    """A turned candlestick and its candle; origin at its foot."""
    stick = [(0.11, -0.01), (0.11, 0.02), (0.07, 0.05), (0.03, 0.09), (0.045, 0.15), (0.025, 0.2),
             (0.022, 0.38), (0.04, 0.42), (0.022, 0.46), (0.03, 0.54), (0.075, 0.58), (0.075, 0.6)]
    candle = [(0.028, 0.59), (0.026, 0.92), (0.01, 0.94)]
    return [revolve(stick, 24)], [revolve(candle, 16)]


def altar():
    """The steps, the table, its cloth and the cross: lists of solids by what they are made of.
    Origin on the choir's floor, below the middle of the table."""
    steps = [box((-2.6 + 0.3 * k, -0.07 + 0.01 * k, -1.5 + 0.3 * k),
                 (2.6 - 0.3 * k, 0.15 * (k + 1), 1.8 - 0.3 * k)) for k in range(3)]
    top = 0.45
    table = [box((-1.15, top - 0.05, -0.45), (1.15, top + 0.9, 0.45)),
             box((-1.25, top - 0.02, -0.52), (1.25, top + 0.12, 0.52)),
             box((-1.32, top + 0.88, -0.58), (1.32, top + 1.0, 0.58))]
    cloth = [box((-0.62, top + 0.2, -0.596), (0.62, top + 1.008, 0.596))]
    gold = [box((-0.045, top + 0.98, -0.34), (0.045, top + 2.1, -0.25)),
            box((-0.35, top + 1.62, -0.335), (0.35, top + 1.71, -0.255)),
            revolve([(0.2, top + 0.99), (0.2, top + 1.03), (0.1, top + 1.07), (0.07, top + 1.12)],
                    24)]
    gold[2] = moved(gold[2], (0.0, 0.0, -0.295))
    return steps, table, cloth, gold


def choir_steps():
    """The stairs from the nave up to the choir, over the nave's whole width."""
    profile = [(plan.STEPS_Z - plan.STEPS * plan.TREAD - 0.3, -0.1)]
    for k in range(plan.STEPS):
        near = plan.STEPS_Z - plan.TREAD * k
        profile += [(near, plan.RISER * k if k else -0.1), (near, plan.RISER * (k + 1))]
    profile.append((profile[0][0], plan.RISER * plan.STEPS))
    return [extrude(profile, lambda z, y, x: (x, y, z), -plan.ARCADE_IN - 0.4,
                    plan.ARCADE_IN + 0.4)]


def lozenge(half):
    """A slab of the floor, a square that stands on its corner; origin on the floor."""
    corners = [(half, 0.0), (0.0, half), (-half, 0.0), (0.0, -half)]
    return [extrude(corners, lambda x, z, y: (x, y, z), -0.05, 0.004)]


def dome():
    """Drum, dome and lantern as one ring about the y axis, from the height of the pendentives."""
    inside = [(3.86, 0.1), (3.86, 0.34), (4.0, 0.42), (4.0, 0.95), (3.9, 1.02), (3.9, 1.14),
              (4.0, 1.2)]
    rise = 2.35
    for k in range(1, 13):
        angle = 0.5 * math.pi * k / 14
        inside.append((4.0 * math.cos(angle), 1.2 + rise * math.sin(angle)))
    inside = [p for p in inside if p[0] > plan.OCULUS + 0.15]
    top = inside[-1][1] + 0.1
    inside += [(plan.OCULUS - 0.02, top), (plan.OCULUS - 0.02, top + 0.16),
               (plan.OCULUS, top + 0.2), (plan.OCULUS, plan.LANTERN_Y + 0.3 - plan.DOME_Y)]
    outside = [(plan.OCULUS + 1.1, inside[-1][1]), (3.6, 3.4), (4.7, 1.4), (4.7, 0.1)]
    return [hoop(inside + outside, 64)]


def apse_shafts():
    """Slender shafts along the apse's wall with a string course above; origin at the centre of
    the apse, on the choir's floor."""
    top, radius = plan.APSE_SPRINGING - plan.CHOIR_Y, plan.APSE_RADIUS
    profile = [(0.17, -0.02), (0.17, 0.12), (0.13, 0.18), (0.095, 0.22), (0.09, top - 0.5),
               (0.12, top - 0.47), (0.12, top - 0.42), (0.09, top - 0.4), (0.11, top - 0.24),
               (0.17, top - 0.12), (0.17, top - 0.02)]
    found = []
    for k in range(1, 6):
        angle = math.pi * k / 6
        found.append(moved(revolve(profile, 20),
                           (radius * math.cos(angle), 0.0, -radius * math.sin(angle))))
    return found
