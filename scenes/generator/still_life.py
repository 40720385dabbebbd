# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""still-life.gltf and sky.hdr: metals, glass, glaze, plastic and fruit under an open sky."""

import math

from . import still_life_parts as things
from . import surfaces
from .builder import Builder
from .forms import bevelled, turn
from .noise import Choices, Clouds
from .sky import Sky, cube_images, equirectangular, irradiance_coefficients
from .solids import box, finish
from .wood_images import wood

REPEAT = 10497
BOARD, BOARDS = 0.145, 7
SUN = (-0.66, 0.62, 0.3)
FACE = 64  # texels along a face of the sky's cube

ALBEDO = {
    "plaster": (0.3, 0.4, 0.42),
    "terrace": (0.42, 0.38, 0.33),
    "cork": (0.55, 0.4, 0.26),
}


def _surfaces(scene):
    texture = scene.document.add_texture("wood", "still-life-wood.png", REPEAT)
    surfaces.glossy(scene, "oak", (1.0, 1.0, 1.0), 0.38, texture=texture)
    surfaces.metal(scene, "copper", surfaces.COPPER, 0.14)
    surfaces.metal(scene, "brass", surfaces.BRASS, 0.2)
    surfaces.metal(scene, "silver", surfaces.SILVER, 0.04)
    surfaces.metal(scene, "chromium", surfaces.CHROMIUM, 0.0)
    surfaces.metal(scene, "brushed steel", surfaces.STEEL, 0.3, brushed=0.8)
    surfaces.glossy(scene, "orange", (0.9, 0.33, 0.02), 0.36)
    surfaces.glossy(scene, "lemon", (0.86, 0.68, 0.05), 0.34)
    surfaces.glossy(scene, "plum", (0.13, 0.028, 0.085), 0.22)
    surfaces.glossy(scene, "red plastic", (0.62, 0.022, 0.018), 0.07)
    surfaces.glossy(scene, "black plastic", (0.018, 0.018, 0.02), 0.25)
    surfaces.glossy(scene, "glaze", (0.8, 0.79, 0.75), 0.03)
    surfaces.glass(scene, "clear glass", 1.52, absorption=((0.86, 0.95, 0.91), 0.05))
    surfaces.glass(scene, "crystal", 1.6)
    surfaces.glass(scene, "bottle glass", 1.52, absorption=((0.3, 0.62, 0.2), 0.006))
    surfaces.glass(scene, "wine", 1.34, absorption=((0.55, 0.03, 0.05), 0.012))
    surfaces.glass(scene, "frosted glass", 1.5, 0.28, absorption=((0.35, 0.7, 0.85), 0.03))


def _table(scene):
    choices = Choices(11)
    boards = []
    for k in range(BOARDS):
        z, sink = (k - 0.5 * BOARDS) * BOARD, choices.between(0.0, 0.0006)
        boards.append(bevelled((-0.95, -0.034, z + 0.0006), (0.95, -sink, z + BOARD - 0.0006),
                               0.0016))

    def uv(position, _):
        k = math.floor(position[2] / BOARD + 0.5 * BOARDS)
        return position[0] / 0.62 + 0.37 * k, position[2] / 0.36 + 0.21 * k
    scene.solid("table", "oak", boards, crease_degrees=50.0, uv=uv)
    scene.solid("parapet", "plaster", [
        bevelled((-4.0, -0.9, -1.75), (4.0, 0.33, -1.45), 0.012),
        bevelled((-4.0, 0.325, -1.79), (4.0, 0.365, -1.41), 0.01)], crease_degrees=50.0)
    scene.solid("terrace", "terrace", [box((-6.0, -0.95, -2.5), (6.0, -0.8, 5.0))])


def _parts(scene, name, parts, materials, at, rotation=None):
    """A thing of several materials, each a node of its own: glass and what it holds are solids."""
    for part, solids in parts.items():
        mesh = scene.mesh(f"{name} {part}", materials[part], finish(solids, 40.0))
        scene.place(f"{name} {part}", mesh, at, rotation)


def _things(scene):
    _parts(scene, "bottle", things.bottle(),
           {"glass": "bottle glass", "wine": "wine", "cork": "cork"}, (-0.2, 0.0, -0.135))
    _parts(scene, "wine glass", things.wine_glass(), {"glass": "clear glass", "wine": "wine"},
           (0.185, 0.0, 0.01))
    _parts(scene, "jug", things.jug(), {"body": "copper", "handle": "brass", "rivets": "brass"},
           (-0.105, 0.0, -0.07), turn(y=-158.0))
    scene.solid("bowl", "silver", things.bowl(), (0.065, 0.0, -0.09), crease_degrees=40.0)
    _parts(scene, "pepper mill", things.pepper_mill(),
           {"body": "red plastic", "metal": "chromium", "head": "red plastic"}, (0.248, 0.0, -0.1))
    scene.solid("plate", "glaze", things.plate(), (0.075, 0.0, 0.105), crease_degrees=40.0)
    blade = things.knife()

    def along(_, normal):
        return (1.0, 0.0, 0.0, 1.0) if abs(normal[0]) < 0.9 else (0.0, 0.0, 1.0, 1.0)
    for part, material in (("blade", "brushed steel"), ("handle", "black plastic"),
                           ("bolster", "brass")):
        mesh = scene.mesh(f"knife {part}", material, finish(
            blade[part], 40.0, tangent=along if part == "blade" else None))
        scene.place(f"knife {part}", mesh, (-0.035, 0.0205, 0.145), turn(y=14.0, z=0.5))
    scene.solid("marble", "crystal", things.marble(0.03, 5), (-0.172, 0.03, 0.085),
                crease_degrees=60.0)
    scene.solid("small marble", "frosted glass", things.marble(0.019, 4), (-0.118, 0.019, 0.132),
                crease_degrees=60.0)


def _fruit(scene):
    peel = Clouds(3)
    orange = scene.mesh("orange", "orange", finish(things.orange(peel), 60.0))
    plum = scene.mesh("plum", "plum", finish(things.plum(), 60.0))
    lemon = scene.mesh("lemon", "lemon", finish(things.lemon(), 60.0))
    x, z = 0.065, -0.09
    scene.place("orange 1", orange, (x - 0.037, 0.0605, z + 0.008), turn(x=24.0, z=18.0))
    scene.place("orange 2", orange, (x + 0.036, 0.0605, z - 0.012), turn(x=-20.0, y=40.0, z=-35.0))
    scene.place("plum 1", plum, (x + 0.012, 0.058, z + 0.052), turn(x=70.0, z=30.0))
    scene.place("plum 2", plum, (x - 0.004, 0.094, z + 0.0), turn(x=-30.0, y=80.0))
    scene.place("plum 3", plum, (x + 0.058, 0.064, z + 0.04), turn(x=40.0, y=-60.0, z=40.0))
    scene.place("lemon", lemon, (0.09, 0.0315, 0.085), turn(x=10.0, y=32.0, z=3.0))
    scene.place("plum 4", plum, (-0.075, 0.0225, 0.06), turn(z=-75.0, y=30.0))


def build():
    """The files of the scene: {name: bytes}."""
    scene = Builder("Still life", ALBEDO, {})
    _surfaces(scene)
    _table(scene)
    _things(scene)
    _fruit(scene)
    scene.document.add_camera("camera", (0.025, 0.3, 0.98), (0.022, 0.105, -0.05), math.radians(29.0))
    sky = Sky(SUN)
    scene.document.set_image_light("sky", FACE, cube_images(sky, FACE),
                                   irradiance_coefficients(sky))
    text, binary = scene.document.finish("still-life.bin")
    return {"still-life.gltf": text.encode("ascii"), "still-life.bin": binary,
            "still-life-wood.png": wood((92, 58, 32), (206, 158, 106), 3),
            "sky.hdr": equirectangular(sky, 256, 128)}
