# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Surfaces beyond Lambert's law of an exported scene, and what renderers' programs need of them:
glTF's metals, plastics, coats, glass and gaps."""

import math

import numpy as np

from expressible import NotExpressible

CHANNELS = {"red": 0, "green": 1, "blue": 2, "alpha": 3}
LEAST_ROUGHNESS = 1.0 / 32.0  # below it facets are smooth: alpha is less than 0.001
RIGHT = 1.0 / 64.0  # by which a share may differ from one that is all or nothing


class Surface:
    """What `materials[].surface` says of one material."""

    def __init__(self, scene, fields):
        self.scene = scene
        self.fields = fields
        self.model = fields["model"]
        if self.model == "other":
            raise NotExpressible("materials that glTF does not have")
        if self.model == "unlit":
            raise NotExpressible("unlit surfaces")
        if fields["several_coordinates"]:
            raise NotExpressible("maps with several texture coordinates")
        if self.model == "metallic" and fields["anisotropy"]["map"]:
            raise NotExpressible("maps of anisotropy")

    def __getitem__(self, key):
        return self.fields[key]

    def factor(self, key):
        return self.fields[key]["factor"]

    @property
    def is_metallic(self):
        return self.model == "metallic"

    @property
    def transmits(self):
        """The share of light below the boundary that goes through, 0 to 1, without its map."""
        if not self.is_metallic:
            return 0.0
        if self["transmission"]["map"]:
            raise NotExpressible("maps of transmission")
        return self.factor("transmission") * (1.0 - self.plain("metallic"))

    def plain(self, key):
        """A factor where no map changes it: a map of the metallic share counts as no metal."""
        return 0.0 if self.fields[key]["map"] else self.factor(key)

    @property
    def is_smooth(self):
        return not self["roughness"]["map"] and self.factor("roughness") < LEAST_ROUGHNESS

    @property
    def ior(self):
        return max(self["ior"], 1.0)

    def reflectance(self):
        """At normal incidence of what is no metal, the strength of its reflection counted in."""
        root = (self["ior"] - 1.0) / (self["ior"] + 1.0)
        strength = 1.0 if self["specular"]["map"] else self.factor("specular")
        colour = self.factor("specular_colour")
        return strength * root * root * float(np.dot(colour, (0.2126, 0.7152, 0.0722)))

    def crossing_tint(self):
        """The colour of one passage of glass's boundary; what absorbs inside counts half at each
        of two, over the distance that the file names."""
        colour = np.array(self.factor("base_colour"), dtype=float)
        if self["tints_by_root"]:
            colour = np.sqrt(colour)
        inside = self["absorption"]
        if self["solid"] and inside["distance"] > 0.0:
            colour = colour * np.sqrt(np.array(inside["colour"], dtype=float))
        return colour.clip(0.0, 1.0).tolist()

    @property
    def coat(self):
        """The clear coat's share, 0 to 1, and its roughness, without their maps."""
        if not self.is_metallic:
            return 0.0, 0.0
        coat = self["clearcoat"]
        return coat["factor"]["factor"], coat["roughness"]["factor"]

    @property
    def anisotropy(self):
        """Strength, 0 to 1, and the angle in radians from the tangent, counter-clockwise."""
        if not self.is_metallic:
            return 0.0, 0.0
        return self["anisotropy"]["strength"], self["anisotropy"]["rotation"]

    def texels(self, parameter):
        """The map of a parameter, linear and times its factor: height by width by 3 for colours,
        by 1 for others. None where it has no map."""
        found = parameter["map"]
        if not found:
            return None
        factor = np.array(parameter["factor"], dtype=np.float32)
        if found["channel"] == "rgb":
            return self.scene.linear_texels(found["texture"]) * factor
        texels = self.scene.textures[found["texture"]]["texels"]
        channel = CHANNELS.get(found["channel"])
        if channel is None:
            raise NotExpressible(f"maps of {found['channel']}")
        return texels[..., channel:channel + 1].astype(np.float32) / 255.0 * factor

    def normal_texels(self):
        """Normals as colours, height by width by 3, the x and y of each times the map's scale; None
        where there is no such map."""
        normals = self["normal_map"]
        if not normals:
            return None
        texels = self.scene.textures[normals["map"]["texture"]]["texels"][..., :3]
        directions = texels.astype(np.float32) / 127.5 - 1.0
        directions[..., :2] *= normals["scale"]
        directions /= np.maximum(np.linalg.norm(directions, axis=2, keepdims=True), 1e-6)
        return 0.5 * directions + 0.5

    def opacity(self):
        """None where the surface has no gaps, else texels as `texels` returns them, or a number:
        1 where it is there, 0 in gaps."""
        opacity = self["opacity"]
        if opacity["mode"] == "opaque":
            return None
        alpha = self.texels(opacity["alpha"])
        if alpha is None:
            alpha = opacity["alpha"]["factor"]
        if opacity["mode"] == "mask":
            alpha = (np.array(alpha) >= opacity["cutoff"]).astype(np.float32)
            alpha = float(alpha) if alpha.ndim == 0 else alpha
        return alpha


def is_all(share):
    return share > 1.0 - RIGHT


def is_none(share):
    return share < RIGHT


def disney_specular(surface):
    """Disney's strength of reflection, of which 0.08 is the reflectance at normal incidence."""
    return float(np.clip(surface.reflectance() / 0.08, 0.0, 1.0))


def disney_coat(surface):
    """Disney's strength of a coat, of which a quarter counts, and the gloss of its facets, whose
    alpha is 0.1 at 0 and 0.001 at 1."""
    coat, roughness = surface.coat
    gloss = (0.1 - alpha_of(roughness)) / (0.1 - 0.001)
    return 4.0 * coat, float(np.clip(gloss, 0.0, 1.0))


def disney_anisotropy(surface):
    """Disney's roughness and anisotropy: glTF leaves alpha across the direction as it is, Disney's
    aspect, the root of the ratio, changes both."""
    along, across = anisotropic_alphas(surface, surface.factor("roughness"))
    return float((along * across) ** 0.25), float(min((1.0 - across / along) / 0.9, 1.0))


def alpha_of(roughness):
    """The width of facets for glTF's roughness."""
    return max(roughness * roughness, 1e-4)


def anisotropic_alphas(surface, roughness):
    """Along the direction of glTF's anisotropy and across it (KHR_materials_anisotropy)."""
    strength, _ = surface.anisotropy
    alpha = alpha_of(roughness)
    return alpha + (1.0 - alpha) * strength * strength, alpha


def environment_in_world(image):
    """Rows of the image of the environment, top row first, as directions of the world meet them:
    u = 1/2 + atan2(z, x) / 2 pi, v = acos(y) / pi."""
    texels = image["texels"]
    to_world = np.array(image["to_world"], dtype=float).T  # columns are listed
    height, width = texels.shape[:2]
    if np.allclose(to_world, np.eye(3)) and not image["rows_at_poles"]:
        return texels
    theta = (np.arange(height) + 0.5) / height * math.pi
    phi = ((np.arange(width) + 0.5) / width - 0.5) * 2.0 * math.pi
    x = np.sin(theta)[:, None] * np.cos(phi)
    z = np.sin(theta)[:, None] * np.sin(phi)
    y = np.broadcast_to(np.cos(theta)[:, None], x.shape)
    local = np.stack([x, y, z], axis=-1) @ to_world  # the transpose, as it is orthogonal
    u = np.arctan2(local[..., 2], local[..., 0]) / (2.0 * math.pi) + 0.5
    v = np.arccos(local[..., 1].clip(-1.0, 1.0)) / math.pi
    across = u * width - 0.5
    down = v * (height - 1) if image["rows_at_poles"] else v * height - 0.5
    column, row = np.floor(across).astype(int), np.floor(down).astype(int)
    right, low = (across - column)[..., None], (down - row)[..., None]

    def at(i, j):
        return texels[np.clip(j, 0, height - 1), i % width]

    top = at(column, row) * (1.0 - right) + at(column + 1, row) * right
    bottom = at(column, row + 1) * (1.0 - right) + at(column + 1, row + 1) * right
    return (top * (1.0 - low) + bottom * low).astype(np.float32)
