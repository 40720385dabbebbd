# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A scene as `bench export_scene` wrote it, read into arrays."""

import json
import pathlib

import numpy as np

VERSION = 1


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

    def linear_texels(self, number):
        """A texture's colours, linear, height by width by 3, top row first."""
        texture = self.textures[number]
        values = texture["texels"][..., :3].astype(np.float32) / 255.0
        if not texture["srgb"]:
            return values
        return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)

    def unsupported(self, *kinds):
        """What of these the scene holds: "spot", "media", "grids", "punctual"."""
        types = {light["type"] for light in self.lights}
        held = {"spot": "spot" in types, "punctual": bool(types), "media": bool(self.media),
                "grids": any(not medium["homogeneous"] for medium in self.media)}
        return [kind for kind in kinds if held[kind]]
