# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The scenes of preview_cost: a grey room with two balls; parts are mirrors, glass or plastic."""

import pathlib
import sys

BENCH = pathlib.Path(__file__).resolve().parents[1]
sys.path += [str(BENCH / "material_cost"), str(BENCH.parent / "scenes")]

from cost_scenes import GREY, LAMBERT, LAMP, SOLID, TRANSMISSION, WALLS  # noqa: E402
from generator.builder import Builder, light_quad  # noqa: E402 (after the paths to them)
from generator.solids import Mesh, sphere  # noqa: E402

MIRROR = {"metallic": 1.0, "roughness": 0.0}
GLASS = {"roughness": 0.0, "transmission": TRANSMISSION, "volume": SOLID}
PLASTIC = {"roughness": 0.15}

# What is not diffuse, by the name of the scene: materials of walls and of the two balls, which take
# a fifth of the image.
PARTS = {
    "diffuse": {},
    "a mirror and a glass ball": {"ball": MIRROR, "second": GLASS},
    "a mirror over the whole image": {"pane": MIRROR},
    "a plastic floor": {"floor": PLASTIC},
    "a plastic floor, polished": {"floor": {"roughness": 0.0}},
    "a rough metal ball": {"ball": {"metallic": 1.0, "roughness": 0.3}},
}

# Before the camera, which sees nothing else; the room is behind it.
PANE = [(-3, -1, -1.9), (3, -1, -1.9), (3, 5, -1.9), (-3, 5, -1.9)]


def ball_mesh(name, material):
    points, triangles = sphere(5, lambda direction: 0.7)
    normals = sphere(5, lambda direction: 1.0)[0]
    return (name, material, Mesh(points, triangles, normals=normals))


def scene_text(name):
    """The glTF file of a scene of PARTS, its buffer inside."""
    parts = PARTS[name]
    builder = Builder(name, {"grey": GREY}, {"lamp": (10.0, 10.0, 10.0)})
    for part in [*WALLS, "ball", "second", "pane"]:
        builder.materials[part] = builder.document.add_surface(part, GREY,
                                                               **parts.get(part, LAMBERT))
    for wall, corners in WALLS.items():
        builder.place(wall, builder.mesh(wall, wall, light_quad(corners)))
    builder.light("lamp", "lamp", LAMP)
    builder.place("ball", builder.mesh(*ball_mesh("ball", "ball")), (-0.9, 1.2, 0.2))
    builder.place("second", builder.mesh(*ball_mesh("second", "second")), (0.9, 0.9, 0.6))
    if "pane" in parts:
        builder.place("pane", builder.mesh("pane", "pane", light_quad(PANE)))
        builder.document.add_camera("view", (0.0, 2.0, -0.2), (0.0, 2.0, -2.0), 1.2)
    else:
        builder.document.add_camera("view", (0.0, 1.9, 6.0), (0.0, 1.9, 0.0), 0.66)
    return builder.document.finish()[0]
