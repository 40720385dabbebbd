# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""office.gltf: a furnished office with a little sun. office-pm.gltf: the same, filled with haze."""

import math

from . import furniture, office_parts as things, room_parts as parts, seating
from .builder import Builder, light_quad
from .lofts import turn_about_y
from .solids import box, finish, moved

# The room's inside, and how thick its walls are.
X0, X1, HEIGHT, Z0, Z1, THICK = -2.7, 2.7, 2.75, -2.4, 3.0, 0.25
WINDOW = (-1.95, -0.35, 0.98, 2.32)  # of the left wall: z, z, y, y
SUN_WINDOW = (0.55, 1.75, 0.98, 2.32)  # likewise, out of sight
DOOR_X = 1.66
PANELS = ((-1.5, -0.9, -1.2, 0.0), (0.9, 1.5, -1.2, 0.0))  # cells of the ceiling: x, x, z, z

SUN_AIM, SUN_WAY, SUN_DISTANCE = (-2.7, 1.7, 1.15), (0.83, -0.47, -0.42), 14.0
SUN_INTENSITY = 2100.0
# Scattering, absorption, g: an optical depth of 0.55 from the camera to the far wall.
HAZE = ((0.11, 0.11, 0.11), (0.004, 0.004, 0.004), 0.4)

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "panel": (13.0, 12.6, 11.6),
    "sky": (0.62, 0.78, 0.98),
    "bulb": (60.0, 44.0, 26.0),
}

ALBEDO = {
    "plaster": (0.74, 0.71, 0.65),
    "blue wall": (0.34, 0.45, 0.5),
    "ceiling": (0.8, 0.8, 0.78),
    "ceiling bar": (0.68, 0.68, 0.67),
    "carpet": (0.34, 0.33, 0.32),
    "rug": (0.33, 0.12, 0.1),
    "rug stripe": (0.6, 0.46, 0.27),
    "oak": (0.5, 0.33, 0.19),
    "walnut": (0.3, 0.18, 0.1),
    "beech": (0.6, 0.45, 0.29),
    "white paint": (0.76, 0.75, 0.72),
    "white laminate": (0.72, 0.71, 0.68),
    "grey laminate": (0.45, 0.46, 0.47),
    "dark metal": (0.13, 0.13, 0.14),
    "steel": (0.5, 0.5, 0.51),
    "dark plastic": (0.08, 0.08, 0.085),
    "green metal": (0.25, 0.36, 0.31),
    "green fronts": (0.29, 0.41, 0.35),
    "red enamel": (0.55, 0.09, 0.06),
    "screen": (0.12, 0.24, 0.33),
    "paper": (0.8, 0.79, 0.75),
    "orange": (0.72, 0.34, 0.08),
    "blue glaze": (0.1, 0.22, 0.42),
    "chair cloth": (0.13, 0.2, 0.34),
    "slat": (0.62, 0.6, 0.55),
    "clay": (0.6, 0.3, 0.18),
    "soil": (0.09, 0.06, 0.04),
    "leaf": (0.13, 0.32, 0.09),
    "book 1": (0.45, 0.1, 0.06),
    "book 2": (0.1, 0.24, 0.16),
    "book 3": (0.5, 0.36, 0.12),
    "book 4": (0.1, 0.14, 0.3),
    "book 5": (0.55, 0.5, 0.4),
    "field 1": (0.66, 0.2, 0.1),
    "field 2": (0.12, 0.3, 0.42),
    "field 3": (0.78, 0.62, 0.3),
    "field 4": (0.7, 0.68, 0.6),
}
SHELF = (1.15, 2.1, 0.32, 6)  # width, height, depth, levels


def _named(materials, solids):
    """Solids by part, as solids by material."""
    return {materials.get(part, part): listed for part, listed in solids.items()}


def _shell(room):
    ys = (-0.2, HEIGHT + 0.2)
    ends, xs = (Z0 - THICK + 0.05, Z1 + THICK - 0.05), (X0 - 0.15, X1 + 0.15)
    half = 0.5 * parts.DOOR_WIDTH
    opening = (DOOR_X - half, DOOR_X + half, -0.1, parts.DOOR_HEIGHT)
    room.solid("left wall", "blue wall", furniture.wall(ends, ys, (WINDOW, SUN_WINDOW), X0,
                                                        X0 - THICK, "z"))
    room.solid("right wall", "plaster", furniture.wall(ends, ys, (), X1, X1 + THICK, "z"))
    room.solid("back wall", "plaster", furniture.wall(xs, ys, (opening,), Z0, Z0 - THICK, "x"))
    room.solid("front wall", "plaster", furniture.wall(xs, ys, (), Z1, Z1 + THICK, "x"))
    room.solid("floor", "carpet", [box((X0 - 0.2, -0.4, Z0 - 0.2), (X1 + 0.2, 0.0, Z1 + 0.2))])
    room.solid("skirting", "white paint", parts.skirting(
        X0, X1, Z0, Z1, ((opening[0] - 0.05, opening[1] + 0.05),)))
    door = room.assembly("door", _named({"leaf": "oak", "frame": "white paint", "metal": "steel"},
                                        parts.door()))
    room.place("door", door, (DOOR_X, 0.0, Z0))


def _ceiling(room):
    openings = [(a + 0.03, b - 0.03, c + 0.03, d - 0.03) for a, b, c, d in PANELS]
    room.solid("ceiling", "ceiling", parts.ceiling(X0 - 0.1, X1 + 0.1, Z0 - 0.1, Z1 + 0.1, HEIGHT,
                                                   0.06, openings))
    room.solid("ceiling bars", "ceiling bar", parts.ceiling_bars(X0, X1, Z0, Z1, HEIGHT, PANELS))
    rim = room.mesh("panel rim", "white paint", finish(
        parts.luminaire_rim(0.2875, 0.5875, 0.03, 0.012, 0.025)))
    for k, (a, b, c, d) in enumerate(PANELS):
        at = (0.5 * (a + b), HEIGHT, 0.5 * (c + d))
        room.place(f"panel rim {k + 1}", rim, at)
        x, y, z = 0.268, -0.009, 0.568
        room.light(f"panel {k + 1}", "panel", [(-x, y, -z), (x, y, -z), (x, y, z), (-x, y, z)], at)


def _windows(room):
    for name, (z0, z1, y0, y1) in (("window", WINDOW), ("sun window", SUN_WINDOW)):
        room.solid(f"{name} frame", "white paint", furniture.window_bars(
            X0 - 0.19, (z0, z1, y0, y1), 1, 0, 0.05) + [
                box((X0 - 0.22, y0 - 0.02, z0 - 0.02), (X0 - 0.16, y0 + 0.045, z1 + 0.02)),
                box((X0 - 0.221, y1 - 0.045, z0 - 0.019), (X0 - 0.159, y1 + 0.02, z1 + 0.019)),
                box((X0 - 0.219, y0 - 0.01, z0 - 0.018), (X0 - 0.161, y1 + 0.01, z0 + 0.045)),
                box((X0 - 0.218, y0 - 0.01, z1 - 0.045), (X0 - 0.162, y1 + 0.01, z1 + 0.018)),
                box((X0 - 0.15, y0 - 0.03, z0 - 0.06), (X0 + 0.07, y0 + 0.012, z1 + 0.06))])
        length, at = z1 - z0 - 0.03, (X0 - 0.07, 0.0, z0 + 0.015)
        room.solid(f"{name} blind", "white paint", parts.blind_gear(length, y1 - 0.05, y0 + 0.05),
                   at)
        slat = room.mesh(f"{name} slat", "slat", finish(parts.slat(length, 9.0)))
        for k in range(int((y1 - y0 - 0.13) / parts.SLAT_PITCH)):
            room.place(f"{name} slat", slat, (at[0], y0 + 0.085 + k * parts.SLAT_PITCH, at[2]))


def _desk_things(room, placed, turn):
    """Places things on a desk, which stands at `turn[0]` and is turned by `turn[1]` degrees;
    `placed` lists (name, mesh, (x, z) on the desk, degrees)."""
    for name, mesh, (x, z), degrees in placed:
        a = math.radians(turn[1])
        at = (turn[0][0] + math.cos(a) * x + math.sin(a) * z, things.DESK_TOP,
              turn[0][2] - math.sin(a) * x + math.cos(a) * z)
        room.place(name, mesh, at, turn_about_y(turn[1] + degrees))


def _desks(room):
    desk = room.assembly("desk", things.desk(1.6, 0.78))
    monitor = room.assembly("monitor", things.monitor())
    keyboard = room.assembly("keyboard", things.keyboard())
    cup = room.assembly("pencil cup", things.pencil_cup())
    tray = room.assembly("letter tray", things.letter_tray())
    back, left = ((-0.5, 0.0, Z0 + 0.41), 0.0), ((X0 + 0.42, 0.0, -1.1), 90.0)
    right = ((X1 - 0.42, 0.0, 0.5), -90.0)
    for k, (at, degrees) in enumerate((back, left, right)):
        room.place(f"desk {k + 1}", desk, at, turn_about_y(degrees))
    mug = room.mesh("mug", "orange", finish(things.mug()))
    _desk_things(room, [("monitor 1", monitor, (-0.06, -0.14), 6.0),
                        ("keyboard 1", keyboard, (-0.08, 0.2), 3.0),
                        ("pencil cup 1", cup, (0.42, -0.2), 0.0),
                        ("mug 1", mug, (0.5, 0.1), 35.0),
                        ("letter tray", tray, (-0.6, -0.12), 4.0)], back)
    pages = room.mesh("papers", "paper", finish(things.papers(13, 5)))
    white = room.mesh("white mug", "white laminate", finish(things.mug()))
    _desk_things(room, [("monitor 2", monitor, (0.2, -0.12), -14.0),
                        ("keyboard 2", keyboard, (0.14, 0.2), -8.0),
                        ("pencil cup 2", cup, (0.66, -0.22), 40.0),
                        ("papers", pages, (-0.34, 0.16), 10.0),
                        ("mug 2", white, (-0.12, -0.1), 120.0)], left)
    _desk_things(room, [("monitor 3", monitor, (-0.1, -0.14), 10.0),
                        ("keyboard 3", keyboard, (-0.12, 0.18), 4.0),
                        ("pencil cup 3", cup, (0.3, -0.24), 70.0),
                        ("letter tray 2", tray, (0.58, -0.1), -3.0)], right)
    _desk_lamp(room, (left[0][0] - 0.1, things.DESK_TOP, left[0][2] + 0.62), 40.0)


def _desk_lamp(room, at, degrees):
    """A lamp with its light, turned by an angle about the y axis."""
    turn, a = turn_about_y(degrees), math.radians(degrees)
    room.place("lamp", room.assembly("lamp", things.desk_lamp()), at, turn)
    head = (at[0] + 0.34 * math.cos(a), at[1] + 0.42, at[2] - 0.34 * math.sin(a))
    half = 0.03
    room.place("lamp head", room.assembly("lamp head", things.lamp_head(half)), head, turn)
    h, y = half + 0.002, -0.026
    bulb = room.mesh("bulb", "bulb", light_quad([(-h, y, -h), (h, y, -h), (h, y, h), (-h, y, h)]))
    room.place("bulb", bulb, head, turn)


def _shelves(room):
    at = (-1.95, 0.0, Z0 + 0.02)
    room.solid("shelf", "walnut", furniture.shelf(*SHELF), at)
    for k in range(furniture.BOOK_COLOURS):
        room.solid(f"books {k + 1}", f"book {k + 1}", furniture.books(*SHELF, k), at)
    cabinet = room.assembly("cabinet", things.cabinet(4))
    room.place("cabinet", cabinet, (0.86, 0.0, Z0 + 0.32))


def _loose(room):
    chair = room.assembly("chair", _named({"frame": "dark plastic", "pad": "chair cloth"},
                                          seating.task_chair()))
    room.place("chair 1", chair, (-0.3, 0.0, -1.15), turn_about_y(152.0))
    room.place("chair 2", chair, (-1.3, 0.0, -0.55), turn_about_y(-128.0))
    room.place("chair 3", chair, (1.42, 0.0, 0.28), turn_about_y(65.0))
    basket_at = (0.47, 0.0, Z0 + 0.3)
    room.solid("basket", "dark metal", things.basket(), basket_at)
    room.solid("crumpled paper", "paper", [
        moved(parts.crumpled(k, 0.055), at) for k, at in enumerate(
            ((0.03, 0.06, 0.03), (-0.045, 0.065, -0.01), (0.01, 0.14, -0.04)))], basket_at)
    room.solid("stray paper", "paper", [parts.crumpled(7, 0.045)], (0.36, 0.038, Z0 + 0.75))
    rug_at = (0.2, 0.0, 0.15)
    room.solid("rug", "rug", furniture.rug(2.5, 1.7), rug_at)
    room.solid("rug stripes", "rug stripe", things.rug_stripes(2.5, 1.7, 9), rug_at)
    materials = {"pot": "clay"}
    pot = room.assembly("pot", _named(materials, parts.pot(0.19, 0.34)))
    plant = room.mesh("plant", "leaf", finish(parts.plant(17, 42, 0.62, 0.3)))
    for k, (x, z, degrees) in enumerate(((X0 + 0.38, 0.12, 0.0), (X1 - 0.33, Z0 + 0.34, 150.0))):
        room.place(f"pot {k + 1}", pot, (x, 0.0, z))
        room.place(f"plant {k + 1}", plant, (x, 0.0, z), turn_about_y(degrees))
    top = 0.05 + 4 * 0.32 + 0.011
    small = room.assembly("small pot", _named({"pot": "white laminate"}, parts.pot(0.09, 0.15)))
    room.place("small pot", small, (0.8, top, Z0 + 0.3))
    room.solid("small plant", "leaf", parts.plant(29, 30, 0.26, 0.13), (0.8, top, Z0 + 0.3))
    for k, (x, y, half_x, half_y, seed) in enumerate(((-0.72, 1.72, 0.3, 0.38, 4),
                                                      (0.05, 1.72, 0.24, 0.3, 8))):
        frame = room.assembly(f"picture {k + 1}", _named(
            {"frame": "walnut", "mat": "paper"}, parts.picture(half_x, half_y, seed)))
        room.place(f"picture {k + 1}", frame, (x, y, Z0))
    clock = room.assembly("clock", _named({"case": "dark metal", "face": "paper",
                                           "marks": "dark plastic"}, parts.clock(0.15)))
    room.place("clock", clock, (0.86, 2.2, Z0))


def _lights(room):
    z0, z1, y0, y1 = WINDOW
    lap, x = 0.03, X0 - 0.2
    room.light("sky", "sky", [(x, y0 - lap, z0 - lap), (x, y1 + lap, z0 - lap),
                              (x, y1 + lap, z1 + lap), (x, y0 - lap, z1 + lap)])
    length = math.sqrt(sum(c * c for c in SUN_WAY))
    sun = tuple(round(a - SUN_DISTANCE * c / length, 6) for a, c in zip(SUN_AIM, SUN_WAY))
    room.document.add_spot("sun", sun, SUN_AIM, (1.0, 0.86, 0.66), SUN_INTENSITY,
                           math.radians(4.5), math.radians(5.5))


def _office(title, haze):
    """The text and the buffer."""
    room = Builder(title, ALBEDO, RADIANCE)
    for build_part in (_shell, _ceiling, _windows, _desks, _shelves, _loose, _lights):
        build_part(room)
    room.document.add_camera("camera", (1.8, 1.52, 2.3), (-0.5, 0.98, -1.4), math.radians(56.0))
    room.document.add_camera("desk", (-0.95, 1.38, 0.15), (-2.4, 0.88, -1.05), math.radians(50.0))
    if haze:
        room.boundary("haze", (X0 - 0.05, -0.1, Z0 - 0.05), (X1 + 0.1, HEIGHT + 0.05, Z1 + 0.1),
                      *HAZE)
    return room.document.finish("office.bin")


def build():
    """The files of the scenes: {name: bytes}."""
    clear, binary = _office("Office", False)
    hazy, longer = _office("Office with haze", True)
    if longer[:len(binary)] != binary:
        raise ValueError("the haze is not behind all else in the buffer")
    return {"office.gltf": clear.encode("ascii"), "office-pm.gltf": hazy.encode("ascii"),
            "office.bin": longer}
