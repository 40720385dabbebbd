# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The scenes of material_cost: a grey room, open to the camera, with a lamp and a ball."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))

from generator.builder import Builder, light_quad  # noqa: E402 (after the path to it)
from generator.solids import Mesh, sphere  # noqa: E402

GREY = (0.8, 0.8, 0.8)
LAMBERT = {"roughness": 1.0, "specular": {"specularFactor": 0.0}}
TRANSMISSION = {"transmissionFactor": 1.0}
SOLID = {"thicknessFactor": 1.0}

# What Document.add_surface takes for the ball, by name; "speck" puts a metal out of sight, and
# "alpha" lets a share of the light pass.
MATERIALS = {
    "diffuse": LAMBERT,
    "diffuse beside a metal": {**LAMBERT, "speck": True},
    "metal, smooth": {"metallic": 1.0, "roughness": 0.0},
    "metal, roughness 0.5": {"metallic": 1.0, "roughness": 0.5},
    "metal, anisotropic": {"metallic": 1.0, "roughness": 0.3,
                           "anisotropy": {"anisotropyStrength": 0.8}},
    "dielectric on a diffuse body": {"roughness": 0.3},
    "the same with a clear coat": {"roughness": 0.3, "clearcoat": {"clearcoatFactor": 1.0}},
    "thin glass": {"roughness": 0.0, "transmission": TRANSMISSION},
    "solid glass, smooth": {"roughness": 0.0, "transmission": TRANSMISSION, "volume": SOLID},
    "solid glass, roughness 0.3": {"roughness": 0.3, "transmission": TRANSMISSION,
                                   "volume": SOLID},
    "half there, by alpha": {**LAMBERT, "alpha": 0.5},
}

# Rectangles, counter-clockwise from the side that is seen.
WALLS = {
    "floor": [(-2, 0, -2), (-2, 0, 2), (2, 0, 2), (2, 0, -2)],
    "ceiling": [(-2, 4, -2), (2, 4, -2), (2, 4, 2), (-2, 4, 2)],
    "back": [(-2, 0, -2), (2, 0, -2), (2, 4, -2), (-2, 4, -2)],
    "left": [(-2, 0, 2), (-2, 0, -2), (-2, 4, -2), (-2, 4, 2)],
    "right": [(2, 0, -2), (2, 0, 2), (2, 4, 2), (2, 4, -2)],
}
LAMP = [(-0.6, 3.9, -0.6), (0.6, 3.9, -0.6), (0.6, 3.9, 0.6), (-0.6, 3.9, 0.6)]


def ball_mesh(radius):
    """A smooth ball about the origin."""
    points, triangles = sphere(5, lambda direction: radius)
    normals = sphere(5, lambda direction: 1.0)[0]
    return Mesh(points, triangles, normals=normals)


def scene_text(name):
    """The glTF file of a material of MATERIALS, its buffer inside."""
    builder = Builder(name, {"grey": GREY}, {"lamp": (10.0, 10.0, 10.0)})
    for wall, corners in WALLS.items():
        builder.place(wall, builder.mesh(wall, "grey", light_quad(corners)))
    builder.light("lamp", "lamp", LAMP)
    how = dict(MATERIALS[name])
    speck = how.pop("speck", False)
    alpha = how.pop("alpha", 1.0)
    material = builder.document.add_surface("ball", GREY, **how)
    if alpha < 1.0:
        stored = builder.document.json["materials"][material]
        stored["alphaMode"] = "BLEND"
        stored["pbrMetallicRoughness"]["baseColorFactor"][3] = alpha
    builder.materials["ball"] = material
    builder.place("ball", builder.mesh("ball", "ball", ball_mesh(1.3)), (0.0, 1.4, 0.0))
    if speck:
        # All that it does is to call for materials.
        builder.materials["speck"] = builder.document.add_surface("speck", GREY, 1.0, 0.5)
        corners = [(0, 0, 50), (0.1, 0, 50), (0.1, 0.1, 50), (0, 0.1, 50)]
        builder.place("speck", builder.mesh("speck", "speck", light_quad(corners)))
    builder.document.add_camera("view", (0.0, 1.9, 7.0), (0.0, 1.9, 0.0), 0.6)
    return builder.document.finish()[0]
