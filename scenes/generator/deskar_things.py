# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What is on the desk of deskar.gltf, on the shelf above it and on the wall."""

import math

from . import desk_devices as devices
from . import desk_things as things
from .desk_books import SUNK
from .desk_pictures import photograph
from .forms import bevelled, cable, compound, cushion, put, repainted, sheet, times, turn
from .noise import Choices
from .solids import moved


def screen_work(room, parts, at, rotation):
    """The monitor, what it shows and its keyboard and mouse."""
    node = put(room, "monitor", compound(room, "monitor", [("device", devices.monitor(), 50.0)]),
               at, rotation)
    x, y = 0.5 * devices.SCREEN[0] + 0.004, 0.5 * devices.SCREEN[1] + 0.004
    z, middle = devices.SCREEN_Z, devices.SCREEN_Y
    screen = bevelled((-x, middle - y, 0.0), (x, middle + y, z), 0.001)
    put(room, "screen", compound(room, "screen", [("screen", [screen], 50.0)]), parent=node)
    bar = compound(room, "line", [("ink blue", [sheet(1.0, 1.0, 0.0016)], 35.0)])
    colours = [bar] + [repainted(room, "line", bar, {"ink blue": c}) for c in (
        "ink green", "ink orange", "ink white")]
    choices = Choices(19)
    facing = turn(x=90.0)
    for row in range(17):
        start = -0.255 + 0.018 * int(choices.between(0.0, 4.0))
        for _ in range(1 + int(choices.between(0.0, 4.0))):
            wide = choices.between(0.02, 0.09)
            if start + wide > 0.11:
                break
            put(room, "text", colours[int(choices.between(0.0, 4.0))],
                (start + 0.5 * wide, middle + 0.138 - 0.017 * row, z - 0.0004), facing,
                (wide, 1.0, 0.0065), node)
            start += wide + 0.009
    for k, (h, c) in enumerate(((0.05, 0), (0.09, 1), (0.07, 2), (0.12, 3), (0.1, 0), (0.15, 2))):
        put(room, "chart", colours[c], (0.143 + 0.02 * k, middle - 0.1 + 0.5 * h, z - 0.0004),
            facing, (0.013, 1.0, h), node)
    put(room, "panel", colours[3], (0.193, middle + 0.09, z - 0.0004), facing, (0.12, 1.0, 0.05),
        node)
    _keyboard(room, (parts[0], at[1], parts[1]))


def _keyboard(room, at):
    x, y, z = at
    node = put(room, "keyboard", compound(room, "keyboard", [
        ("device", devices.keyboard(), 50.0)]), (x, y - SUNK, z), turn(y=-3.0))
    key = compound(room, "key", [("key", devices.key(), 40.0)])
    accent = repainted(room, "key", key, {"key": "key dark"})
    slope = turn(x=math.degrees(math.atan2(0.012, devices.KEYBOARD[1])))
    for kx, ky, kz, wide, row, number in devices.keys():
        dark = row == 0 or (wide > 1.1 and wide < 5.0) or (row == 5 and number != 3)
        scale = ((wide * devices.PITCH - 0.0018) / 0.0172, 1.0, 1.0)
        put(room, "key", accent if dark else key, (kx, ky, kz), slope, scale, node)
    mouse = (x + 0.29, y + 0.0028, z + 0.02)
    put(room, "mouse pad", compound(room, "mouse pad", [
        ("pad", [cushion(0.22, 0.2, 0.004, 0.012, 0.0012, 3)], 50.0)]),
        (mouse[0], y - SUNK, mouse[2] + 0.01), turn(y=4.0))
    put(room, "mouse", compound(room, "mouse", [("key dark", devices.mouse(), 60.0)]), mouse,
        turn(y=10.0))
    tail = [(p[0], p[1], p[2]) for p in devices.mouse_cable(
        (mouse[0], y + 0.0052, mouse[2] - 0.04), (mouse[0] + 0.02, y, mouse[2] - 0.2),
        (mouse[0] - 0.16, y, 0.1))]
    room.solid("mouse cable", "device", [cable(tail, 0.0016, 6)], crease_degrees=80.0)


def writing(room, y):
    """Pens in a cup, mug, open book, papers, notebook and small things on the desk at height y."""
    choices, low = Choices(23), y - SUNK
    pencil = compound(room, "pencil", [("yellow", things.pencil_body(0.175), 35.0),
                                       ("wood", things.pencil_wood(), 60.0),
                                       ("lead", things.pencil_lead(), 60.0)])
    pens = [pencil] + [repainted(room, "pencil", pencil, {"yellow": c}) for c in (
        "book red", "book green", "book blue")]
    pen = compound(room, "pen", [("lead", things.pen(), 40.0)])
    pens += [pen, repainted(room, "pen", pen, {"lead": "book blue"})]
    cup = (-0.34, low, 0.2)
    put(room, "cup", compound(room, "cup", [("cork", things.cup(0.04, 0.1), 50.0)]), cup)
    for k in range(11):
        angle, lean = 360.0 * k / 11, choices.between(6.0, 12.0)
        put(room, "pencil", pens[k % len(pens)], (
            cup[0] - 0.012 * math.sin(math.radians(angle)), y + 0.004 + 0.0004 * k,
            cup[2] - 0.012 * math.cos(math.radians(angle))),
            times(turn(y=angle), turn(x=lean)))
    mug = compound(room, "mug", [("glaze", things.mug(), 50.0), ("coffee", things.coffee(), 50.0)])
    put(room, "mug", mug, (-0.24, low, 0.47), turn(y=-35.0))
    pages, cover = things.open_book(0.3, 0.21, 0.016)
    opened = put(room, "open book", compound(room, "open book", [
        ("page", pages, 40.0), ("book green", cover, 50.0)]), (-0.54, low, 0.49), turn(y=16.0))
    line = compound(room, "line of text", [("lead", [sheet(1.0, 0.0022, 0.0008)], 35.0)])
    for side in (-1, 1):
        for row in range(14):
            wide = 0.045 if row in (5, 13) else 0.088
            put(room, "line", line, (side * 0.07 + 0.5 * (wide - 0.088), 0.0152,
                                     -0.078 + 0.0115 * row), turn(z=-side * 2.0),
                (wide, 1.0, 1.0), opened)
    lying = times(turn(y=118.0), turn(z=90.0))
    put(room, "pencil", pens[0], (-0.62, y + 0.0034, 0.66), times(turn(y=24.0), turn(z=-90.0)))
    put(room, "pen", pen, (0.47, y + 0.0185, 0.55), lying)
    _papers(room, y, choices)
    clip = compound(room, "clip", [("steel", things.clip(), 80.0)])
    for _ in range(9):
        put(room, "clip", clip, (choices.between(-0.1, 0.02), y, choices.between(0.64, 0.7)),
            turn(y=choices.between(0.0, 360.0)))
    put(room, "scissors", compound(room, "scissors", [("steel", things.scissors(), 50.0)]),
        (0.22, low, 0.675), turn(y=-14.0))


def _papers(room, y, choices):
    """A pile of paper, a notebook and a block of notes, at the right of the desk."""
    paper = compound(room, "paper", [("paper", [sheet(0.21, 0.297, 0.0009)], 35.0)])
    for k in range(9):
        put(room, "paper", paper, (0.6 + choices.between(-0.008, 0.008), y - 0.0002 + 0.0008 * k,
                                   0.53 + choices.between(-0.01, 0.01)),
            turn(y=choices.between(-7.0, 9.0)))
    x, z, top = 0.58, 0.52, y + 0.0069
    solids = [bevelled((-0.075, 0.0, -0.1), (0.075, 0.0105, 0.1), 0.001)]
    note = put(room, "notebook", compound(room, "notebook", [
        ("book plum", [bevelled((-0.077, 0.0098, -0.1), (0.077, 0.012, 0.102), 0.0006)], 50.0),
        ("page", solids, 50.0),
        ("steel", [moved(s, (0.0, 0.0055, -0.1)) for s in things.coil(17, 0.0085, 0.0085)], 80.0)]),
        (x, top - SUNK, z), turn(y=-12.0))
    put(room, "label", compound(room, "label", [("paper", [sheet(0.07, 0.035, 0.001)], 35.0)]),
        (0.0, 0.0116, -0.03), parent=note)
    notes = compound(room, "notes", [("yellow", [sheet(0.075, 0.075, 0.012)], 35.0)])
    put(room, "notes", notes, (0.42, y - SUNK, 0.68), turn(y=11.0))


def back_of_desk(room, books, y):
    """Books against book ends, a photograph and a small plant at the back of the desk."""
    low, choices = y - SUNK, Choices(5)
    end = compound(room, "book end", [("steel", [
        bevelled((-0.001, 0.0, -0.06), (0.0015, 0.14, 0.06), 0.0005),
        bevelled((-0.0005, -0.0003, -0.0595), (0.1, 0.0012, 0.0595), 0.0005)], 50.0)])
    put(room, "book end", end, (0.448, low, 0.16), turn(y=0.0))
    last = books.row(0.4512, 0.68, y + 0.001, 0.235, choices, 0.235)
    put(room, "book end", end, (last + 0.0012, low, 0.16), turn(y=180.0))
    photograph(room, (-0.7, low, 0.16), turn(x=-14.0, y=30.0))
    top = books.pile((0.72, y, 0.22), ((0.035, 0.2, 0.145), (0.028, 0.185, 0.13)), Choices(2))
    return top
