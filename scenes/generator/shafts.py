# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""shafts.gltf: a reading room full of haze, with shafts of sunlight from its barred windows."""

import math

from . import furniture, gallery_parts
from .builder import Builder
from .solids import box, finish, moved

# The room's inside, and how thick its walls are.
X0, X1, HEIGHT, Z0, Z1, THICK = -2.5, 2.5, 3.3, -3.8, 3.6, 0.45
WINDOWS = tuple((z - 0.36, z + 0.36, 0.9, 2.8) for z in (-2.75, -0.55))  # z, z, y, y
SIDE_WINDOW = (0.3, 2.1, 1.1, 2.75)  # of the left wall, out of sight

SUN_WAY = (-0.8, -0.5, 0.26)  # of its light; not of unit length
SUN_AIM, SUN_DISTANCE = (2.7, 1.85, -1.65), 14.0
SUN_INTENSITY = 11000.0
HAZE = ((0.06, 0.06, 0.06), (0.003, 0.003, 0.003), 0.4)  # scattering, absorption, g

RADIANCE = {"sky": (4.6, 5.8, 7.6)}  # W/(m^2 sr), linear Rec.709

ALBEDO = {
    "plaster": (0.7, 0.66, 0.58),
    "back wall": (0.3, 0.38, 0.36),
    "beam": (0.32, 0.21, 0.13),
    "oak": (0.52, 0.35, 0.2),
    "walnut": (0.33, 0.19, 0.1),
    "rug": (0.42, 0.12, 0.08),
    "plank 1": (0.5, 0.35, 0.22),
    "plank 2": (0.44, 0.3, 0.19),
    "plank 3": (0.39, 0.26, 0.16),
    "book 1": (0.45, 0.1, 0.06),
    "book 2": (0.1, 0.24, 0.16),
    "book 3": (0.5, 0.36, 0.12),
    "book 4": (0.1, 0.14, 0.3),
    "book 5": (0.55, 0.5, 0.4),
    "blue glaze": (0.08, 0.2, 0.42),
    "clay": (0.6, 0.3, 0.16),
}
SHELF = (2.3, 2.35, 0.3, 6)  # width, height, depth, levels
TABLE_AT, TABLE_HEIGHT = (-0.35, 0.0, -0.55), 0.76


def _shell(room):
    walls = (X0 - 0.2, X1 + 0.2), (-0.2, HEIGHT + 0.2)
    ends = (Z0 - THICK + 0.05, Z1 + THICK - 0.05)
    room.solid("window wall", "plaster",
               furniture.wall(ends, walls[1], WINDOWS, X1, X1 + THICK, "z"))
    room.solid("left wall", "plaster",
               furniture.wall(ends, walls[1], (SIDE_WINDOW,), X0, X0 - THICK, "z"))
    room.solid("back wall", "back wall",
               furniture.wall(walls[0], walls[1], (), Z0, Z0 - THICK, "x"))
    room.solid("front wall", "plaster",
               furniture.wall(walls[0], walls[1], (), Z1, Z1 + THICK, "x"))
    lo, hi = (X0 - 0.3, -0.5, Z0 - 0.35), (X1 + 0.35, -0.05, Z1 + 0.35)
    room.solid("ground", "beam", [box(lo, hi)])
    room.solid("ceiling", "plaster", [box((lo[0], HEIGHT, lo[2]), (hi[0], HEIGHT + 0.4, hi[2]))])
    for k in range(3):
        room.solid(f"planks {k + 1}", f"plank {k + 1}",
                   furniture.planks(X0 - 0.1, X1 + 0.1, Z0 - 0.1, Z1 + 0.1, 0.13, k, 3))
    beams = [box((X0 - 0.1, HEIGHT - 0.2, z - 0.09), (X1 + 0.1, HEIGHT + 0.05, z + 0.09))
             for z in (-3.2, -2.03, -0.37, 1.27, 2.6)]
    room.solid("beams", "beam", beams)
    room.solid("skirting", "oak", [box((X0 - 0.05, -0.01, Z0 - 0.1), (X0 + 0.02, 0.13, Z1 + 0.1)),
                                   box((X1 - 0.02, -0.01, Z0 - 0.1), (X1 + 0.05, 0.13, Z1 + 0.1)),
                                   box((X0 - 0.1, -0.012, Z0 - 0.05), (X1 + 0.1, 0.128, Z0 + 0.02))])
    bars = [bar for window in WINDOWS
            for bar in furniture.window_bars(X1 + 0.26, window, 1, 2, 0.1)]
    sills = [box((X1 - 0.06, w[2] - 0.05, w[0] - 0.05), (X1 + 0.2, w[2] + 0.012, w[1] + 0.05))
             for w in WINDOWS]
    room.solid("bars", "walnut", bars + sills)


def _furniture(room):
    at = (-0.9, 0.0, Z0 + 0.03)
    room.solid("shelf", "walnut", furniture.shelf(*SHELF), at)
    for k in range(furniture.BOOK_COLOURS):
        room.solid(f"books {k + 1}", f"book {k + 1}", furniture.books(*SHELF, k), at)
    room.solid("rug", "rug", furniture.rug(3.0, 2.0), (-0.35, 0.0, -0.5))
    room.solid("table", "oak", furniture.table(1.9, 0.9, TABLE_HEIGHT), TABLE_AT)
    chair = room.mesh("chair", "walnut", finish(furniture.chair()))
    for k, (x, z, degrees) in enumerate(((-0.75, -1.25, 8.0), (-1.0, 0.15, 160.0),
                                         (-2.05, 1.3, 75.0))):
        half = 0.5 * math.radians(degrees)
        room.place(f"chair {k + 1}", chair, (x, 0.0, z),
                   (0.0, math.sin(half), 0.0, math.cos(half)))
    x, y, z = TABLE_AT[0], TABLE_HEIGHT, TABLE_AT[2]
    scale = 0.36
    vase = [([tuple(scale * c for c in p) for p in positions], triangles)
            for positions, triangles in gallery_parts.vase()]
    room.solid("vase", "blue glaze", vase, (x - 0.42, y - 0.002, z - 0.1))
    room.solid("bowl", "clay", furniture.bowl(0.15, 0.11), (x + 0.5, y - 0.002, z - 0.06))
    pile = ((0.0, 0.24, 0.17, 0.045, 1), (0.01, 0.21, 0.15, 0.035, 3), (-0.012, 0.2, 0.14, 0.03, 4))
    top = y - 0.001
    for shift, length, width, thick, colour in pile:
        lo, hi = (-0.5 * length, 0.0, -0.5 * width), (0.5 * length, thick, 0.5 * width)
        room.solid("book", f"book {colour}", [moved(box(lo, hi), (shift, 0.0, shift))],
                   (x + 0.05, top, z + 0.12))
        top += thick + 0.001


def _lights(room):
    length = math.sqrt(sum(c * c for c in SUN_WAY))
    sun = tuple(round(a - SUN_DISTANCE * c / length, 6) for a, c in zip(SUN_AIM, SUN_WAY))
    room.document.add_spot("sun", sun, SUN_AIM, (1.0, 0.84, 0.62), SUN_INTENSITY,
                           math.radians(7.5), math.radians(8.5))
    z0, z1, y0, y1 = SIDE_WINDOW
    lap, x = 0.03, X0 - 0.3
    room.light("sky", "sky", [(x, y0 - lap, z0 - lap), (x, y1 + lap, z0 - lap),
                              (x, y1 + lap, z1 + lap), (x, y0 - lap, z1 + lap)])
    room.boundary("haze", (X0 - 0.1, -0.1, Z0 - 0.1), (X1 + 0.1, HEIGHT + 0.1, Z1 + 0.1), *HAZE)


def build():
    """The files of the scene: {name: bytes}."""
    room = Builder("Shafts of light", ALBEDO, RADIANCE)
    _shell(room)
    _furniture(room)
    _lights(room)
    room.document.add_camera("camera", (0.9, 1.5, 3.4), (0.3, 1.3, -2.2), math.radians(54.0))
    text, binary = room.document.finish("shafts.bin")
    return {"shafts.gltf": text.encode("ascii"), "shafts.bin": binary}
