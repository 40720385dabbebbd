# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""deskar.gltf: a desk with very many things on and around it, by a window and a lamp."""

import math

from . import desk_parts, deskar_room, deskar_things
from .builder import Builder
from .desk_books import SUNK, Books
from .desk_lamp import DeskLamp
from .forms import turn

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "window": (11.6, 12.9, 14.8),
    "bulb": (420.0, 285.0, 145.0),
}

ALBEDO = {
    "wall": (0.7, 0.67, 0.61),
    "back wall": (0.36, 0.46, 0.45),
    "ceiling": (0.76, 0.75, 0.72),
    "white": (0.74, 0.73, 0.7),
    "plank 1": (0.46, 0.31, 0.19),
    "plank 2": (0.41, 0.27, 0.16),
    "plank 3": (0.36, 0.23, 0.14),
    "oak": (0.6, 0.42, 0.25),
    "carcass": (0.52, 0.36, 0.21),
    "walnut": (0.3, 0.18, 0.1),
    "rug": (0.46, 0.17, 0.12),
    "fabric": (0.09, 0.2, 0.28),
    "steel": (0.42, 0.43, 0.44),
    "brass": (0.55, 0.4, 0.16),
    "enamel": (0.64, 0.14, 0.08),
    "shade inside": (0.72, 0.7, 0.66),
    "device": (0.12, 0.12, 0.125),
    "screen": (0.035, 0.045, 0.06),
    "key": (0.62, 0.61, 0.58),
    "key dark": (0.24, 0.25, 0.27),
    "pad": (0.1, 0.15, 0.2),
    "cork": (0.5, 0.36, 0.22),
    "glaze": (0.68, 0.66, 0.6),
    "coffee": (0.06, 0.03, 0.015),
    "paper": (0.78, 0.77, 0.73),
    "page": (0.74, 0.69, 0.58),
    "lead": (0.06, 0.06, 0.065),
    "wood": (0.66, 0.48, 0.3),
    "yellow": (0.74, 0.56, 0.1),
    "gilt": (0.62, 0.5, 0.24),
    "clay": (0.6, 0.3, 0.18),
    "soil": (0.07, 0.05, 0.035),
    "leaf": (0.1, 0.28, 0.08),
    "leaf young": (0.24, 0.42, 0.12),
    "hill far": (0.3, 0.42, 0.4),
    "hill near": (0.14, 0.28, 0.2),
    "sky blue": (0.45, 0.58, 0.68),
    "book red": (0.52, 0.1, 0.07),
    "book green": (0.1, 0.28, 0.18),
    "book blue": (0.1, 0.18, 0.42),
    "book ochre": (0.6, 0.4, 0.13),
    "book cream": (0.66, 0.6, 0.48),
    "book plum": (0.28, 0.1, 0.2),
    "ink blue": (0.2, 0.45, 0.7),
    "ink green": (0.3, 0.6, 0.3),
    "ink orange": (0.75, 0.42, 0.15),
    "ink white": (0.65, 0.68, 0.7),
}


def build():
    """The files of the scene: {name: bytes}."""
    room = Builder("Deskar", ALBEDO, RADIANCE)
    deskar_room.shell(room)
    books = Books(room)
    deskar_room.shelf(room, books)
    deskar_room.wall_things(room)
    deskar_room.around(room)
    desk_parts.desk(room, "oak", "carcass", "steel",
                    lambda side, k: 0.09 if (side, k) == (1, 2) else 0.0)
    y = desk_parts.TOP
    deskar_things.screen_work(room, (0.02, 0.55), (0.05, y - SUNK, 0.24),
                              turn(y=7.0))
    deskar_things.writing(room, y)
    deskar_things.back_of_desk(room, books, y)
    DeskLamp(room, (-0.6, y, 0.22), (-38.0, 22.0, -88.0, 72.0), "enamel", "steel",
             "shade inside", "bulb")
    room.document.add_camera("camera", (0.85, 1.55, 3.1), (-0.06, 0.83, 0.25),
                             math.radians(42.0))
    room.document.add_camera("desk", (0.35, 1.28, 1.35), (-0.06, 0.84, 0.3), math.radians(44.0))
    text, binary = room.document.finish("deskar.bin")
    return {"deskar.gltf": text.encode("ascii"), "deskar.bin": binary}
