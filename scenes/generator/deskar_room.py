# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The room of deskar.gltf: walls, floor, window, shelf, and what stands around the desk."""

import math

from . import desk_parts, furniture
from . import desk_things as things
from .desk_pictures import painting
from .forms import (bevelled, cable, compound, disc, put, repainted, rod, rotated, times,
                    turn)
from .noise import Choices, Clouds
from .solids import box, revolve, sphere

X0, X1, HEIGHT, Z0, Z1, THICK = -1.4, 2.0, 2.6, -0.03, 3.6, 0.28
WINDOW = (0.62, 2.1, 0.92, 2.25)  # of the left wall: z, y
PLANK = 0.118
SHELF_Y, SHELF_X = 1.43, (-0.62, 0.42)


def shell(room):
    """Walls, ceiling, planks, skirting and the window."""
    ys, xs = (-0.2, HEIGHT + 0.2), (X0 - 0.15, X1 + 0.15)
    zs = (Z0 - THICK + 0.05, Z1 + THICK - 0.05)
    room.solid("left wall", "wall", furniture.wall(zs, ys, (WINDOW,), X0, X0 - THICK, "z"))
    room.solid("right wall", "wall", furniture.wall(zs, ys, (), X1, X1 + THICK, "z"))
    room.solid("back wall", "back wall", furniture.wall(xs, ys, (), Z0, Z0 - THICK, "x"))
    room.solid("front wall", "wall", furniture.wall(xs, ys, (), Z1, Z1 + THICK, "x"))
    lo, hi = (X0 - 0.22, -0.4, Z0 - 0.2), (X1 + 0.22, -0.012, Z1 + 0.2)
    room.solid("ground", "lead", [box(lo, hi)])
    room.solid("ceiling", "ceiling", [box((lo[0], HEIGHT, lo[2]), (hi[0], HEIGHT + 0.4, hi[2]))])
    plank = compound(room, "plank", [("plank 1", [bevelled(
        (0.0, -0.03, Z0 - 0.1), (PLANK - 0.0012, 0.0, 1.7), 0.0015)], 50.0)])
    shades = [plank] + [repainted(room, "plank", plank, {"plank 1": f"plank {k}"})
                        for k in (2, 3)]
    choices = Choices(31)
    for k in range(round((X1 - X0 + 0.2) / PLANK)):
        shift = choices.between(0.0, 1.2)
        for row in range(3):
            z = 1.832 * row - shift
            put(room, "plank", shades[int(choices.between(0.0, 3.0))],
                (X0 - 0.1 + k * PLANK, -choices.between(0.0, 0.0009), z))
    y = 0.085
    room.solid("skirting", "white", [
        bevelled((X0 - 0.05, -0.01, Z0 - 0.04), (X1 + 0.05, y, Z0 + 0.014), 0.004),
        bevelled((X0 - 0.05, -0.011, Z0 - 0.05), (X0 + 0.014, y - 0.001, Z1 + 0.05), 0.004),
        bevelled((X1 - 0.014, -0.011, Z0 - 0.05), (X1 + 0.05, y - 0.001, Z1 + 0.05), 0.004)],
        crease_degrees=50.0)
    room.solid("window bars", "white", furniture.window_bars(X0 - 0.12, WINDOW, 1, 1, 0.05))
    z0, z1, y0, y1 = WINDOW
    lap, x = 0.03, X0 - 0.2
    room.light("window", "window", [(x, y0 - lap, z0 - lap), (x, y1 + lap, z0 - lap),
                                    (x, y1 + lap, z1 + lap), (x, y0 - lap, z1 + lap)])
    room.solid("sill", "white", [bevelled((X0 - 0.1, y0 - 0.03, z0 - 0.05),
                                          (X0 + 0.12, y0 + 0.006, z1 + 0.05), 0.006)],
               crease_degrees=50.0)


def shelf(room, books):
    """A board on brackets with books, a globe and a plant; above the desk."""
    (x0, x1), y, z = SHELF_X, SHELF_Y, Z0
    room.solid("shelf", "walnut", [bevelled((x0, y - 0.026, z - 0.01), (x1, y, z + 0.22), 0.003)],
               crease_degrees=50.0)
    bracket = compound(room, "bracket", [("steel", [
        bevelled((-0.012, -0.16, -0.01), (0.012, -0.002, 0.005), 0.001),
        bevelled((-0.0115, -0.006, -0.008), (0.0115, 0.004, 0.19), 0.001),
        rod((0.0, -0.145, 0.0), (0.0, -0.002, 0.165), 0.004, 8)], 50.0)])
    for x in (x0 + 0.12, x1 - 0.12):
        put(room, "bracket", bracket, (x, y - 0.026, z))
    choices = Choices(12)
    last = books.row(x0 + 0.16, x0 + 0.66, y, z + 0.195, choices, 0.235)
    books.pile((last + 0.085, y, z + 0.205), ((0.04, 0.15, 0.15), (0.026, 0.14, 0.14),
                                             (0.02, 0.13, 0.13)), Choices(4))
    globe(room, (x1 - 0.1, y + 0.17, z + 0.115))
    plant(room, (x0 + 0.075, y - 0.0005, z + 0.11), 0.055, 0.09, 18, 0.17, 41)


def globe(room, at):
    """A globe with raised land."""
    clouds = Clouds(77)

    def radius(d):
        land = clouds.fractal(*(9.0 + 1.7 * c for c in d), 4) - 0.53
        return 0.108 + 0.0035 * min(max(24.0 * land, 0.0), 1.0)

    def colour(position, _):
        length = math.sqrt(math.fsum(c * c for c in position))
        t = min(max((length - 0.108) / 0.0035, 0.0), 1.0)
        return tuple(a + (b - a) * t for a, b in zip((0.1, 0.24, 0.42), (0.62, 0.52, 0.26)))

    room.materials["painted"] = room.document.add_material("painted", (1.0, 1.0, 1.0))
    room.solid("globe", "painted", [sphere(4, radius)], at, crease_degrees=70.0, colour=colour)
    put(room, "globe stand", compound(room, "globe stand", [("brass", things.globe_stand(), 60.0)]),
        (at[0], at[1] + 0.0005, at[2]), turn(y=-25.0))


def plant(room, at, radius, height, count, size, seed):
    """A potted plant of `count` leaves up to `size` m long."""
    choices = Choices(seed)
    name = "leaf"
    if not hasattr(room, "leaf"):
        room.leaf = compound(room, name, [("leaf", things.leaf(), 60.0)])
        room.young_leaf = repainted(room, name, room.leaf, {"leaf": "leaf young"})
    put(room, "pot", compound(room, "pot", [
        ("clay", things.pot(radius, height), 50.0),
        ("soil", [disc(0.87 * radius, 0.6 * height, 0.86 * height, 0.002, 28)], 35.0)]), at)
    for k in range(count):
        share = k / count
        yaw = 137.5 * k
        lean = 6.0 + 62.0 * share + choices.between(-6.0, 6.0)
        long = size * (1.0 - 0.35 * share) * choices.between(0.8, 1.0)
        out = 0.4 * radius * share
        c, s = math.sin(math.radians(yaw)), math.cos(math.radians(yaw))
        put(room, name, room.young_leaf if k % 4 == 0 else room.leaf,
            (at[0] + out * c, at[1] + 0.8 * height, at[2] + out * s),
            times(turn(y=yaw), turn(x=0.75 * lean)), (long,) * 3)


def wall_things(room):
    """A clock and pictures on the back wall."""
    at = (0.78, 1.62, Z0)
    ring = rotated(revolve([(0.128, -0.002), (0.14, 0.0), (0.145, 0.02), (0.142, 0.03),
                            (0.134, 0.032), (0.13, 0.026), (0.129, 0.012)], 56), turn(x=90.0))
    clock = put(room, "clock", compound(room, "clock", [
        ("walnut", [ring], 50.0),
        ("paper", [rotated(disc(0.131, -0.004, 0.016, 0.001, 48), turn(x=90.0))], 35.0),
        ("brass", [rotated(disc(0.007, 0.01, 0.0225, 0.001, 20), turn(x=90.0))], 35.0)]), at)
    mark = compound(room, "mark", [("lead", [box((-0.0028, 0.103, 0.012), (0.0028, 0.121, 0.0175)
                                                 )], 35.0)])
    for k in range(12):
        put(room, "mark", mark, rotation=turn(z=30.0 * k), parent=clock)
    for name, length, half, degrees, z in (("hour hand", 0.064, 0.004, -305.0, 0.0185),
                                           ("minute hand", 0.096, 0.0028, -50.0, 0.0205)):
        put(room, name, compound(room, name, [("lead", [
            bevelled((-half, -0.016, z), (half, length, z + 0.0014), 0.0003)], 50.0)]),
            rotation=turn(z=degrees), parent=clock)
    painting(room, (0.66, 1.14, Z0), 0.3, 0.4, (("hill near", -0.05, 0.06, 0.085),
                                                ("book ochre", 0.045, -0.03, 0.06),
                                                ("book plum", -0.03, -0.085, 0.045)))
    painting(room, (0.99, 1.19, Z0), 0.22, 0.28, (("book blue", 0.0, 0.03, 0.05),
                                                  ("book red", 0.02, -0.045, 0.032)))
    painting(room, (-1.02, 1.62, Z0), 0.3, 0.36, (("book ochre", -0.03, 0.04, 0.07),
                                                  ("hill far", 0.05, -0.04, 0.05)))


def around(room):
    """Chair, rug, a tall plant and a basket of paper."""
    room.solid("rug", "rug", furniture.rug(1.9, 1.15), (-0.05, 0.0, 1.2))
    chair = compound(room, "chair", [("steel", desk_parts.chair_base(), 50.0),
                                     ("device", desk_parts.casters(), 40.0),
                                     ("fabric", desk_parts.chair_cushions(), 60.0),
                                     ("key dark", desk_parts.chair_arms(), 60.0)])
    put(room, "chair", chair, (-0.3, 0.0135, 1.1), turn(y=-38.0))
    plant(room, (-1.08, -0.0005, 0.33), 0.17, 0.34, 34, 0.85, 43)
    at = (1.03, -0.0005, 0.42)
    room.solid("basket", "cork", things.cup(0.135, 0.3), at, crease_degrees=50.0)
    ball = compound(room, "crumpled paper", [("paper", things.crumpled(Clouds(9)), 20.0)])
    choices = Choices(8)
    for k in range(15):
        angle, out = 2.4 * k, 0.085 * math.sqrt(((k % 7) + 0.5) / 7.0)
        put(room, "crumpled paper", ball, (at[0] + out * math.cos(angle),
                                           0.15 + 0.05 * (k // 7) + choices.between(0.0, 0.015),
                                           at[2] + out * math.sin(angle)),
            turn(choices.between(0.0, 360.0), choices.between(0.0, 360.0)))
    put(room, "crumpled paper", ball, (0.72, 0.024, 1.02), turn(x=70.0, y=20.0))
    room.solid("cord", "device", [cable([(-0.67, 0.756, 0.12), (-0.7, 0.757, 0.06),
                                         (-0.72, 0.752, 0.018), (-0.722, 0.72, -0.006),
                                         (-0.72, 0.3, -0.014), (-0.7, 0.12, -0.016)], 0.0025, 8)],
               crease_degrees=80.0)
