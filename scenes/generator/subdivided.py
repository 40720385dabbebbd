# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""subdivided.gltf: an open box whose walls and bodies are of small triangles with real relief.
subdivided-pm.gltf: the same box filled with a thin haze."""

import copy
import math

from .builder import Builder
from .noise import Clouds
from .solids import box, finish, revolve, sphere

HALF, HEIGHT, DEPTH = 1.0, 2.0, 2.0  # the inside: x from -HALF, y from 0, z from -DEPTH to 0
LAP = 0.16  # how far a wall goes on behind the ones beside it
THICK = 0.3
CELLS = 56
LIGHT = (0.42, 0.34, 1.985, -0.98)  # half x, half z, y, z of its middle

# Per metre. The box is 2 m deep: an extinction of 0.5 / m is an optical depth of 1.
HAZE_SCATTERING, HAZE_ABSORPTION, HAZE_ANISOTROPY = (0.46, 0.46, 0.46), (0.04, 0.04, 0.04), 0.2

RADIANCE = {"light": (10.2, 9.3, 7.9)}  # W/(m^2 sr), linear Rec.709

ALBEDO = {
    "left wall": (0.66, 0.27, 0.05),
    "right wall": (0.07, 0.3, 0.44),
    "back wall": (0.72, 0.7, 0.65),
    "floor": (0.62, 0.58, 0.52),
    "ceiling": (0.76, 0.75, 0.72),
    "ball": (0.74, 0.71, 0.64),
    "column": (0.5, 0.2, 0.3),
    "pearl": (0.2, 0.42, 0.2),
    "lamp frame": (0.12, 0.12, 0.12),
}


def relief(columns, rows, place, height, depth):
    """A slab whose front is a grid of `columns` x `rows`, raised by `height(u, v)`; its back, of
    two triangles, lies `depth` behind. `place(u, v, w)` puts it into space."""
    width = len(columns)
    positions = [place(u, v, height(u, v)) for v in rows for u in columns]
    triangles = []
    for j in range(len(rows) - 1):
        for i in range(width - 1):
            a, b = j * width + i, j * width + i + 1
            c, d = b + width, a + width
            # Diagonals alternate, so that no direction stands out.
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    last = width * (len(rows) - 1)
    sides = (list(range(width)), list(range(width - 1, last + width, width)),
             list(range(last + width - 1, last - 1, -1)), list(range(last, -1, -width)))
    back = len(positions)
    for k, (u, v) in enumerate(((0, 0), (-1, 0), (-1, -1), (0, -1))):
        positions.append(place(columns[u], rows[v], -depth))
        near, far = back + k, back + (k + 1) % 4
        triangles += [(q, p, near) for p, q in zip(sides[k], sides[k][1:])]
        triangles.append((sides[k][-1], near, far))
    triangles += [(back, back + 2, back + 1), (back, back + 3, back + 2)]
    return positions, triangles


def _spread(first, last, count):
    return [first + (last - first) * k / count for k in range(count + 1)]


def _fade(value, edge, over):
    """From 0 at the edge to 1 at a distance of `over` from it."""
    t = min(max((edge - abs(value)) / over, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def _walls(room):
    clouds = Clouds(11, 16)
    across = _spread(-HALF - LAP, HALF + LAP, CELLS)
    up = _spread(-LAP, HEIGHT + LAP, CELLS)
    along = _spread(-DEPTH - LAP, 0.02, CELLS)

    def folds(z, y):
        """Upright folds, which lean a little and die down towards floor and ceiling."""
        wave = math.sin(17.0 * z + 0.9 * math.sin(2.6 * y))
        return 0.032 * wave * (0.35 + 0.65 * _fade(y - 1.0, 1.05, 0.5))

    def bumps(z, y):
        return 0.045 * math.sin(11.0 * (z + 0.5 * y)) * math.sin(11.0 * (0.5 * z - y))

    def rings(x, y):
        """Ripples around a point above the middle, as of a drop in water."""
        r = math.sqrt((x - 0.12) ** 2 + (y - 1.18) ** 2)
        return 0.034 * math.cos(21.0 * r) / (1.0 + 0.8 * r)

    def dunes(x, z):
        low = clouds.fractal(2.0 * x + 7.0, 0.5, 2.0 * z + 9.0, 2)
        return 0.05 * (low - 0.5) + 0.008 * math.sin(31.0 * (z + 0.22 * math.sin(3.0 * x)))

    room.solid("left wall", "left wall", [relief(
        along, up, lambda z, y, w: (w - HALF, y, z), folds, THICK)])
    room.solid("right wall", "right wall", [relief(
        along, up, lambda z, y, w: (HALF - w, y, z), bumps, THICK)])
    room.solid("back wall", "back wall", [relief(
        across, _spread(-LAP - 0.01, HEIGHT + LAP + 0.01, CELLS),
        lambda x, y, w: (x, y, w - DEPTH), rings, THICK)])
    room.solid("floor", "floor", [relief(
        _spread(-HALF - LAP - 0.01, HALF + LAP + 0.01, CELLS), along,
        lambda x, z, w: (x, w, z + 0.003), dunes, THICK)])
    coarse = CELLS // 2
    room.solid("ceiling", "ceiling", [relief(
        _spread(-HALF - LAP - 0.02, HALF + LAP + 0.02, coarse),
        _spread(-DEPTH - LAP - 0.01, 0.02, coarse),
        lambda x, z, w: (x, HEIGHT - w, z - 0.003),
        lambda x, z: 0.01 * math.sin(9.0 * x) * math.sin(9.0 * z), THICK)])


def _ball(direction):
    """The radius of the ball along a direction: ridges that wind up to its poles."""
    x, y, z = direction
    winding = math.cos(9.0 * math.atan2(z, x) + 5.0 * y)
    return 0.36 * (1.0 + (1.0 - y * y) * (0.055 * winding + 0.012 * math.cos(40.0 * y)))


def twisted_column(height, sides, rows):
    """A column of four lobes that turns by three eighths while it rises; origin at its foot."""
    profile = []
    for k in range(rows + 1):
        t = k / rows
        foot = max(0.0, 1.0 - t / 0.1) ** 2 + max(0.0, 1.0 - (1.0 - t) / 0.08) ** 2
        profile.append((0.2 + 0.07 * foot - 0.02 * t, t * height - 0.08))

    def lobes(r, y, angle):
        turned = 4.0 * (angle + 0.75 * math.pi * y / height)
        return r * (1.0 + 0.2 * math.cos(turned) + 0.02 * math.cos(24.0 * math.pi * y / height))

    return [revolve(profile, sides, lobes)]


def _bodies(room):
    room.solid("ball", "ball", [sphere(5, _ball)], (0.42, 0.37, -0.68), crease_degrees=80.0)
    room.solid("column", "column", twisted_column(1.46, 80, 56), (-0.42, 0.0, -1.28),
               crease_degrees=70.0)
    pearl = [sphere(4, lambda d: 0.15 * (1.0 + 0.1 * math.sin(14.0 * d[1])))]
    room.solid("pearl", "pearl", pearl, (-0.44, 0.13, -0.44), crease_degrees=80.0)


def _light(room):
    half_x, half_z, y, z = LIGHT
    room.light("light", "light", [(-half_x, y, z - half_z), (half_x, y, z - half_z),
                                  (half_x, y, z + half_z), (-half_x, y, z + half_z)])
    edge, low = 0.04, y - 0.02
    for name, lo, hi in (
            ("left", (-half_x - edge, low, z - half_z - edge), (-half_x + 0.004, 2.1,
                                                              z + half_z + edge)),
            ("right", (half_x - 0.004, low, z - half_z - edge), (half_x + edge, 2.1,
                                                               z + half_z + edge)),
            ("far", (-half_x - 0.01, low + 0.001, z - half_z - edge - 0.001),
             (half_x + 0.01, 2.101, z - half_z + 0.004)),
            ("near", (-half_x - 0.01, low + 0.001, z + half_z - 0.004),
             (half_x + 0.01, 2.101, z + half_z + edge + 0.001))):
        room.solid(f"lamp frame {name}", "lamp frame", [box(lo, hi)])


def build():
    """The files of the scenes: {name: bytes}. Both share one buffer, whose end holds what only
    the second one needs."""
    room = Builder("Subdivided box", ALBEDO, RADIANCE)
    _walls(room)
    _bodies(room)
    _light(room)
    room.document.add_camera("camera", (0.0, 1.0, 3.05), (0.0, 0.99, -1.0), math.radians(34.9))
    hazy = copy.deepcopy(room)
    hazy.document.json["scenes"][0]["name"] = "Subdivided box with haze"
    hazy.boundary("haze", (-HALF - 0.1, -0.1, -DEPTH - 0.1), (HALF + 0.1, HEIGHT + 0.05, 0.0),
                  HAZE_SCATTERING, HAZE_ABSORPTION, HAZE_ANISOTROPY)
    text, _ = room.document.finish("subdivided.bin")
    hazy_text, binary = hazy.document.finish("subdivided.bin")
    return {"subdivided.gltf": text.encode("ascii"),
            "subdivided-pm.gltf": hazy_text.encode("ascii"), "subdivided.bin": binary}
