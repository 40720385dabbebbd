# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""smoke.gltf: smoke that rises from a bowl; its density is in the grid volume smoke.vol."""

import math

from . import furniture, gallery_parts, smoke_density
from .builder import Builder
from .solids import box, sphere

X0, X1, HEIGHT, Z0, Z1, THICK = -2.2, 2.2, 2.9, -1.9, 3.4, 0.35
WINDOW = (-1.3, 0.5, 0.9, 2.5)  # of the left wall: z, y
PEDESTAL = 0.62
BOWL_RADIUS, BOWL_HEIGHT = 0.24, 0.2
SMOKE_FOOT = (0.0, PEDESTAL + 0.1, 0.0)
SMOKE = ((24.0, 24.5, 25.5), (1.6, 1.8, 2.2), 0.35)  # per metre where the density is 1; g
LAMP = (1.55, 2.05, -1.0)

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "window": (5.2, 6.2, 7.6),
    "lamp": (62.0, 34.0, 13.0),
}

ALBEDO = {
    "plaster": (0.55, 0.53, 0.5),
    "dark wall": (0.1, 0.13, 0.16),
    "red wall": (0.42, 0.13, 0.08),
    "floor": (0.3, 0.22, 0.15),
    "stone": (0.52, 0.5, 0.46),
    "bronze": (0.34, 0.21, 0.1),
    "ash": (0.06, 0.055, 0.05),
    "iron": (0.06, 0.06, 0.065),
    "green glaze": (0.16, 0.4, 0.26),
}


def _room(room):
    ys, xs = (-0.2, HEIGHT + 0.2), (X0 - 0.15, X1 + 0.15)
    zs = (Z0 - THICK + 0.05, Z1 + THICK - 0.05)
    room.solid("left wall", "plaster", furniture.wall(zs, ys, (WINDOW,), X0, X0 - THICK, "z"))
    room.solid("right wall", "red wall", furniture.wall(zs, ys, (), X1, X1 + THICK, "z"))
    room.solid("back wall", "dark wall", furniture.wall(xs, ys, (), Z0, Z0 - THICK, "x"))
    room.solid("front wall", "plaster", furniture.wall(xs, ys, (), Z1, Z1 + THICK, "x"))
    lo, hi = (X0 - 0.25, -0.4, Z0 - 0.2), (X1 + 0.25, 0.0, Z1 + 0.2)
    room.solid("floor", "floor", [box(lo, hi)])
    room.solid("ceiling", "plaster", [box((lo[0], HEIGHT, lo[2]), (hi[0], HEIGHT + 0.4, hi[2]))])
    room.solid("window bars", "iron", furniture.window_bars(X0 - 0.1, WINDOW, 2, 2, 0.05))


def _things(room):
    room.solid("pedestal", "stone", gallery_parts.pedestal(0.5, PEDESTAL))
    room.solid("bowl", "bronze", furniture.bowl(BOWL_RADIUS, BOWL_HEIGHT),
               (0.0, PEDESTAL - 0.002, 0.0))
    room.solid("ash", "ash", [sphere(4, lambda d: 0.15 * (1.0 + 0.05 * gallery_parts.wave_height(
        tuple(2.0 * c for c in d))))], (0.0, PEDESTAL + 0.03, 0.0))
    room.solid("vase", "green glaze", gallery_parts.vase(), (-1.35, -0.01, -1.1))
    room.solid("lamp", "lamp", [sphere(3, lambda d: 0.11)], LAMP, crease_degrees=60.0)
    room.solid("lamp cord", "iron", gallery_parts.lamp_cord(HEIGHT - LAMP[1] + 0.05), LAMP)
    room.solid("bench", "stone", gallery_parts.bench(), (1.5, 0.0, -1.0))


def build():
    """The files of the scene: {name: bytes}."""
    room = Builder("Smoke", ALBEDO, RADIANCE)
    _room(room)
    _things(room)
    z0, z1, y0, y1 = WINDOW
    lap, x = 0.03, X0 - 0.25
    room.light("window", "window", [(x, y0 - lap, z0 - lap), (x, y1 + lap, z0 - lap),
                                    (x, y1 + lap, z1 + lap), (x, y0 - lap, z1 + lap)])
    room.document.set_outer_medium(*SMOKE, density={"uri": "smoke.vol",
                                                    "box": smoke_density.box(SMOKE_FOOT)})
    room.document.add_camera("camera", (0.35, 1.35, 3.1), (0.0, 1.33, 0.0), math.radians(44.0))
    text, binary = room.document.finish("smoke.bin")
    return {"smoke.gltf": text.encode("ascii"), "smoke.bin": binary,
            "smoke.vol": smoke_density.grid(SMOKE_FOOT)}
