# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A scene as `bench export_scene` wrote it, read into arrays."""

import json
import pathlib

import numpy as np

from expressible import NotExpressible, refuse
from surfaces import Surface, environment_in_world

VERSION = 1
SPOT_EDGE = 512  # texels along an edge of the image of a spot light
SPOT_MARGIN = 1.02  # what that image shows, of the light's cone
NARROWEST_RIM = 0.001  # between the cosines of a spot light's cones, as Weft takes it


class Mesh:
    """Triangles of one material, or a boundary of media, whose material is None."""

    def __init__(self, folder, fields):
        def array(key, kind, width):
            if fields[key] is None:
                return None
            return np.fromfile(folder / fields[key], dtype=kind).reshape(-1, width)

        self.material = fields.get("material")
        self.positions = array("positions", "<f4", 3)
        self.normals = array("normals", "<f4", 3)
        self.uvs = array("uvs", "<f4", 2)
        self.colours = array("colours", "<f4", 3)
        self.triangles = array("triangles", "<u4", 3)

    def turned(self, distance):
        """The same triangles seen from behind, apart by `distance` along their normals."""
        corners = self.positions[self.triangles].astype(np.float64)
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        copy = object.__new__(Mesh)
        copy.material = self.material
        flat = (corners - distance * normal[:, None, :]).reshape(-1, 3)
        copy.positions = flat.astype(np.float32)
        order = self.triangles.reshape(-1)
        copy.normals = None if self.normals is None else -self.normals[order]
        copy.uvs = None if self.uvs is None else self.uvs[order]
        copy.colours = None if self.colours is None else self.colours[order]
        numbers = np.arange(len(order), dtype=np.uint32).reshape(-1, 3)
        copy.triangles = np.ascontiguousarray(numbers[:, ::-1])
        return copy


class ExportedScene:
    """All that scene.json holds; fields as docs/benchmarks.md names them."""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        fields = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
        if fields.get("weft_scene_export") != VERSION:
            raise ValueError(f"{folder}: is no exported scene of version {VERSION}")
        self.camera = fields["camera"]
        self.materials = fields["materials"]
        self.meshes = [Mesh(folder, mesh) for mesh in fields["meshes"]]
        self.lights = fields["lights"]
        self.environment = fields["environment"]
        self.environment_image = fields.get("environment_image")
        if self.environment_image is not None:
            image = self.environment_image
            texels = np.fromfile(folder / image["file"], dtype="<f4")
            image["texels"] = texels.reshape(image["height"], image["width"], 3)
        self.media = fields["media"]
        self.boundaries = fields["boundaries"]
        self.boundary_meshes = [Mesh(folder, boundary) for boundary in self.boundaries]
        self.camera_medium = fields["camera_medium"]
        self.radius = fields["radius"]
        self.centre = fields["centre"]
        self.textures = fields["textures"]
        for texture in self.textures:
            texture["texels"] = None
            if texture["file"] is not None:
                texels = np.fromfile(folder / texture["file"], dtype=np.uint8)
                texture["texels"] = texels.reshape(texture["height"], texture["width"], 4)

    def emits(self, material):
        """Whether surfaces of that material shine."""
        return max(self.materials[material]["radiance"]) > 0.0

    def surface(self, material):
        """The Surface of a material by its number, or None where it is Lambertian."""
        fields = self.materials[material].get("surface")
        return Surface(self, fields) if fields else None

    def environment_texels(self):
        """Radiance from all around in the world, see surfaces.environment_in_world; None where
        there is no image of it."""
        if self.environment_image is None:
            return None
        return environment_in_world(self.environment_image) * np.array(self.environment, np.float32)

    def linear_texels(self, number):
        """A texture's colours, linear, height by width by 3, top row first."""
        texture = self.textures[number]
        values = texture["texels"][..., :3].astype(np.float32) / 255.0
        if not texture["srgb"]:
            return values
        return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)

    def refuse(self, *kinds):
        """Raises NotExpressible where the scene holds any of these: see expressible.refuse."""
        refuse(self, kinds)


def spot_rim(light):
    """Between the cosines of angles to a spot light's axis where it is dark and where it is not
    weakened."""
    return max(NARROWEST_RIM, light["cos_inner"] - light["cos_outer"])


def spot_falloff(light, cosine):
    """Of a spot light's intensity, at cosines of angles to its axis, as in Weft: glTF's, or linear
    with the angle."""
    if light.get("linear_edge"):
        outer, inner = np.arccos(light["cos_outer"]), np.arccos(light["cos_inner"])
        angle = np.arccos(np.clip(cosine, -1.0, 1.0))
        return np.clip((outer - angle) / max(outer - inner, 2.0**-20), 0.0, 1.0)
    return np.clip((cosine - light["cos_outer"]) / spot_rim(light), 0.0, 1.0) ** 2


def spot_angle(light):
    """The angle in radians from the axis to the edge of `spot_texels`."""
    angle = SPOT_MARGIN * np.arccos(light["cos_outer"])
    if angle >= np.radians(80.0):
        raise NotExpressible("spot lights that are that wide")
    return float(angle)


def spot_texels(light):
    """What a spot light casts on a plane across its axis, of its intensity: square, the centre on
    the axis, edges `spot_angle` from it. Renderers whose spots fall off differently project it."""
    place = (np.arange(SPOT_EDGE) + 0.5) * (2.0 / SPOT_EDGE) - 1.0
    tangents = np.hypot(*np.meshgrid(place, place)) * np.tan(spot_angle(light))
    falloff = spot_falloff(light, 1.0 / np.sqrt(1.0 + tangents * tangents))
    return np.repeat(falloff[..., None], 3, axis=2).astype(np.float32)
