# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Books in rows and piles."""

import math

from . import desk_things as things
from .forms import compound, put, repainted, times, turn

COVERS = ("book red", "book green", "book blue", "book ochre", "book cream", "book plum")
SUNK = 0.0006  # by which a thing reaches into what it stands on


class Books:
    """Books of all colours, one form stored once."""

    def __init__(self, room):
        self._room = room
        first = compound(room, "book", [(COVERS[0], things.book_cover(), 40.0),
                                        ("page", things.book_pages(), 35.0),
                                        ("gilt", things.book_label(), 40.0)])
        self._meshes = [first] + [repainted(room, "book", first, {COVERS[0]: cover})
                                  for cover in COVERS[1:]]

    def put(self, which, at, size, rotation=None):
        put(self._room, "book", self._meshes[which % len(COVERS)], at, rotation, size)

    def row(self, x0, x1, y, z, choices, tallest):
        """Standing books from x0 to x1, whose backs are about at z; where the row ends."""
        x, last = x0, -1
        while True:
            thick, tall = choices.between(0.016, 0.042), tallest * choices.between(0.68, 1.0)
            deep, which = choices.between(0.13, 0.165), int(choices.between(0.0, len(COVERS)))
            if which == last:
                which += 1
            if x + thick > x1:
                return x
            self.put(which, (x + 0.5 * thick, y - SUNK, z - deep + choices.between(-0.006, 0.006)),
                     (thick, tall, deep))
            x, last = x + thick + 0.0015, which % len(COVERS)

    def pile(self, at, sizes, choices):
        """Lying books, the largest first; the height of the top."""
        x, y, z = at
        for number, (thick, height, depth) in enumerate(sizes):
            swing = choices.between(-9.0, 9.0)
            turned = times(turn(y=swing), turn(z=90.0))
            c, s = math.cos(math.radians(swing)), math.sin(math.radians(swing))
            corner = (0.5 * height, 0.5 * depth)
            self.put(number * 2 + 1, (x + c * corner[0] - s * corner[1], y + 0.5 * thick - SUNK,
                                      z - s * corner[0] - c * corner[1]),
                     (thick, height, depth), turned)
            y += thick - SUNK
        return y
