# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A desk with drawers that open, and a swivel chair: lists of closed solids in metres, +y up."""

import math

from .forms import (bevelled, cable, compound, cushion, disc, lofted, put, rod, rotated,
                    rounded, turn)
from .solids import moved, revolve

LENGTH, DEPTH, TOP, BOARD = 1.6, 0.74, 0.75, 0.032
PEDESTAL_WIDTH, PEDESTAL_DEPTH, LOW, PANEL = 0.42, 0.66, 0.07, 0.02
DRAWERS = 3
STEP = (TOP - BOARD - LOW - 0.004) / DRAWERS
PEDESTAL_X = 0.5 * (LENGTH - PEDESTAL_WIDTH) - 0.05
FRONT = DEPTH - 0.045  # where the pedestals' carcasses end


def _slab(lo, hi, bevel=0.0025):
    return bevelled(lo, hi, bevel)


def top():
    """The board, along x, from z = 0 at the back to `DEPTH`."""
    x = 0.5 * LENGTH
    return [_slab((-x, TOP - BOARD, 0.0), (x, TOP, DEPTH), 0.004)]


def frame():
    """Two carcasses with room for drawers, and the panel between them at the back."""
    solids = [_slab((-PEDESTAL_X, 0.28, 0.05), (PEDESTAL_X, TOP - 0.01, 0.068))]
    half, back = 0.5 * PEDESTAL_WIDTH, FRONT - PEDESTAL_DEPTH
    for middle in (-PEDESTAL_X, PEDESTAL_X):
        for side in (-1.0, 1.0):
            near, far = sorted((middle + side * half, middle + side * (half - PANEL)))
            solids.append(_slab((near, LOW, back), (far, TOP - BOARD + 0.01, FRONT)))
        inner = half - PANEL + 0.005
        solids.append(_slab((middle - inner, LOW + 0.004, back + 0.002),
                            (middle + inner, TOP - BOARD + 0.008, back + 0.016)))
        for k in range(DRAWERS):
            y = LOW + 0.002 + k * STEP
            solids.append(_slab((middle - inner + 0.001, y, back + 0.01),
                                (middle + inner - 0.001, y + 0.014, FRONT - 0.004)))
        for x in (middle - half + 0.05, middle + half - 0.05):
            for z in (back + 0.05, FRONT - 0.06):
                solids.append(moved(revolve([(0.014, -0.001), (0.022, LOW + 0.008)], 16),
                                    (x, 0.0, z)))
    return solids


def drawer():
    """An open box; its front's lower edge is the origin, and it reaches back along -z."""
    half, deep, high, thin = 0.5 * PEDESTAL_WIDTH - 0.004, 0.56, STEP - 0.006, 0.012
    inner = 0.5 * PEDESTAL_WIDTH - PANEL - 0.006
    solids = [_slab((-half, 0.0, 0.001), (half, high, 0.021), 0.003)]
    floor, rise = 0.02, high - 0.045
    solids.append(_slab((-inner + 0.002, floor, -deep + 0.003), (inner - 0.002, floor + 0.008,
                                                                 0.006), 0.001))
    for side in (-1.0, 1.0):
        near, far = sorted((side * inner, side * (inner - thin)))
        solids.append(_slab((near, floor - 0.002, -deep), (far, floor + rise, 0.008), 0.001))
    solids.append(_slab((-inner + 0.001, floor - 0.001, -deep + 0.001),
                        (inner - 0.001, floor + rise - 0.002, -deep + thin), 0.001))
    return solids


def handle():
    """A bow on the front of a drawer."""
    half, y = 0.06, 0.5 * STEP
    path = [(-half, y, 0.015), (-half, y, 0.03)]
    path += [(-half + 0.012 * (1.0 - math.cos(a)), y, 0.033 + 0.012 * math.sin(a))
             for a in (0.25 * math.pi, 0.5 * math.pi)]
    path += [(-x, y, z) for x, _, z in reversed(path)]
    return [cable(path, 0.0045, 10)]


def desk(builder, wood, inside, metal, open_by=lambda side, k: 0.0):
    """Places the desk, its back at z = 0; the nodes of the drawers by (side, number)."""
    put(builder, "desk", compound(builder, "desk", [(wood, top(), 50.0),
                                                    (inside, frame(), 50.0)]))
    box = compound(builder, "drawer", [(inside, drawer(), 50.0), (metal, handle(), 60.0)])
    nodes = {}
    for side in (-1, 1):
        for k in range(DRAWERS):
            at = drawer_place(side, k, open_by(side, k))
            nodes[side, k] = put(builder, f"drawer {len(nodes) + 1}", box, at)
    return nodes


def drawer_place(side, k, out):
    """Where a drawer is that is open by `out`; numbered upwards."""
    return side * PEDESTAL_X, LOW + 0.004 + k * STEP, FRONT + out


def chair_base():
    """The column and the five feet of a swivel chair; origin on the floor."""
    solids = [rod((0.0, 0.09, 0.0), (0.0, 0.3, 0.0), 0.027, 20),
              rod((0.0, 0.28, 0.0), (0.0, 0.44, 0.0), 0.016, 16),
              disc(0.05, 0.075, 0.125, 0.008, 24),
              bevelled((-0.1, 0.42, -0.12), (0.1, 0.445, 0.12), 0.005)]
    for k in range(5):
        rings = [[(r, 0.095 - 0.12 * (r - 0.03) + y, z) for y, z in (
            (-0.012, -w), (0.006, -w), (0.012, -0.6 * w), (0.012, 0.6 * w), (0.006, w),
            (-0.012, w))] for r, w in ((0.03, 0.022), (0.12, 0.02), (0.29, 0.015), (0.3, 0.011))]
        solids.append(rotated(lofted(rings), turn(y=72.0 * k + 12.0)))
    return solids


def casters():
    """The five double wheels below the feet."""
    solids = []
    for k in range(5):
        wheel = [rod((0.285, 0.0255, z), (0.285, 0.0255, z + 0.016), 0.026, 18)
                 for z in (-0.02, 0.004)]
        wheel += [rod((0.285, 0.0255, -0.012), (0.285, 0.0255, 0.012), 0.008, 8),
                  rod((0.285, 0.024, 0.0), (0.285, 0.068, 0.0), 0.0035, 8)]
        solids += [rotated(part, turn(y=72.0 * k + 12.0)) for part in wheel]
    return solids


def chair_cushions():
    """Seat and back; the chair looks along -z."""
    def dished(p):
        return p[0], p[1] + 0.22 * p[0] * p[0] - 0.35 * max(-p[2] - 0.1, 0.0) ** 2, p[2]

    def curved(p):
        return p[0], p[1] - 0.45 * p[0] * p[0] + 0.2 * p[2] * p[2], p[2]

    seat = moved(cushion(0.48, 0.46, 0.075, 0.1, 0.03, 5, dished), (0.0, 0.435, 0.0))
    back = rotated(cushion(0.42, 0.46, 0.06, 0.09, 0.026, 5, curved), turn(x=-82.0))
    return [seat, moved(back, (0.0, 0.82, 0.235))]


def chair_arms():
    """Arm rests, and the bar that carries the back."""
    solids = [cable([(0.0, 0.43, 0.05), (0.0, 0.425, 0.2), (0.0, 0.45, 0.27), (0.0, 0.55, 0.285),
                     (0.0, 0.82, 0.262)], 0.016, 12)]
    for x in (-0.27, 0.27):
        solids.append(cable([(0.7 * x, 0.437, 0.05), (0.98 * x, 0.44, 0.05), (x, 0.47, 0.05),
                             (x, 0.66, 0.05)], 0.011, 10))
        rings = [rounded(0.05 - i, 0.25 - i, 0.022 - 0.5 * i, 3, y)
                 for i, y in ((0.008, 0.645), (0.0, 0.652), (0.0, 0.668), (0.008, 0.676))]
        solids.append(moved(lofted(rings), (x, 0.0, 0.02)))
    return solids
