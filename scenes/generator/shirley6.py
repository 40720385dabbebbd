# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""shirley6.gltf: diffuse spheres on a half-open stage, of which some roll and bounce.
shirley6-pm.gltf: the same stage filled with haze."""

import math

from .builder import Builder
from .forms import bevelled, put, turn
from .noise import Choices
from .solids import Mesh, extrude, finish, sphere

HALF, BACK, FRONT, HEIGHT = 1.9, -1.9, 3.6, 3.1
PERIOD, KEYS = 4.0, 32
GRAVITY = 9.81  # m/s^2
SUNK = 0.0005  # by which a sphere that rests reaches into the floor
# Per metre: an optical depth of about 0.9 from the camera to the back of the stage.
HAZE = ((0.165, 0.165, 0.165), (0.012, 0.012, 0.012), 0.3)

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "key": (46.0, 39.0, 30.0),
    "fill": (6.6, 8.4, 11.0),
}

ALBEDO = {
    "floor": (0.62, 0.6, 0.56),
    "stage": (0.66, 0.64, 0.6),
    "rust": (0.62, 0.2, 0.1),
    "teal": (0.1, 0.38, 0.4),
    "frame": (0.2, 0.2, 0.21),
    "white": (0.8, 0.79, 0.76),
    "red": (0.68, 0.1, 0.07),
    "blue": (0.1, 0.19, 0.58),
    "gold": (0.76, 0.5, 0.1),
    "green": (0.16, 0.48, 0.16),
    "violet": (0.4, 0.16, 0.46),
    "slate": (0.16, 0.18, 0.21),
    "sky": (0.32, 0.56, 0.74),
}

# Spheres at rest: (x, z, radius, material).
RESTING = (
    (-0.62, -0.55, 0.62, "white"),
    (0.78, -0.72, 0.46, "gold"),
    (-1.32, 0.35, 0.24, "sky"),
    (0.1, -1.42, 0.3, "red"),
    (1.36, 0.12, 0.2, "violet"),
    (-1.38, -1.3, 0.36, "slate"),
    (-0.75, 0.62, 0.17, "green"),
    (1.5, -1.45, 0.24, "green"),
)
# Balls of two colours that roll: (x of the middle, z, radius, way, share of the period, colours).
ROLLING = ((0.22, 0.42, 0.27, 0.4, 0.0, ("red", "white")),
           (-0.55, 1.28, 0.15, -0.62, 0.3, ("blue", "gold")))
# Balls that bounce: (x, z, radius, bounces in a period, share of a bounce, colours).
BOUNCING = ((1.1, 0.6, 0.2, 4, 0.1, ("teal", "white")),
            (-1.02, 0.9, 0.13, 5, 0.55, ("violet", "gold")))
PEBBLES = ("white", "red", "blue", "gold", "green", "sky")


def _stage(room):
    """The floor, which bends up into the back wall, two side walls and half a ceiling."""
    bend, thick, steps = 0.5, 0.15, 12
    inside = [(FRONT, 0.0)]
    for k in range(steps + 1):
        angle = 0.5 * math.pi * k / steps
        inside.append((BACK + bend - bend * math.sin(angle), bend - bend * math.cos(angle)))
    inside.append((BACK, HEIGHT + 0.1))
    outline = inside + [(BACK - thick, HEIGHT + 0.1), (BACK - thick, -thick), (FRONT, -thick)]
    room.solid("floor", "floor", [extrude(outline, lambda z, y, x: (x, y, z), -HALF - 0.05,
                                          HALF + 0.05)], crease_degrees=20.0)
    for side, name, colour in ((-1, "left", "rust"), (1, "right", "teal")):
        near, far = sorted((side * HALF, side * (HALF + 0.16)))
        room.solid(f"{name} wall", colour, [bevelled((near, -0.3, BACK - 0.25),
                                                     (far, HEIGHT + 0.2, 2.3), 0.015)],
                   crease_degrees=50.0)
    room.solid("canopy", "stage", [bevelled((-HALF - 0.06, HEIGHT, BACK - 0.1),
                                            (HALF + 0.06, HEIGHT + 0.14, 0.35), 0.015)],
               crease_degrees=50.0)


def _panel(room, name, radiance, at, half, rotation):
    """A rectangle of light in a shallow tray that shines along -y before it is turned."""
    x, z = half
    rim, lip = 0.05, 0.03
    tray = [bevelled((-x - rim, -0.015, -z - rim), (x + rim, 0.05, z + rim), 0.006),
            bevelled((-x - rim + 0.001, -lip, -z - rim + 0.001), (-x, 0.03, z + rim - 0.001),
                     0.006),
            bevelled((x, -lip, -z - rim + 0.001), (x + rim - 0.001, 0.03, z + rim - 0.001),
                     0.006),
            *(bevelled((-x - rim + 0.002, -lip + 0.001, min(z * side, (z + rim - 0.002) * side)),
                       (x + rim - 0.002, 0.029, max(z * side, (z + rim - 0.002) * side)), 0.006)
              for side in (-1.0, 1.0))]
    node = put(room, name, room.mesh(name, "frame", finish(tray, crease_degrees=50.0)), at,
               rotation)
    x, z, y = x + 0.02, z + 0.02, -0.02
    pane = Mesh([(-x, y, -z), (x, y, -z), (x, y, z), (-x, y, z)], [(0, 1, 2), (0, 2, 3)])
    put(room, f"{name} pane", room.mesh(f"{name} pane", radiance, pane), parent=node)


def _octants(levels):
    """A unit sphere in two halves: its octants by turns, like the panels of a ball."""
    mesh = finish([sphere(levels, lambda d: 1.0)], crease_degrees=180.0)
    halves = []
    for wanted in (True, False):
        index, half = {}, Mesh([], [], [])
        for triangle in mesh.triangles:
            centre = [sum(mesh.positions[i][k] for i in triangle) for k in range(3)]
            if ((centre[0] * centre[1] * centre[2]) > 0.0) != wanted:
                continue
            for i in triangle:
                if i not in index:
                    index[i] = len(half.positions)
                    half.positions.append(mesh.positions[i])
                    half.normals.append(mesh.normals[i])
            half.triangles.append(tuple(index[i] for i in triangle))
        halves.append(half)
    return halves


class _Spheres:
    """Meshes of unit spheres, each shape stored once for all its colours."""

    def __init__(self, room):
        self._room, self._meshes = room, {}
        paint = room.materials["white"]
        primitive = room.document.primitive
        fine, coarse = (finish([sphere(levels, lambda d: 1.0)], crease_degrees=180.0)
                        for levels in (4, 3))
        self._shapes = {"plain": [primitive(fine, paint)], "pebble": [primitive(coarse, paint)],
                        "ball": [primitive(half, paint) for half in _octants(4)]}

    def mesh(self, shape, colours):
        key = (shape, *colours)
        if key not in self._meshes:
            self._meshes[key] = self._room.document.add_mesh(" ".join(key), [
                {**p, "material": self._room.materials[c]}
                for p, c in zip(self._shapes[shape], colours)])
        return self._meshes[key]


def _still(room, spheres):
    for x, z, radius, colour in RESTING:
        put(room, f"{colour} sphere", spheres.mesh("plain", (colour,)), (x, radius - SUNK, z),
            scale=(radius,) * 3)
    choices, taken = Choices(11), [(x, z, r) for x, z, r, _ in RESTING]
    taken += [(x + 0.25 * step * way, z, r) for x, z, r, way, *_ in ROLLING
              for step in range(-4, 5)]
    taken += [(x, z, r) for x, z, r, *_ in BOUNCING]
    placed = 0
    while placed < 22:
        x, z = choices.between(-1.7, 1.7), choices.between(-1.2, 1.75)
        radius = choices.between(0.035, 0.085)
        colour = PEBBLES[int(choices.between(0.0, len(PEBBLES)))]
        if any((x - a) ** 2 + (z - b) ** 2 < (radius + r + 0.04) ** 2 for a, b, r in taken):
            continue
        taken.append((x, z, radius))
        placed += 1
        put(room, f"pebble {placed}", spheres.mesh("pebble", (colour,)), (x, radius - SUNK, z),
            scale=(radius,) * 3)


def _tilt(degrees):
    return tuple(round(c, 6) for c in turn(20.0, 30.0, degrees))


def _roll(ball, phase):
    """Where a rolling ball is, and its turn, at a phase of the period."""
    x, z, radius, way, share, _ = ball
    shift = way * math.cos(2.0 * math.pi * (phase + share))
    return (round(x + shift, 6), round(radius - SUNK, 6), z), _tilt(-math.degrees(shift / radius))


def _bounce(ball):
    """Keys of a bouncing ball: times, and in-tangent, value and out-tangent of each. Between
    keys a cubic is the parabola itself."""
    x, z, radius, bounces, share, _ = ball
    length = PERIOD / bounces
    fastest = 0.5 * GRAVITY * length
    times = [0.0] + [(k + 1.0 - share) * length for k in range(bounces)] + [PERIOD]

    def state(since):
        return radius + since * (fastest - 0.5 * GRAVITY * since), fastest - GRAVITY * since

    y, speed = state(share * length)
    keys = [(speed, y, speed)] + [(-fastest, radius, fastest)] * bounces + [(speed, y, speed)]
    rows = [row for before, y, after in keys for row in (
        (0.0, round(before, 6), 0.0), (x, round(y, 6), z), (0.0, round(after, 6), 0.0))]
    return tuple(round(t, 6) for t in times), rows


def _moving(room, spheres):
    channels = []
    times = tuple(PERIOD * k / KEYS for k in range(KEYS + 1))
    for number, ball in enumerate(ROLLING):
        radius, colours = ball[2], ball[-1]
        keys = [_roll(ball, k % KEYS / KEYS) for k in range(KEYS + 1)]
        node = put(room, f"rolling ball {number + 1}", spheres.mesh("ball", colours), keys[0][0],
                   keys[0][1], (radius,) * 3)
        channels += [(node, "translation", times, [at for at, _ in keys], "LINEAR"),
                     (node, "rotation", times, [turned for _, turned in keys], "LINEAR")]
    for number, ball in enumerate(BOUNCING):
        radius, colours = ball[2], ball[-1]
        own, rows = _bounce(ball)
        node = put(room, f"bouncing ball {number + 1}", spheres.mesh("ball", colours), rows[1],
                   _tilt(25.0), (radius,) * 3)
        channels.append((node, "translation", own, rows, "CUBICSPLINE"))
        turns = [_tilt(25.0 + 90.0 * k) for k in range(5)]
        channels.append((node, "rotation", tuple(PERIOD * k / 4 for k in range(5)), turns,
                         "LINEAR"))
    room.document.add_animation("roll and bounce", channels)


def build():
    """The files of the scenes: {name: bytes}."""
    room = Builder("Shirley 6", ALBEDO, RADIANCE)
    _stage(room)
    _panel(room, "key", "key", (0.55, 2.75, 0.55), (0.34, 0.34), turn(0.0, 0.0, 12.0))
    _panel(room, "fill", "fill", (-1.2, 2.4, 3.0), (0.6, 0.45), turn(-42.0, 0.0, -18.0))
    spheres = _Spheres(room)
    _still(room, spheres)
    _moving(room, spheres)
    document = room.document
    document.add_camera("camera", (0.0, 1.5, 4.4), (0.0, 0.64, -0.4), math.radians(41.0))
    clear, _ = document.finish("shirley6.bin")
    # The haze adds to the end of the buffer, of which the clear scene reads the beginning.
    document.json["scenes"][0]["name"] = "Shirley 6 with haze"
    room.boundary("haze", (-HALF - 0.04, -0.05, BACK - 0.05),
                  (HALF + 0.04, HEIGHT + 0.05, FRONT - 0.1), *HAZE)
    hazy, binary = document.finish("shirley6.bin")
    return {"shirley6.gltf": clear.encode("ascii"), "shirley6-pm.gltf": hazy.encode("ascii"),
            "shirley6.bin": binary}
