# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The scenes of preview_cost: a grey room with two balls; parts are mirrors, glass or plastic."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "material_cost"))

from cost_scenes import (  # noqa: E402 (after the path to it, which adds that to the builder)
    GREY, LAMBERT, LAMP, SOLID, TRANSMISSION, WALLS, ball_mesh)
from generator.builder import Builder, light_quad  # noqa: E402

MIRROR = {"metallic": 1.0, "roughness": 0.0}
GLASS = {"roughness": 0.0, "transmission": TRANSMISSION, "volume": SOLID}
PLASTIC = {"roughness": 0.15}
POLISHED = {"roughness": 0.0}
ROUGH_METAL = {"metallic": 1.0, "roughness": 0.3}

# What is not diffuse, by the name of the scene: materials of walls and of the two balls, which take
# a fifth of the image.
PARTS = {
    "diffuse": {},
    "a mirror and a glass ball": {"ball": MIRROR, "second": GLASS},
    "a mirror over the whole image": {"pane": MIRROR},
    "a plastic floor": {"floor": PLASTIC},
    "a plastic floor, polished": {"floor": POLISHED},
    "a rough metal ball": {"ball": ROUGH_METAL},
}

# Before the camera, which sees nothing else; the room is behind it.
PANE = [(-3, -1, -1.9), (3, -1, -1.9), (3, 5, -1.9), (-3, 5, -1.9)]


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
    builder.place("ball", builder.mesh("ball", "ball", ball_mesh(0.7)), (-0.9, 1.2, 0.2))
    builder.place("second", builder.mesh("second", "second", ball_mesh(0.7)), (0.9, 0.9, 0.6))
    if "pane" in parts:
        builder.place("pane", builder.mesh("pane", "pane", light_quad(PANE)))
        builder.document.add_camera("view", (0.0, 2.0, -0.2), (0.0, 2.0, -2.0), 1.2)
    else:
        builder.document.add_camera("view", (0.0, 1.9, 6.0), (0.0, 1.9, 0.0), 0.66)
    return builder.document.finish()[0]
