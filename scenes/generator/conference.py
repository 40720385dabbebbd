# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""conference.gltf: a conference room with twenty-two luminaires."""

import math

from . import conference_parts as things, furniture, room_parts as parts, seating
from .builder import Builder, light_quad
from .lofts import rod, turn_about_y
from .noise import Choices
from .solids import box, finish

# The room's inside, and how thick its walls are.
X0, X1, HEIGHT, Z0, Z1, THICK = -3.6, 3.6, 3.0, -4.8, 4.8, 0.25
CELL = 0.6
TABLE_Z = -0.3
DOOR_X = 2.72
CREDENZA_Z, CREDENZA_LENGTH = -3.1, 2.2
PENDANT_HALF, PENDANT_Y = 0.95, 2.3
PENDANTS = (-1.6, 1.0)  # z
PANELS = tuple((x, z) for x in (-1.5, 1.5) for z in (-3.3, -1.5, 0.3, 2.1, 3.9))
WASHERS = tuple((x, z) for x in (-3.3, 3.3) for z in (-3.9, -2.1, -0.3, 1.5)) \
    + ((-2.1, -4.5), (1.5, -4.5))

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "panel": (13.5, 13.6, 13.4),
    "pendant": (19.0, 18.2, 16.6),
    "washer": (200.0, 166.0, 120.0),
}

ALBEDO = {
    "plaster": (0.74, 0.72, 0.68),
    "back wall": (0.2, 0.3, 0.34),
    "ceiling": (0.82, 0.82, 0.8),
    "ceiling bar": (0.7, 0.7, 0.69),
    "carpet": (0.24, 0.26, 0.3),
    "carpet border": (0.12, 0.14, 0.19),
    "panel board": (0.2, 0.12, 0.07),
    "batten": (0.52, 0.34, 0.19),
    "cherry": (0.45, 0.25, 0.14),
    "dark wood": (0.17, 0.1, 0.065),
    "door wood": (0.4, 0.25, 0.14),
    "white paint": (0.77, 0.76, 0.73),
    "steel": (0.5, 0.5, 0.51),
    "grey metal": (0.4, 0.41, 0.42),
    "dark metal": (0.15, 0.15, 0.16),
    "dark plastic": (0.08, 0.08, 0.085),
    "leather": (0.5, 0.46, 0.4),
    "paper": (0.8, 0.79, 0.75),
    "sheet": (0.82, 0.82, 0.81),
    "display": (0.2, 0.34, 0.46),
    "ink": (0.12, 0.13, 0.17),
    "blue": (0.14, 0.3, 0.5),
    "orange": (0.75, 0.36, 0.08),
    "pale glass": (0.62, 0.7, 0.72),
    "carafe": (0.32, 0.5, 0.58),
    "curtain": (0.6, 0.54, 0.44),
    "pot": (0.72, 0.7, 0.66),
    "soil": (0.09, 0.06, 0.04),
    "leaf": (0.12, 0.3, 0.09),
    "field 1": (0.66, 0.2, 0.1),
    "field 2": (0.12, 0.3, 0.42),
    "field 3": (0.78, 0.62, 0.3),
    "field 4": (0.7, 0.68, 0.6),
}


def _named(materials, solids):
    """Solids by part, as solids by material."""
    return {materials.get(part, part): listed for part, listed in solids.items()}


def _shell(room):
    ys = (-0.2, HEIGHT + 0.3)
    ends, xs = (Z0 - THICK + 0.05, Z1 + THICK - 0.05), (X0 - 0.15, X1 + 0.15)
    half = 0.5 * parts.DOOR_WIDTH
    opening = (DOOR_X - half, DOOR_X + half, -0.1, parts.DOOR_HEIGHT)
    room.solid("left wall", "plaster", furniture.wall(ends, ys, (), X0, X0 - THICK, "z"))
    room.solid("right wall", "plaster", furniture.wall(ends, ys, (), X1, X1 + THICK, "z"))
    room.solid("back wall", "back wall", furniture.wall(xs, ys, (opening,), Z0, Z0 - THICK, "x"))
    room.solid("front wall", "plaster", furniture.wall(xs, ys, (), Z1, Z1 + THICK, "x"))
    room.solid("floor", "carpet border", [box((X0 - 0.2, -0.4, Z0 - 0.2),
                                              (X1 + 0.2, 0.0, Z1 + 0.2))])
    room.solid("carpet", "carpet", [box((X0 + 0.5, -0.05, Z0 + 0.6), (X1 - 0.5, 0.004, Z1 - 0.6))])
    room.solid("skirting", "dark wood", parts.skirting(
        X0, X1, Z0, Z1, ((opening[0] - 0.05, opening[1] + 0.05),)))
    door = room.assembly("door", _named({"leaf": "door wood", "frame": "dark wood",
                                         "metal": "steel"}, parts.door()))
    room.place("door", door, (DOOR_X, 0.0, Z0))
    room.solid("panelling", "panel board", [
        box((X0 - 0.05, 0.05, Z0 - 0.08), (X0 + 0.012, 2.35, Z1 + 0.08)),
        box((X0 - 0.06, 2.34, Z0 - 0.07), (X0 + 0.06, 2.4, Z1 + 0.07))])
    batten = room.mesh("batten", "batten", finish(things.batten(2.345)))
    count, pitch = 96, (Z1 - Z0) / 96
    for k in range(count):
        room.place("batten", batten, (X0 + 0.005, 0.0, Z0 + (k + 0.5) * pitch))
    curtain = room.mesh("curtain", "curtain", finish(things.curtain(3.3, 2.62)))
    room.solid("curtain rail", "dark metal", [rod((X1 - 0.12, 2.64, Z0 + 0.7),
                                                  (X1 - 0.12, 2.64, Z1 - 0.7), 0.022, 14)])
    for k, z in enumerate((Z0 + 1.0, Z0 + 5.2)):
        room.place(f"curtain {k + 1}", curtain, (X1 - 0.12, 0.0, z))


def _ceiling(room):
    """The ceiling with its tiles, and all lights that are let into it."""
    wide, small = 0.27, 0.075
    openings = [(x - h, x + h, z - h, z + h) for places, h in ((PANELS, wide), (WASHERS, small))
                for x, z in places]
    room.solid("ceiling", "ceiling", parts.ceiling(X0 - 0.1, X1 + 0.1, Z0 - 0.1, Z1 + 0.1, HEIGHT,
                                                   0.14, openings))
    room.solid("ceiling bars", "ceiling bar", parts.ceiling_bars(X0, X1, Z0, Z1, HEIGHT, ()))
    rim = room.mesh("panel rim", "white paint", finish(
        parts.luminaire_rim(0.2875, 0.2875, 0.032, 0.012, 0.03)))
    ring = room.mesh("washer ring", "dark metal", finish(parts.downlight_ring(0.07)))

    def pane(name, half, y):
        return room.mesh(name, name, light_quad([(-half, y, -half), (half, y, -half),
                                                 (half, y, half), (-half, y, half)]))
    for name, places, frame, light in (
            ("panel", PANELS, rim, pane("panel", 0.264, -0.009)),
            ("washer", WASHERS, ring, pane("washer", small + 0.008, 0.004))):
        for k, (x, z) in enumerate(places):
            room.place(f"{name} frame {k + 1}", frame, (x, HEIGHT, z))
            room.place(f"{name} {k + 1}", light, (x, HEIGHT, z))


def _pendants(room):
    housing = room.assembly("pendant housing", things.pendant(PENDANT_HALF))
    wires = room.mesh("pendant wires", "dark metal", finish([
        rod((0.0, 0.04, z), (0.0, HEIGHT - PENDANT_Y + 0.02, z), 0.003, 6)
        for z in (0.3 - PENDANT_HALF, PENDANT_HALF - 0.3)]))
    x, y, z = 0.066, -0.026, PENDANT_HALF - 0.006
    light = room.mesh("pendant", "pendant", light_quad([(-x, y, -z), (x, y, -z), (x, y, z),
                                                        (-x, y, z)]))
    for k, at in enumerate(PENDANTS):
        for name, mesh in (("housing", housing), ("wires", wires), ("light", light)):
            room.place(f"pendant {name} {k + 1}", mesh, (0.0, PENDANT_Y, at))


def _seats():
    """Where people sit: (x, z, degrees) of the table's edge there, whose outside is +z turned."""
    seats = [(side * things.table_half_width(z), z, side * 90.0)
             for side in (-1.0, 1.0) for z in (-2.35, -1.4, -0.45, 0.5, 1.45, 2.4)]
    end = things.TABLE_HALF_LENGTH
    return seats + [(0.0, end, 0.0), (0.0, -end, 180.0)]


def _table(room):
    room.place("table", room.assembly("table", things.table()), (0.0, 0.0, TABLE_Z))
    chair = room.assembly("chair", _named({"frame": "dark metal", "pad": "leather"},
                                          seating.conference_chair()))
    setting = room.assembly("setting", things.place_setting())
    choices = Choices(53)
    for k, (x, z, degrees) in enumerate(_seats()):
        a = math.radians(degrees)
        out = choices.between(0.16, 0.4)
        at = (x + out * math.sin(a), 0.004, z + TABLE_Z + out * math.cos(a))
        turn = degrees + 180.0 + choices.between(-24.0, 24.0)
        room.place(f"chair {k + 1}", chair, at, turn_about_y(turn))
        room.place(f"setting {k + 1}", setting, (x, things.TABLE_TOP, z + TABLE_Z),
                   turn_about_y(degrees + choices.between(-3.0, 3.0)))
    for k, (z, degrees) in enumerate(((-2.9, 12.0), (-1.95, -9.0))):
        room.place(f"wall chair {k + 1}", chair, (X1 - 0.7, 0.0, z), turn_about_y(degrees - 90.0))
    tray = room.assembly("water tray", things.water_tray())
    for k, z in enumerate((-1.28, 0.02, 1.28)):
        room.place(f"water tray {k + 1}", tray, (0.0, things.TABLE_TOP, z + TABLE_Z),
                   turn_about_y(70.0 * k))
    laptop = room.assembly("laptop", things.laptop())
    for k, (x, z, degrees) in enumerate(((0.36, 1.72, 84.0), (-0.34, -0.75, -96.0))):
        room.place(f"laptop {k + 1}", laptop, (x, things.TABLE_TOP, z + TABLE_Z),
                   turn_about_y(degrees))
    room.place("tray on the credenza", tray, (X0 + 0.3, 0.804, CREDENZA_Z + 0.55))


def _front(room):
    """The far end: screen, lectern, credenza, plants, clock, projector, pictures."""
    room.place("screen", room.assembly("screen", things.screen(1.35, 0.82)), (-0.75, 1.66, Z0))
    room.place("lectern", room.assembly("lectern", things.lectern()), (1.45, 0.004, Z0 + 0.95),
               turn_about_y(-14.0))
    credenza = room.assembly("credenza", things.credenza(CREDENZA_LENGTH))
    room.place("credenza", credenza, (X0 + 0.29, 0.0, CREDENZA_Z))
    pot = room.assembly("pot", parts.pot(0.2, 0.36))
    plant = room.mesh("plant", "leaf", finish(parts.plant(61, 44, 0.7, 0.32)))
    for k, (x, z) in enumerate(((X0 + 0.46, Z0 + 0.4), (X1 - 0.5, Z1 - 0.5), (X0 + 0.5, Z1 - 0.5))):
        room.place(f"pot {k + 1}", pot, (x, 0.0, z))
        room.place(f"plant {k + 1}", plant, (x, 0.0, z), turn_about_y(65.0 * k))
    clock = room.assembly("clock", _named({"case": "dark metal", "face": "paper",
                                           "marks": "dark plastic"}, parts.clock(0.17)))
    room.place("clock", clock, (1.45, 2.2, Z0))
    drop = HEIGHT - 2.62
    room.place("projector", room.assembly("projector", things.projector(drop + 0.02)),
               (-0.75, 2.62, -2.6))
    art = room.assembly("picture", _named({"frame": "dark wood", "mat": "paper"},
                                          parts.picture(0.5, 0.38, 12)))
    for k, x in enumerate((-1.6, 1.6)):
        room.place(f"picture {k + 1}", art, (x, 1.65, Z1), turn_about_y(180.0))


def build():
    """The files of the scene: {name: bytes}."""
    room = Builder("Conference", ALBEDO, RADIANCE)
    for build_part in (_shell, _ceiling, _pendants, _table, _front):
        build_part(room)
    room.document.add_camera("camera", (1.8, 1.82, 4.4), (-0.35, 1.08, -1.5), math.radians(55.0))
    room.document.add_camera("speaker", (-1.9, 1.72, -4.3), (0.5, 0.95, 1.2), math.radians(55.0))
    text, binary = room.document.finish("conference.bin")
    return {"conference.gltf": text.encode("ascii"), "conference.bin": binary}
