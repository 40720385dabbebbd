# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Framed pictures that hang or stand; their colours are solids of low relief."""

import math

from .desk_things import picture_frame
from .forms import bevelled, compound, disc, put, rotated, turn
from .solids import extrude, moved


def painting(room, at, width, height, discs):
    """A frame with discs on paper: (material, x, y, radius) of each; its back is at z = 0."""
    w, h = 0.5 * width - 0.015, 0.5 * height - 0.015
    parts = [("walnut", [moved(s, (0.0, 0.0, -0.002)) for s in picture_frame(
        width, height, 0.024, 0.026)], 35.0),
        ("paper", [bevelled((-w, -h, -0.004), (w, h, 0.008), 0.0005)], 50.0)]
    for k, (material, x, y, r) in enumerate(discs):
        flat = disc(r, 0.004 - 0.0004 * k, 0.0088 + 0.0006 * k, 0.0003, 36)
        parts.append((material, [moved(rotated(flat, turn(x=90.0)), (x, y, 0.0))], 35.0))
    put(room, "painting", compound(room, "painting", parts), at)


def photograph(room, at, rotation):
    """A framed landscape of low relief that stands or hangs, its middle 9 cm above `at`."""
    hills = []
    for k, (height, name) in enumerate(((0.055, "hill far"), (0.032, "hill near"))):
        outline = [(-0.052 + 0.013 * i, -0.068 + height + 0.014 * math.sin(
            1.7 * i * (1.0 + 0.4 * k) + 2.0 * k)) for i in range(9)]
        outline += [(0.052, -0.07), (-0.052, -0.07)]
        hills.append((name, [extrude(outline, lambda x, y, z: (x, y, z), 0.0035 - 0.0002 * k,
                                     0.0048 + 0.001 * k)], 35.0))
    parts = [("walnut", picture_frame(0.13, 0.17, 0.014, 0.014), 35.0),
             ("sky blue", [bevelled((-0.055, -0.075, 0.001), (0.055, 0.075, 0.004), 0.0005)], 50.0),
             ("yellow", [rotated(disc(0.012, 0.0, 0.0046, 0.0005, 20), turn(x=90.0))], 35.0),
             *hills]
    parts = [(m, [moved(s, (0.0, 0.085, 0.0)) for s in solids], crease)
             for m, solids, crease in parts]
    parts[2] = (parts[2][0], [moved(s, (0.02, 0.035, 0.0)) for s in parts[2][1]], parts[2][2])
    put(room, "photograph", compound(room, "photograph", parts), at, rotation)
