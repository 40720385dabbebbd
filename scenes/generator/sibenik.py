# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""sibenik.gltf: the nave of a cathedral with arcades, triforium, vaults, and a choir below a dome.

In the spirit of the cathedral of Sibenik, of our own modelling: not a copy of it.
"""

import math

from . import furniture, masonry
from . import sibenik_parts as parts
from . import sibenik_plan as plan
from .builder import Builder, light_quad
from .lofts import loft
from .solids import box, extrude, finish, moved, plate, revolve

HALF_TURN = (0.0, 1.0, 0.0, 0.0)
END = plan.HALF_LENGTH + 0.25
RIB_CREASE = 20.0  # degrees: ribs are smooth along their arc only
WEST_WINDOW = (-1.7, 1.7, 10.6, 14.0)

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "sky window": (22.0, 29.0, 40.0),
    "sun window": (72.0, 60.0, 42.0),
    "lantern": (38.0, 35.0, 30.0),
    "west window": (19.0, 20.0, 22.0),
}

ALBEDO = {
    "stone": (0.56, 0.51, 0.43),
    "pale stone": (0.63, 0.6, 0.53),
    "web": (0.55, 0.56, 0.55),
    "grey stone": (0.47, 0.46, 0.43),
    "red marble": (0.46, 0.17, 0.11),
    "aisle wall": (0.55, 0.43, 0.31),
    "floor": (0.52, 0.48, 0.42),
    "floor red": (0.4, 0.15, 0.1),
    "floor dark": (0.13, 0.13, 0.14),
    "gold": (0.78, 0.54, 0.17),
    "conch": (0.14, 0.25, 0.5),
    "oak": (0.33, 0.19, 0.1),
    "iron": (0.06, 0.06, 0.065),
    "wax": (0.84, 0.79, 0.66),
    "cloth": (0.55, 0.04, 0.06),
    "linen": (0.84, 0.82, 0.77),
}


def _both_sides(cathedral, name, mesh, at=(0.0, 0.0, 0.0)):
    """Places a mesh of the right side, and of the left one by half a turn about the y axis."""
    cathedral.place(f"{name} right", mesh, at)
    cathedral.place(f"{name} left", mesh, (-at[0], at[1], -at[2]), HALF_TURN)


def _nave_walls(cathedral):
    bays = plan.BAY_CENTRES
    large = masonry.arch(plan.ARCH_HALF, plan.ARCH_RADIUS, 14)
    small = masonry.arch(plan.SMALL_RADIUS, plan.SMALL_RADIUS, 7)
    pointed = masonry.arch(plan.WINDOW_HALF, plan.WINDOW_RADIUS, 9)
    offsets = [plan.SMALL_PITCH * (k - 0.5 * (plan.SMALL_ARCHES - 1))
               for k in range(plan.SMALL_ARCHES)]
    wall = masonry.arcade([(z, large) for z in bays], -END, END, plan.SPRINGING,
                          plan.TRIFORIUM_Y + 0.05, plan.ARCADE_IN, plan.ARCADE_OUT)
    wall += masonry.arcade([(z + u, small) for z in bays for u in offsets], -END, END,
                           plan.TRIFORIUM_SPRINGING, plan.CLERESTORY_Y + 0.05,
                           plan.TRIFORIUM_IN, plan.TRIFORIUM_OUT)
    wall += masonry.openings([(z, pointed) for z in bays], -END, END, plan.SILL_Y,
                             plan.WINDOW_SPRINGING, plan.WALL_TOP, lambda z, y, x: (x, y, z),
                             plan.CLERESTORY_IN, plan.CLERESTORY_OUT)
    wall += [box((plan.TRIFORIUM_IN - 0.04, 7.9, -END + 0.02),
                 (plan.TRIFORIUM_OUT + 0.03, plan.PARAPET_Y, END - 0.02)),
             box((plan.CLERESTORY_IN + 0.02, 10.86, -END + 0.03),
                 (plan.CLERESTORY_OUT + 0.02, plan.SILL_Y + 0.03, END - 0.03)),
             box((plan.TRIFORIUM_IN, 7.62, -END + 0.04), (6.0, plan.TRIFORIUM_Y, END - 0.04)),
             box((5.6, 7.5, -END + 0.05), (6.1, 11.3, END - 0.05)),
             box((plan.TRIFORIUM_IN + 0.06, 10.7, -END + 0.06), (6.05, 11.02, END - 0.06))]
    for z in (bays[0], bays[-1]):  # no light comes through these windows
        wall.append(box((4.3, plan.SILL_Y - 0.1, z - 1.0), (4.66, plan.WINDOW_TOP + 0.2, z + 1.0)))
    _both_sides(cathedral, "wall", cathedral.mesh("nave wall", "stone", finish(wall)))


def _string_courses(cathedral):
    def course(x, y, high, out):
        profile = [(x + 0.3, y), (x - 0.3 * out, y), (x - out, y + 0.4 * high),
                   (x - out, y + 0.8 * high), (x - 0.6 * out, y + high), (x + 0.3, y + high)]
        return extrude(profile, lambda u, v, z: (u, v, z), 0.07 - END, END - 0.07)

    solids = [course(plan.ARCADE_IN, 7.72, 0.34, 0.16), course(3.8, 8.64, 0.16, 0.09),
              course(plan.CLERESTORY_IN, 10.82, 0.3, 0.14),
              course(plan.CLERESTORY_IN, plan.SILL_Y - 0.12, 0.17, 0.1)]
    _both_sides(cathedral, "string courses",
                cathedral.mesh("string courses", "pale stone", finish(solids)))
    ring = masonry.archivolt(plan.ARCH_HALF, plan.ARCH_RADIUS, masonry.moulding(1.1, 0.1, 0.12),
                             14, 0.03)
    outer = masonry.archivolt(plan.ARCH_HALF + 0.12, plan.ARCH_RADIUS + 0.12,
                              [(-0.53, -0.1), (0.53, -0.1), (0.53, 0.16), (-0.53, 0.16)], 14, 0.02)
    ring = cathedral.mesh("archivolt", "pale stone", finish(
        [ring, outer], crease_degrees=RIB_CREASE))
    frame = cathedral.mesh("tracery", "pale stone", finish(parts.tracery()))
    for z in plan.BAY_CENTRES:
        for side in (-1.0, 1.0):
            x = 0.5 * side * (plan.ARCADE_IN + plan.ARCADE_OUT)
            cathedral.place("archivolt", ring, (x, plan.SPRINGING, z))
            cathedral.place("tracery", frame, (side * 4.12, 0.0, z))


def _columns(cathedral):
    column = cathedral.mesh("column", "pale stone", finish(parts.column()))
    shaft = cathedral.mesh("wall shaft", "pale stone", finish(parts.wall_shaft()))
    post = cathedral.mesh("colonnette", "red marble", finish(parts.colonnette()))
    middle = 0.5 * (plan.TRIFORIUM_IN + plan.TRIFORIUM_OUT)
    for side in (-1.0, 1.0):
        for k in range(1, plan.BAYS):
            z = plan.BAY * k - plan.HALF_LENGTH
            cathedral.place("column", column, (side * plan.COLUMN_X, 0.0, z))
            cathedral.place("wall shaft", shaft, (side * (plan.ARCADE_IN + 0.02), plan.SHAFT_Y, z))
        for z in (-plan.HALF_LENGTH, plan.HALF_LENGTH):  # against the walls at both ends
            cathedral.place("column", column, (side * plan.COLUMN_X, 0.0, z))
        for centre in plan.BAY_CENTRES:
            for k in range(plan.SMALL_ARCHES + 1):
                z = centre + plan.SMALL_PITCH * (k - 0.5 * plan.SMALL_ARCHES)
                cathedral.place("colonnette", post, (side * middle, plan.PARAPET_Y, z))


def _vaults(cathedral):
    boss = revolve([(0.08, -0.42), (0.2, -0.4), (0.3, -0.33), (0.34, -0.22), (0.3, -0.12),
                    (0.3, 0.15)], 28)
    for name, half, rise, thick, steps in (("nave", plan.VAULT_HALF, plan.VAULT_RISE, 0.3, 14),
                                           ("aisle", plan.AISLE_HALF, plan.AISLE_RISE, 0.22, 9)):
        slim = masonry.moulding(0.24, 0.22, 0.12)
        broad = masonry.moulding(0.62, 0.3, 0.5) if name == "nave" else masonry.moulding(
            0.52, 0.2, 0.4)
        web = cathedral.mesh(f"{name} vault", "web", finish(
            masonry.groin_vault(half, plan.HALF_BAY, rise, thick, steps), crease_degrees=22.0))
        ribs = cathedral.mesh(f"{name} ribs", "pale stone", finish(
            [masonry.vault_rib(half, side * plan.HALF_BAY, rise, slim, steps, 0.29 + 0.005 * side)
             for side in (-1.0, 1.0)] + [moved(boss, (0.0, rise, 0.0))], crease_degrees=RIB_CREASE))
        arch = cathedral.mesh(f"{name} arch", "pale stone", finish(
            [masonry.vault_rib(half, 0.0, rise, broad, steps, 0.31)], crease_degrees=RIB_CREASE))
        places = [0.0] if name == "nave" else [-plan.AISLE_X, plan.AISLE_X]
        y = plan.VAULT_Y if name == "nave" else plan.AISLE_VAULT_Y
        for x in places:
            for z in plan.BAY_CENTRES:
                cathedral.place(f"{name} vault", web, (x, y, z))
                cathedral.place(f"{name} ribs", ribs, (x, y, z))
            for k in range(plan.BAYS + 1):
                cathedral.place(f"{name} arch", arch, (x, y, plan.BAY * k - plan.HALF_LENGTH))


def _outer_walls(cathedral):
    z, x = plan.HALF_LENGTH, plan.AISLE_WALL
    wall = [box((x, -0.35, -z - 0.4), (x + 0.8, 8.3, z + 0.4))]
    _both_sides(cathedral, "outer wall", cathedral.mesh("outer wall", "aisle wall", finish(wall)))
    stone = []
    for k in range(plan.BAYS + 1):  # pilasters
        at = plan.BAY * k - z
        stone += [box((x - 0.28, -0.06, at - 0.34), (x + 0.1, 4.95, at + 0.34)),
                  box((x - 0.36, -0.07, at - 0.42), (x + 0.12, 0.5, at + 0.42)),
                  box((x - 0.35, 4.7, at - 0.41), (x + 0.11, 4.98, at + 0.41))]
    stone.append(box((x - 0.1, -0.08, -z - 0.1), (x + 0.13, 0.4, z + 0.1)))
    _both_sides(cathedral, "pilasters", cathedral.mesh("pilasters", "stone", finish(stone)))
    west = furniture.wall((-9.4, 9.4), (-0.4, 17.3), (WEST_WINDOW,), z - 0.1, z + 0.9, "x")
    cathedral.solid("west wall", "stone", west)
    arch = masonry.arch(plan.CHANCEL_HALF, plan.CHANCEL_RADIUS, 16)
    chancel = masonry.openings([(0.0, arch)], -9.3, 9.3, -0.38, plan.CHANCEL_SPRINGING, 17.4,
                               lambda x, y, w: (x, y, w), -z - 0.85, -z + 0.05)
    cathedral.solid("chancel wall", "stone", chancel)
    ring = masonry.archivolt(plan.CHANCEL_HALF, plan.CHANCEL_RADIUS,
                             masonry.moulding(1.06, 0.16, 0.2), 16, 8.47)
    turned = [(p[2], p[1] + plan.CHANCEL_SPRINGING, p[0] - z - 0.4) for p in ring[0]]
    imposts = [box((side * (plan.CHANCEL_HALF + 0.15) - 0.45, plan.CHANCEL_SPRINGING - 0.36,
                    -z - 1.02), (side * (plan.CHANCEL_HALF + 0.15) + 0.45,
                                 plan.CHANCEL_SPRINGING - 0.02, -z + 0.22)) for side in (-1, 1)]
    cathedral.solid("chancel arch", "pale stone", [(turned, ring[1]), *imposts],
                    crease_degrees=RIB_CREASE)


def _choir(cathedral):
    half, z = plan.CHOIR_HALF, plan.CHOIR_Z
    near, far = -plan.HALF_LENGTH - 0.57, plan.APSE_Z - 0.2
    for side, name in ((-1.0, "left"), (1.0, "right")):
        inner, outer = sorted((side * half, side * (half + 0.8)))
        cathedral.solid(f"{name} choir wall", "stone", [box((inner, -0.3, far),
                                                            (outer, 14.3, near))])
    arch = masonry.arch(plan.APSE_ARCH, plan.APSE_ARCH, 16)
    east = masonry.openings([(0.0, arch)], -5.0, 5.0, -0.32, plan.APSE_SPRINGING, 14.4,
                            lambda x, y, w: (x, y, w), plan.APSE_Z - 0.1, plan.APSE_Z + 0.6)
    cathedral.solid("east wall", "stone", east)
    ring = masonry.archivolt(plan.APSE_ARCH, plan.APSE_ARCH, masonry.moulding(0.9, 0.12, 0.2), 16,
                             6.7)
    cathedral.solid("apse arch", "pale stone", [
        ([(p[2], p[1] + plan.APSE_SPRINGING, p[0] + plan.APSE_Z + 0.25) for p in ring[0]],
         ring[1])], crease_degrees=RIB_CREASE)
    cathedral.solid("pendentives", "web", masonry.pendentives(half, 0.5, 64, 8),
                    (0.0, plan.PENDENTIVE_Y, z))
    cathedral.solid("dome", "pale stone", parts.dome(), (0.0, plan.DOME_Y, z))
    cathedral.solid("choir floor", "grey stone", [
        box((-5.2, -0.34, plan.APSE_Z - 4.0),
            (5.2, plan.CHOIR_Y - 0.001, -plan.HALF_LENGTH - 0.1))])
    cathedral.solid("choir steps", "pale stone", parts.choir_steps())


def _apse(cathedral):
    at, radius = (0.0, 0.0, plan.APSE_Z), plan.APSE_RADIUS

    def cylinder(r):
        return lambda a, y: (r * math.cos(a), y, -r * math.sin(a))

    def ball(r):
        return lambda a, e: (r * math.cos(a) * math.cos(e), plan.APSE_SPRINGING + r * math.sin(e),
                             -r * math.sin(a) * math.cos(e))

    turns = masonry.spread(math.radians(-6.0), math.radians(186.0), 40)
    cathedral.solid("apse", "pale stone", [
        plate(turns, (-0.3, 3.0, plan.APSE_SPRINGING + 0.1), cylinder(radius),
              cylinder(radius + 0.6))], at)
    cathedral.solid("conch", "conch", [
        plate(turns, masonry.spread(math.radians(-1.0), math.radians(86.0), 14),
              ball(radius + 0.02), ball(radius + 0.5)),
        box((-0.4, plan.APSE_SPRINGING + radius - 0.06, -0.4),
            (0.4, plan.APSE_SPRINGING + radius + 0.3, 0.3))], at)
    profile = [(radius + 0.1, -0.12), (radius - 0.1, -0.1), (radius - 0.2, 0.02),
               (radius - 0.2, 0.1), (radius + 0.1, 0.16)]
    rings = [[(r * math.cos(a), plan.APSE_SPRINGING + y, -r * math.sin(a)) for r, y in profile]
             for a in turns]
    cathedral.solid("apse shafts", "red marble", parts.apse_shafts(),
                    (0.0, plan.CHOIR_Y, plan.APSE_Z))
    cathedral.solid("apse cornice", "gold", [loft(rings)], at)
    steps, table, cloth, gold = parts.altar()
    place = (0.0, plan.CHOIR_Y, plan.ALTAR_Z)
    cathedral.solid("altar steps", "red marble", steps, place)
    cathedral.solid("altar", "pale stone", table, place)
    cathedral.solid("altar cloth", "linen", cloth, place)
    cathedral.solid("cross", "gold", gold, place)


def _things(cathedral):
    pew = cathedral.mesh("pew", "oak", finish(parts.pew()))
    for k in range(9):
        for x in (-2.02, 2.02):
            cathedral.place("pew", pew, (x, 0.0, 4.9 - 1.25 * k))
    iron, wax = parts.chandelier(plan.VAULT_Y + plan.VAULT_RISE - 7.2)
    hanging = cathedral.assembly("chandelier", {"iron": iron, "wax": wax})
    for k in (1, 2):
        cathedral.place("chandelier", hanging, (0.0, 7.0, plan.BAY_CENTRES[k]))
    stick, candle = parts.candlestick()
    stick = cathedral.assembly("candlestick", {"gold": stick, "wax": candle})
    for x in (-1.1, -0.85, 0.85, 1.1):
        cathedral.place("candlestick", stick, (x, plan.CHOIR_Y + 1.45, plan.ALTAR_Z - 0.1))


def _floor(cathedral):
    z = plan.HALF_LENGTH + 0.5
    cathedral.solid("floor", "floor", [box((-9.0, -0.5, -z), (9.0, 0.0, z))])
    red = cathedral.mesh("lozenge", "floor red", finish(parts.lozenge(0.5)))
    dark = cathedral.mesh("small lozenge", "floor dark", finish(parts.lozenge(0.17)))
    for k in range(19):
        for i in range(-3, 4):
            at = (1.06 * i, 0.0, 10.0 - 1.06 * k)
            cathedral.place("lozenge", red, at)
            if i < 3:
                cathedral.place("small lozenge", dark, (at[0] + 0.53, 0.0, at[2] + 0.53))


def _lights(cathedral):
    lap = 0.04
    z, y0, y1, x = plan.WINDOW_HALF + lap, plan.SILL_Y - lap, plan.WINDOW_TOP, plan.PANE_X
    for side, name in ((-1.0, "sky window"), (1.0, "sun window")):
        corners = [(side * x, y0, -side * z), (side * x, y0, side * z), (side * x, y1, side * z),
                   (side * x, y1, -side * z)]
        pane = cathedral.mesh(name, name, light_quad(corners))
        for k in (1, 2, 3):
            cathedral.place(f"{name} {k}", pane, (0.0, 0.0, plan.BAY_CENTRES[k]))
    half, y = plan.OCULUS + 0.005, plan.LANTERN_Y
    cathedral.light("lantern", "lantern", [(-half, y, -half), (half, y, -half), (half, y, half),
                                           (-half, y, half)], (0.0, 0.0, plan.CHOIR_Z))
    x0, x1, y0, y1 = WEST_WINDOW
    z = plan.HALF_LENGTH + 0.5
    cathedral.light("west window", "west window", [
        (x0 - lap, y0 - lap, z), (x0 - lap, y1 + lap, z), (x1 + lap, y1 + lap, z),
        (x1 + lap, y0 - lap, z)])


def build():
    """The files of the scene: {name: bytes}."""
    cathedral = Builder("Cathedral", ALBEDO, RADIANCE)
    for part in (_floor, _nave_walls, _string_courses, _columns, _vaults, _outer_walls, _choir,
                 _apse, _things, _lights):
        part(cathedral)
    cathedral.document.add_camera("nave", (-0.8, 2.0, 9.9), (0.12, 5.9, -14.0),
                                  math.radians(64.0))
    cathedral.document.add_camera("aisle", (6.7, 1.7, 9.8), (2.4, 3.4, -4.0), math.radians(58.0))
    text, binary = cathedral.document.finish("sibenik.bin")
    return {"sibenik.gltf": text.encode("ascii"), "sibenik.bin": binary}
