# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Swivel chairs: solids by part, "frame" and "pad"; origin on the floor, they look along +z."""

import math

from .lofts import curve, pillow, rod, rounded_box, sweep
from .solids import moved, revolve

STAR_RADIUS = 0.3


def _castor(x, z, degrees):
    """A double wheel whose axle points the given way."""
    a = math.radians(degrees)
    axle, wheel = (math.cos(a), math.sin(a)), 0.027
    solids = [rod((x, 0.03, z), (x, 0.078, z), 0.008, 8)]
    for near, far in ((0.005, 0.021), (-0.021, -0.005)):
        solids.append(rod((x + near * axle[0], wheel - 0.001, z + near * axle[1]),
                          (x + far * axle[0], wheel - 0.001, z + far * axle[1]), wheel, 14))
    solids.append(rod((x - 0.02 * axle[0], 0.031, z - 0.02 * axle[1]),
                      (x + 0.02 * axle[0], 0.031, z + 0.02 * axle[1]), 0.012, 8))
    return solids


def five_star_base():
    """Five legs on castors, the column, and the mechanism below the seat."""
    solids = []
    for k in range(5):
        a = 2.0 * math.pi * k / 5 + 0.3
        way = (math.cos(a), math.sin(a))
        path = curve([(r * way[0], y, r * way[1]) for r, y in
                      ((0.01, 0.1), (0.1, 0.103), (0.2, 0.094), (STAR_RADIUS, 0.076))], 2)
        widths = [(0.03 - 0.013 * s / 6, 0.019 - 0.008 * s / 6) for s in range(7)]
        solids.append(sweep(path, (-way[1], 0.0, way[0]), widths, 10))
        solids += _castor(STAR_RADIUS * 0.985 * way[0], STAR_RADIUS * 0.985 * way[1],
                          72.0 * k + 40.0 + 31.0 * (k % 3))
    profile = [(0.03, 0.062), (0.042, 0.075), (0.042, 0.12), (0.028, 0.135), (0.028, 0.27),
               (0.024, 0.275), (0.016, 0.277), (0.016, 0.42)]
    solids.append(revolve(profile, 20))
    solids.append(rounded_box(0.09, 0.13, 0.392, 0.432, 0.02, 0.006))
    return solids


def _seat(half_x, half_z, thick):
    """The seat cushion: hollow along its middle, its front edge falling off."""
    def bend(x, y, z):
        drop = 1.5 * max(0.0, z - 0.08) ** 2
        return x, 0.424 + y + 0.32 * x * x - drop, z + 0.01
    return [pillow(half_x, half_z, thick, 0.09, bend, crown=0.012)]


def _back(half_x, low, high, thick, ribs=1):
    """The back cushion, bent around the sitter, with a swell for the small of the back; or so
    many ribs across instead of one cushion."""
    pitch = (high - low) / ribs
    lap = 0.006 if ribs > 1 else 0.0

    def bend_from(middle):
        def bend(x, y, z):
            height = middle + z
            swell = 0.03 * max(0.0, 1.0 - ((height - 0.17) / 0.2) ** 2)
            return (x, low + height,
                    -0.245 - 0.17 * height + swell + y * (1.0 if y > 0.0 else 0.6) + 0.55 * x * x)
        return bend
    radius = min(0.08, 0.5 * pitch)
    return [pillow(half_x, 0.5 * pitch + lap, thick, radius, bend_from((k + 0.5) * pitch),
                   crown=0.01) for k in range(ribs)]


def task_chair():
    """An office chair with arms on posts and a back on a bent bar."""
    frame = five_star_base()
    spine = curve([(0.0, 0.412, -0.05), (0.0, 0.405, -0.22), (0.0, 0.46, -0.285),
                   (0.0, 0.6, -0.262), (0.0, 0.74, -0.262)], 4)
    frame.append(sweep(spine, (1.0, 0.0, 0.0), (0.035, 0.012), 12))
    for side in (-1.0, 1.0):
        post = curve([(side * 0.07, 0.412, 0.0), (side * 0.24, 0.414, 0.0),
                      (side * 0.283, 0.45, 0.0), (side * 0.285, 0.56, 0.0),
                      (side * 0.285, 0.648, 0.0)], 4)
        frame.append(sweep(post, (0.0, 0.0, 1.0), (0.028, 0.012), 10))
        frame.append(moved(pillow(0.042, 0.13, 0.026, 0.04), (side * 0.285, 0.64, 0.015)))
    frame.append(rod((0.05, 0.412, 0.06), (0.23, 0.402, 0.075), 0.006, 8))
    return {"frame": frame, "pad": _seat(0.245, 0.235, 0.07) + _back(0.22, 0.53, 0.98, 0.055)}


def conference_chair():
    """A chair with a high back and arms that are loops."""
    frame = five_star_base()
    spine = curve([(0.0, 0.412, -0.05), (0.0, 0.405, -0.23), (0.0, 0.46, -0.295),
                   (0.0, 0.62, -0.278), (0.0, 0.8, -0.29)], 4)
    frame.append(sweep(spine, (1.0, 0.0, 0.0), (0.05, 0.012), 12))
    for side in (-1.0, 1.0):
        loop = curve([(side * 0.252, 0.45, 0.13), (side * 0.275, 0.52, 0.15),
                      (side * 0.28, 0.62, 0.15), (side * 0.28, 0.655, 0.09),
                      (side * 0.28, 0.65, -0.08), (side * 0.275, 0.655, -0.2),
                      (side * 0.222, 0.7, -0.262)], 4)
        frame.append(sweep(loop, (1.0, 0.0, 0.0), (0.022, 0.013), 10))
    pad = _seat(0.25, 0.24, 0.085) + _back(0.235, 0.5, 1.12, 0.07, 6)
    return {"frame": frame, "pad": pad}
