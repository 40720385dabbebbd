# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""desk.gltf: a desk at dusk, lit by its lamp, which turns at its joints while a drawer opens."""

import math

from . import desk_parts, furniture
from . import desk_things as things
from .builder import Builder
from .desk_books import SUNK, Books
from .desk_lamp import DeskLamp
from .desk_pictures import painting
from .forms import bevelled, compound, disc, put, sheet, times, turn
from .noise import Choices
from .solids import box, sphere

X0, X1, HEIGHT, Z0, Z1, THICK = -1.5, 1.6, 2.5, -0.03, 3.0, 0.28
WINDOW = (0.75, 1.95, 0.95, 2.1)  # of the left wall: z, y
LAMP_AT = (-0.4, desk_parts.TOP, 0.2)
ANGLES = (-32.0, 20.0, -84.0, 72.0)  # of the lamp at the middle of its movement
PERIOD, KEYS = 4.0, 16
OPEN, SHUT = 0.24, 0.02  # of the drawer, metres
MOVING = (1, 2)  # the drawer

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "dusk": (6.2, 8.0, 11.5),
    "bulb": (1500.0, 1060.0, 590.0),
}

ALBEDO = {
    "wall": (0.7, 0.66, 0.58),
    "back wall": (0.54, 0.56, 0.54),
    "floor": (0.38, 0.26, 0.17),
    "white": (0.72, 0.71, 0.68),
    "cherry": (0.56, 0.32, 0.17),
    "carcass": (0.48, 0.3, 0.17),
    "steel": (0.42, 0.43, 0.44),
    "enamel": (0.12, 0.34, 0.3),
    "shade inside": (0.7, 0.68, 0.64),
    "glaze": (0.68, 0.66, 0.6),
    "coffee": (0.06, 0.03, 0.015),
    "cork": (0.5, 0.36, 0.22),
    "clay": (0.62, 0.3, 0.17),
    "paper": (0.78, 0.77, 0.73),
    "page": (0.74, 0.69, 0.58),
    "lead": (0.06, 0.06, 0.065),
    "walnut": (0.3, 0.18, 0.1),
    "wood": (0.66, 0.48, 0.3),
    "yellow": (0.74, 0.56, 0.1),
    "gilt": (0.62, 0.5, 0.24),
    "felt": (0.1, 0.2, 0.16),
    "book red": (0.52, 0.1, 0.07),
    "book green": (0.1, 0.28, 0.18),
    "book blue": (0.1, 0.18, 0.42),
    "book ochre": (0.6, 0.4, 0.13),
    "book cream": (0.66, 0.6, 0.48),
    "book plum": (0.28, 0.1, 0.2),
}


def _shell(room):
    ys, xs = (-0.2, HEIGHT + 0.2), (X0 - 0.15, X1 + 0.15)
    zs = (Z0 - THICK + 0.05, Z1 + THICK - 0.05)
    room.solid("left wall", "wall", furniture.wall(zs, ys, (WINDOW,), X0, X0 - THICK, "z"))
    room.solid("right wall", "wall", furniture.wall(zs, ys, (), X1, X1 + THICK, "z"))
    room.solid("back wall", "back wall", furniture.wall(xs, ys, (), Z0, Z0 - THICK, "x"))
    room.solid("front wall", "wall", furniture.wall(xs, ys, (), Z1, Z1 + THICK, "x"))
    lo, hi = (X0 - 0.22, -0.4, Z0 - 0.2), (X1 + 0.22, 0.0, Z1 + 0.2)
    room.solid("floor", "floor", [box(lo, hi)])
    room.solid("ceiling", "white", [box((lo[0], HEIGHT, lo[2]), (hi[0], HEIGHT + 0.4, hi[2]))])
    room.solid("window bars", "white", furniture.window_bars(X0 - 0.12, WINDOW, 1, 1, 0.05))
    rail = [bevelled((X0 - 0.05, y, Z0 - 0.04), (X1 + 0.05, y + h, Z0 + d), 0.004)
            for y, h, d in ((-0.01, 0.1, 0.016), (0.98, 0.05, 0.02))]
    room.solid("rails", "white", rail, crease_degrees=50.0)
    z0, z1, y0, y1 = WINDOW
    lap, x = 0.03, X0 - 0.2
    room.light("dusk", "dusk", [(x, y0 - lap, z0 - lap), (x, y1 + lap, z0 - lap),
                                (x, y1 + lap, z1 + lap), (x, y0 - lap, z1 + lap)])


def _on_the_desk(room, books):
    y = desk_parts.TOP
    low, choices = y - SUNK, Choices(6)
    room.solid("felt", "felt", [bevelled((-0.36, low, 0.27), (0.3, y + 0.003, 0.7), 0.001)],
               crease_degrees=50.0)
    pages, cover = things.open_book(0.33, 0.23, 0.018)
    opened = put(room, "open book", compound(room, "open book", [
        ("page", pages, 40.0), ("book red", cover, 50.0)]), (-0.06, y + 0.0024, 0.46),
        turn(y=-7.0))
    line = compound(room, "line of text", [("lead", [sheet(1.0, 0.0022, 0.0008)], 35.0)])
    for side in (-1, 1):
        for row in range(15):
            wide = 0.06 if row in (6, 14) else 0.1
            put(room, "line", line, (side * 0.078 + 0.5 * (wide - 0.1), 0.0169,
                                     -0.085 + 0.012 * row), turn(z=-side * 2.0),
                (wide, 1.0, 1.0), opened)
    top = books.pile((0.48, y, 0.33), ((0.042, 0.24, 0.17), (0.034, 0.225, 0.16),
                                       (0.028, 0.2, 0.14)), choices)
    room.solid("clay ball", "clay", [sphere(4, lambda d: 0.045)],
               (0.475, top + 0.0445, 0.33), crease_degrees=60.0)
    last = books.row(-0.76, -0.56, y, 0.21, Choices(15), 0.24)
    room.solid("book end", "steel", [
        bevelled((last + 0.0004, low, 0.08), (last + 0.0034, y + 0.13, 0.2), 0.0008),
        bevelled((last + 0.001, low - 0.0002, 0.0805), (last + 0.1, y + 0.0016, 0.1995), 0.0005)],
        crease_degrees=50.0)
    put(room, "mug", compound(room, "mug", [
        ("glaze", things.mug(), 50.0), ("coffee", things.coffee(), 50.0)]), (0.22, low, 0.2),
        turn(y=-40.0))
    _pencils(room, (0.05, low, 0.15), choices)
    paper = compound(room, "paper", [("paper", [sheet(0.21, 0.297, 0.0009)], 35.0)])
    for k in range(7):
        put(room, "paper", paper, (-0.55 + choices.between(-0.008, 0.008), y - 0.0002 + 0.0008 * k,
                                   0.52 + choices.between(-0.008, 0.008)),
            turn(y=8.0 + choices.between(-6.0, 6.0)))
    room.solid("weight", "book cream", [disc(0.03, y + 0.0045, y + 0.03, 0.005, 32)],
               (-0.58, 0.0, 0.56), crease_degrees=50.0)


def _pencils(room, cup, choices):
    pencil = compound(room, "pencil", [("yellow", things.pencil_body(0.175), 35.0),
                                       ("wood", things.pencil_wood(), 60.0),
                                       ("lead", things.pencil_lead(), 60.0)])
    room.solid("cup", "cork", things.cup(0.038, 0.1), cup, crease_degrees=50.0)
    for k in range(7):
        angle = 360.0 * k / 7
        put(room, "pencil", pencil, (cup[0] - 0.012 * math.sin(math.radians(angle)),
                                     cup[1] + 0.005 + 0.0005 * k,
                                     cup[2] - 0.012 * math.cos(math.radians(angle))),
            times(turn(y=angle), turn(x=choices.between(6.0, 12.0))))
    put(room, "pencil", pencil, (0.1, desk_parts.TOP + 0.0062, 0.6),
        times(turn(y=-28.0), turn(z=-90.0)))


def _in_the_drawer(room, drawer):
    """What slides with it: a notebook, a box and a ball."""
    floor = 0.028 - SUNK
    put(room, "notebook", compound(room, "notebook", [
        ("book blue", [bevelled((-0.07, 0.0, -0.1), (0.07, 0.02, 0.1), 0.002)], 50.0)]),
        (-0.06, floor, -0.14), turn(y=9.0), None, drawer)
    put(room, "small box", compound(room, "small box", [
        ("book ochre", [bevelled((-0.05, 0.0, -0.07), (0.05, 0.06, 0.07), 0.003)], 50.0)]),
        (0.09, floor, -0.11), turn(y=-6.0), None, drawer)


def _pose(phase):
    """The rotations of the lamp's joints at a phase of the period in [0, 1]."""
    def wave(turns, shift=0.0):
        return math.sin(2.0 * math.pi * (turns * phase + shift))

    stand, lower, upper, head = ANGLES
    lean = 7.0 * wave(1, 0.1)
    return {"stand": turn(y=stand + 20.0 * wave(1)), "lower": turn(z=lower + lean),
            "upper": turn(z=upper - 1.6 * lean + 4.0 * wave(2, 0.3)),
            "head": turn(z=head + 14.0 * wave(1, -0.2))}


def _animate(room, lamp, drawer):
    """At rest all is as at the first key."""
    def keys(phase):
        return {name: tuple(round(c, 6) for c in q) for name, q in _pose(phase).items()}

    nodes = {"stand": lamp.stand, "lower": lamp.lower, "upper": lamp.upper, "head": lamp.head}
    for name, rotation in keys(0.0).items():
        room.document.json["nodes"][nodes[name]]["rotation"] = list(rotation)
    times_of = tuple(PERIOD * k / KEYS for k in range(KEYS + 1))
    poses = [keys(k % KEYS / KEYS) for k in range(KEYS + 1)]
    channels = [(nodes[name], "rotation", times_of, [pose[name] for pose in poses], "LINEAR")
                for name in nodes]
    still = (0.0, 0.0, 0.0)
    slide = [row for out in (OPEN, SHUT, OPEN) for row in (
        still, tuple(round(c, 6) for c in desk_parts.drawer_place(*MOVING, out)), still)]
    channels.append((drawer, "translation", (0.0, 0.5 * PERIOD, PERIOD), slide, "CUBICSPLINE"))
    room.document.add_animation("lamp and drawer", channels)


def build():
    """The files of the scene: {name: bytes}."""
    room = Builder("Desk", ALBEDO, RADIANCE)
    _shell(room)
    drawers = desk_parts.desk(room, "cherry", "carcass", "steel",
                              lambda side, k: OPEN if (side, k) == MOVING else 0.0)
    _on_the_desk(room, Books(room))
    painting(room, (0.32, 1.3, Z0), 0.36, 0.3, (("book ochre", -0.06, 0.02, 0.075),
                                                ("book green", 0.06, -0.03, 0.06)))
    _in_the_drawer(room, drawers[MOVING])
    lamp = DeskLamp(room, LAMP_AT, ANGLES, "enamel", "steel", "shade inside", "bulb")
    _animate(room, lamp, drawers[MOVING])
    room.document.add_camera("camera", (0.42, 1.68, 1.85), (0.02, 0.8, 0.28), math.radians(42.0))
    text, binary = room.document.finish("desk.bin")
    return {"desk.gltf": text.encode("ascii"), "desk.bin": binary}
