# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Furniture and parts of rooms, each a list of closed solids in metres, +y up."""

import math

from .noise import Choices
from .solids import box, plate, revolve

BOOK_COLOURS = 5


def wall(columns, rows, openings, near, far, along):
    """A wall between the planes `near` and `far` of one axis, 'x' or 'z' the one it runs along;
    the openings are (first, last, y0, y1)."""
    us = sorted({*columns, *(u for o in openings for u in o[:2])})
    ys = sorted({*rows, *(y for o in openings for y in o[2:])})

    def keep(i, j):
        return not any(o[0] <= us[i] < o[1] and o[2] <= ys[j] < o[3] for o in openings)

    def face(depth):
        if along == "x":
            return lambda u, y: (u, y, depth)
        return lambda u, y: (depth, y, u)

    return [plate(us, ys, face(near), face(far), keep)]


def window_bars(x, opening, upright, across, thickness):
    """Bars in an opening of a wall that runs along z: `upright` and `across` of them."""
    z0, z1, y0, y1 = opening
    half, lap = 0.5 * thickness, 0.02
    bars = []
    for k in range(1, upright + 1):
        z = z0 + (z1 - z0) * k / (upright + 1)
        bars.append(box((x - half, y0 - lap, z - half), (x + half, y1 + lap, z + half)))
    slim = 0.8 * half
    for k in range(1, across + 1):
        y = y0 + (y1 - y0) * k / (across + 1)
        bars.append(box((x - slim, y - slim, z0 - lap), (x + slim, y + slim, z1 + lap)))
    return bars


def planks(x0, x1, z0, z1, width, shade, shades):
    """Every plank of a floor that falls to one of the shades; all planks run along z."""
    choices, found = Choices(3), []
    for k in range(round((x1 - x0) / width)):
        which = int(choices.between(0.0, shades))
        drop = choices.between(0.0, 0.003)
        if which == shade:
            x = x0 + k * width
            found.append(box((x + 0.002, -0.06, z0), (x + width - 0.002, -drop, z1)))
    return found


def _turned_leg(height):
    profile = [(0.028, -0.01), (0.034, 0.05), (0.024, 0.09), (0.03, 0.16), (0.042, 0.34),
               (0.04, 0.46), (0.026, 0.52), (0.038, 0.55), (0.038, height)]
    return revolve(profile, 16)


def table(length, width, height):
    """A table with turned legs, its length along x; origin on the floor."""
    x, z = 0.5 * length, 0.5 * width
    solids = [box((-x, height - 0.045, -z), (x, height, z)),
              box((-x + 0.08, height - 0.14, -z + 0.08), (x - 0.08, height - 0.04, z - 0.08))]
    for sx in (-1.0, 1.0):
        for sz in (-1.0, 1.0):
            at = (sx * (x - 0.12), 0.0, sz * (z - 0.12))
            positions, triangles = _turned_leg(height - 0.1)
            solids.append(([tuple(p[i] + at[i] for i in range(3)) for p in positions], triangles))
    return solids


def chair():
    """A chair that looks along +z; origin on the floor."""
    half, seat = 0.21, 0.46
    solids = [box((-half - 0.01, seat - 0.035, -half - 0.01), (half + 0.01, seat, half + 0.02))]
    for sx in (-1.0, 1.0):
        x = sx * (half - 0.02)
        solids += [box((x - 0.02, -0.01, half - 0.04), (x + 0.02, seat - 0.02, half)),
                   box((x - 0.02, -0.01, -half), (x + 0.02, 0.98, -half + 0.04)),
                   box((x - 0.012, 0.2, -half + 0.02), (x + 0.012, 0.23, half - 0.02))]
    for y in (0.62, 0.74, 0.86):
        solids.append(box((-half + 0.01, y, -half + 0.008), (half - 0.01, y + 0.07, -half + 0.03)))
    return solids


def shelf(width, height, depth, levels):
    """A bookcase without a back, along x, that opens towards +z; origin on the floor."""
    x, board = 0.5 * width, 0.03
    solids = [box((-x, -0.01, 0.0), (-x + board, height, depth)),
              box((x - board, -0.01, 0.0), (x, height, depth)),
              box((-x - 0.03, height - 0.01, -0.01), (x + 0.03, height + 0.04, depth + 0.03))]
    for k in range(levels):
        y = 0.06 + (height - 0.06) * k / levels
        solids.append(box((-x + 0.01, y, 0.005), (x - 0.01, y + board, depth - 0.01)))
    return solids


def books(width, height, depth, levels, colour):
    """The books of one colour in a `shelf` of these measures."""
    choices, found = Choices(7), []
    for k in range(levels):
        y = 0.06 + (height - 0.06) * k / levels + 0.029
        room = (height - 0.06) / levels - 0.06
        x, end = -0.5 * width + 0.04, 0.5 * width - 0.05
        while x < end - 0.05:
            thick = choices.between(0.02, 0.055)
            tall = room * choices.between(0.66, 0.97)
            deep = depth * choices.between(0.62, 0.84)
            which, gap = int(choices.between(0.0, BOOK_COLOURS)), choices.between(0.0, 1.0)
            if which == colour:
                found.append(box((x, y, 0.02), (x + thick, y + tall, 0.02 + deep)))
            x += thick + (0.002 if gap < 0.93 else choices.between(0.08, 0.22))
    return found


def bowl(radius, height):
    """A footed bowl, open at the top; origin at its foot."""
    outside = [(0.42, 0.0), (0.45, 0.05), (0.3, 0.12), (0.26, 0.2), (0.42, 0.3), (0.74, 0.48),
               (0.93, 0.72), (1.0, 1.0)]
    inside = [(0.95, 1.0), (0.87, 0.74), (0.68, 0.54), (0.36, 0.42), (0.12, 0.39)]
    return [revolve([(radius * r, height * y) for r, y in outside + inside], 56)]


def rug(length, width):
    """A carpet along x with fringes at both ends; origin on the floor."""
    x, z, count = 0.5 * length, 0.5 * width, 48
    solids = [box((-x, -0.002, -z), (x, 0.014, z))]
    for k in range(count):
        at = -z + width * (k + 0.5) / count
        for end in (-x, x):
            outer = end + math.copysign(0.07, end)
            solids.append(box((min(end, outer), -0.002, at - 0.006),
                              (max(end, outer), 0.006, at + 0.006)))
    return solids
