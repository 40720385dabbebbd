# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""bathroom.gltf: a mirror, glazed tiles, chromium, glass and water."""

import math

from . import bathroom_parts as fittings
from . import surfaces
from .builder import Builder, light_quad
from .forms import bevelled, turn
from .room_parts import plant, pot
from .solids import box, finish, plate
from .lofts import rim

X0, X1, Z0, Z1, HEIGHT = -1.6, 1.5, -1.3, 2.1, 2.5
TILE, TILED = (0.2, 0.1), 2.1  # width and height of a tile; height up to which walls are tiled
COUNTER = 0.84
WINDOW = (0.4, 0.7, 0.9, 2.15)  # of the left wall: z of its middle, half its width, y, y
TUB_AT = (0.94, 0.0, -0.36)

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "daylight": (9.6, 11.0, 13.0),
    "opal lamp": (9.5, 7.4, 4.9),
    "panel": (8.8, 7.8, 6.4),
}

ALBEDO = {
    "plaster": (0.74, 0.71, 0.66),
    "ceiling": (0.8, 0.79, 0.77),
    "grout": (0.62, 0.6, 0.56),
    "towel": (0.72, 0.3, 0.16),
    "soil": (0.09, 0.06, 0.04),
    "bristles": (0.8, 0.82, 0.84),
}


def _surfaces(room):
    surfaces.glossy(room, "tile", (0.06, 0.24, 0.24), 0.06)
    surfaces.glossy(room, "white tile", (0.74, 0.73, 0.7), 0.12)
    surfaces.glossy(room, "black tile", (0.035, 0.036, 0.04), 0.1)
    surfaces.glossy(room, "ceramic", (0.82, 0.82, 0.8), 0.03)
    surfaces.glossy(room, "walnut", (0.24, 0.125, 0.062), 0.35)
    surfaces.glossy(room, "stone", (0.52, 0.5, 0.47), 0.16)
    surfaces.glossy(room, "white paint", (0.78, 0.77, 0.74), 0.3)
    surfaces.glossy(room, "clay", (0.58, 0.27, 0.16), 0.55)
    surfaces.glossy(room, "leaf", (0.07, 0.2, 0.05), 0.33)
    surfaces.glossy(room, "blue plastic", (0.04, 0.17, 0.52), 0.12)
    surfaces.metal(room, "mirror", surfaces.SILVER, 0.0)
    surfaces.metal(room, "chromium", surfaces.CHROMIUM, 0.03)
    surfaces.metal(room, "brass", surfaces.BRASS, 0.2)
    surfaces.pane(room, "screen", (0.93, 0.97, 0.95))
    surfaces.glass(room, "glass", 1.52, absorption=((0.55, 0.88, 0.72), 0.12))
    surfaces.glass(room, "clear glass", 1.5)
    surfaces.glass(room, "amber glass", 1.52, absorption=((0.85, 0.4, 0.08), 0.006))
    surfaces.glass(room, "soap", 1.36, absorption=((0.8, 0.75, 0.5), 0.03))
    surfaces.glass(room, "scent", 1.36, absorption=((0.95, 0.5, 0.55), 0.02))
    surfaces.glass(room, "water", 1.333, absorption=((0.42, 0.82, 0.86), 1.0))


def _tiles(room):
    width, height = TILE
    rows = round(TILED / height)
    meshes = [room.mesh("tiles", "tile", finish(fittings.tile_row(18, width, height, seed), 50.0))
              for seed in (1, 2, 3)]
    for k in range(rows):
        shift = 0.5 * width * (k % 2)
        room.place("tiles", meshes[k % 3], (X0 - 0.05 - shift, k * height, Z0))
        room.place("tiles", meshes[(k + 1) % 3], (X1, k * height, Z0 - 0.05 - shift),
                   turn(y=-90.0))
    edge, columns, count = 0.25, 14, 15
    for odd, material in ((0, "white tile"), (1, "black tile")):
        mesh = room.mesh(material, material, finish(fittings.checkers(columns, count, edge, odd),
                                                    50.0))
        room.place(material, mesh, (X0 - 0.1, -fittings.GLAZE, Z1 + 0.1), turn(x=-90.0))


def _walls(room):
    room.solid("screed", "grout", [box((X0 - 0.3, -0.3, Z0 - 0.3), (X1 + 0.3, -0.006, Z1 + 0.3))])
    room.solid("grout", "grout", [
        box((X0 - 0.3, -0.2, Z0 - 0.3), (X1 + 0.3, TILED, Z0 + 0.001)),
        box((X1 - 0.001, -0.19, Z0 - 0.29), (X1 + 0.31, TILED - 0.0005, Z1 + 0.3))])
    room.solid("back wall", "plaster", [box((X0 - 0.3, TILED, Z0 - 0.3), (X1 + 0.3, HEIGHT + 0.1,
                                                                         Z0))])
    room.solid("right wall", "plaster", [box((X1, TILED, Z0 - 0.29), (X1 + 0.3, HEIGHT + 0.11,
                                                                     Z1 + 0.3))])
    room.solid("near wall", "plaster", [box((X0 - 0.3, -0.21, Z1), (X1 + 0.3, HEIGHT + 0.12,
                                                                    Z1 + 0.3))])
    middle, half, low, high = WINDOW
    zs = (Z0 - 0.31, middle - half, middle + half, Z1 + 0.31)
    ys = (-0.22, low, high, HEIGHT + 0.13)
    room.solid("left wall", "plaster", [plate(zs, ys, lambda z, y: (X0, y, z),
                                              lambda z, y: (X0 - 0.12, y, z),
                                              lambda i, j: (i, j) != (1, 1))])
    room.solid("window frame", "white paint", fittings.drop_window(half, low, high),
               (X0 - 0.02, 0.0, middle), crease_degrees=50.0)
    room.light("window", "daylight", [(X0 - 0.1, low - 0.02, middle + half + 0.02),
                                      (X0 - 0.1, low - 0.02, middle - half - 0.02),
                                      (X0 - 0.1, high + 0.02, middle - half - 0.02),
                                      (X0 - 0.1, high + 0.02, middle + half + 0.02)])
    room.solid("ceiling", "ceiling", [box((X0 - 0.3, HEIGHT, Z0 - 0.3), (X1 + 0.3, HEIGHT + 0.3,
                                                                         Z1 + 0.3))])
    for k, (x, z) in enumerate(((0.75, -0.2), (-0.3, 0.9))):
        y, half = HEIGHT - 0.025, 0.22
        room.solid("panel rim", "chromium", [
            box((x - half - 0.012, y - 0.004, z - half - 0.012),
                (x + half + 0.012, HEIGHT + 0.02, z + half + 0.012))])
        room.light(f"panel {k + 1}", "panel", [(x - half, y - 0.005, z - half),
                                               (x + half, y - 0.005, z - half),
                                               (x + half, y - 0.005, z + half),
                                               (x - half, y - 0.005, z + half)])


def _parts(room, name, parts, materials, at, rotation=None):
    """A thing of several materials, each a node of its own: glass and what it holds are solids."""
    for part, solids in parts.items():
        mesh = room.mesh(f"{name} {part}", materials[part], finish(solids, 40.0))
        room.place(f"{name} {part}", mesh, at, rotation)


def _vanity(room):
    x0, x1, z1 = -1.35, 0.15, Z0 + 0.52
    room.solid("counter", "stone", [bevelled((x0, COUNTER - 0.04, Z0 - 0.02), (x1, COUNTER, z1),
                                             0.003)], crease_degrees=50.0)
    middle = 0.5 * (x0 + x1)
    fronts = [bevelled((x0 + 0.03, 0.4, Z0 - 0.02), (x1 - 0.03, COUNTER - 0.035, z1 - 0.05), 0.003)]
    fronts += [bevelled((a + 0.003, low, z1 - 0.055), (b - 0.003, high, z1 - 0.028), 0.0025)
               for a, b in ((x0 + 0.03, middle), (middle, x1 - 0.03))
               for low, high in ((0.405, 0.598), (0.604, COUNTER - 0.046))]
    room.solid("cabinet", "walnut", fronts, crease_degrees=50.0)
    knob = room.mesh("knob", "brass", finish(fittings.knob(), 40.0))
    for x in (0.5 * (x0 + middle), 0.5 * (x1 + middle)):
        for y in (0.51, 0.71):
            room.place("knob", knob, (x, y, z1 - 0.028))
    at = (-0.62, COUNTER, Z0 + 0.27)
    _parts(room, "basin", fittings.basin(), {"bowl": "ceramic", "drain": "chromium"}, at)
    room.solid("tap", "chromium", fittings.tap(), (-0.62, COUNTER, Z0 + 0.055), crease_degrees=40.0)
    _parts(room, "soap bottle", fittings.soap_bottle(),
           {"glass": "amber glass", "soap": "soap", "pump": "chromium"}, (-0.31, COUNTER, Z0 + 0.3),
           turn(y=-60.0))
    room.solid("tumbler", "clear glass", fittings.tumbler(), (-0.19, COUNTER, Z0 + 0.19),
               crease_degrees=40.0)
    _parts(room, "toothbrush", fittings.toothbrush(),
           {"handle": "blue plastic", "bristles": "bristles"}, (-0.204, COUNTER + 0.014, Z0 + 0.18),
           turn(x=6.0, y=-50.0, z=-9.0))
    green = room.mesh("plant", "leaf", finish(plant(4, 16, 0.24, 0.1), 45.0))
    room.place("plant", green, (-1.13, COUNTER, Z0 + 0.22))
    _parts(room, "pot", pot(0.075, 0.12), {"pot": "clay", "soil": "soil"},
           (-1.13, COUNTER, Z0 + 0.22))


def _mirror(room):
    half_x, y0, y1, z = 0.52, 1.14, 1.92, Z0 + 0.004
    at, half_y = (-0.62, 0.5 * (y0 + y1), z), 0.5 * (y1 - y0)
    room.solid("mirror", "mirror", [box((-half_x + 0.004, -half_y + 0.004, -0.01),
                                        (half_x - 0.004, half_y - 0.004, 0.012))], at)
    room.solid("mirror frame", "brass", [rim(half_x, half_y, 0.014, -0.012, 0.024)], at)
    _parts(room, "mirror lamp", fittings.lamp_tube(0.7), {"tube": "opal lamp",
                                                          "holders": "chromium"},
           (-0.62, 2.04, Z0 + 0.004))


def _bath(room):
    room.solid("tub", "ceramic", fittings.tub(), TUB_AT, crease_degrees=45.0)
    room.solid("water", "water", fittings.bath_water(0.46), TUB_AT, crease_degrees=60.0)
    x, end, top = 0.4, -0.42, 1.98  # the screen is thin, so that lights are seen through it
    room.place("screen", room.mesh("screen", "screen", light_quad([
        (x, 0.004, end), (x, 0.004, Z0), (x, top, Z0), (x, top, end)])))
    room.solid("screen rails", "chromium", [
        bevelled((x - 0.006, -0.01, Z0 - 0.01), (x + 0.006, 0.016, end), 0.001),
        bevelled((x - 0.008, 0.0, Z0 - 0.011), (x + 0.008, top, Z0 + 0.014), 0.001),
        bevelled((x - 0.005, 0.001, end - 0.004), (x + 0.005, top, end + 0.004), 0.001)],
        crease_degrees=50.0)
    shelf, y = (0.62, 1.3), 1.32
    room.solid("shelf", "glass", [bevelled((shelf[0], y, Z0 - 0.002), (shelf[1], y + 0.008,
                                                                      Z0 + 0.13), 0.0008)],
               crease_degrees=20.0)
    bracket = room.mesh("bracket", "chromium", finish(fittings.shelf_bracket(), 40.0))
    for x in (shelf[0] + 0.08, shelf[1] - 0.08):
        room.place("bracket", bracket, (x, y - 0.0062, Z0))
    top = y + 0.0082
    for k, (radius, height, x, liquid) in enumerate(((0.034, 0.085, 0.74, "scent"),
                                                     (0.026, 0.12, 0.85, "soap"))):
        _parts(room, f"flask {k + 1}", fittings.flask(radius, height),
               {"glass": "clear glass", "scent": liquid, "stopper": "brass"}, (x, top, Z0 + 0.07))
    room.solid("jar", "ceramic", [bevelled((1.06, top - 0.0002, Z0 + 0.03),
                                           (1.16, top + 0.1, Z0 + 0.11), 0.006)],
               crease_degrees=50.0)
    at = (-0.08, 0.66, Z0 + 0.47)
    room.solid("towel rail", "chromium", fittings.rail(0.36), (at[0] - 0.22, at[1], at[2]),
               crease_degrees=40.0)
    room.solid("towel", "towel", fittings.towel(0.26, 0.42), (at[0] - 0.22, at[1], at[2] + 0.05),
               crease_degrees=60.0)


def build():
    """The files of the scene: {name: bytes}."""
    room = Builder("Bathroom", ALBEDO, RADIANCE)
    _surfaces(room)
    _walls(room)
    _tiles(room)
    _vanity(room)
    _mirror(room)
    _bath(room)
    room.document.add_camera("camera", (0.12, 1.47, 1.95), (0.09, 0.92, -1.3), math.radians(48.0))
    text, binary = room.document.finish("bathroom.bin")
    return {"bathroom.gltf": text.encode("ascii"), "bathroom.bin": binary}
