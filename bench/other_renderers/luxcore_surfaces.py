# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""glTF's surfaces as materials of LuxCore: `disney` for what is opaque, `glass`, `roughglass` and
`archglass` for what is not."""

import numpy as np

import surfaces
from expressible import NotExpressible


class Materials:
    """Properties of one material by the name `name`, and the image maps that it needs."""

    def __init__(self, scene, surface, mesh, name):
        self.made, self.surface, self.mesh, self.name = scene, surface, mesh, name
        self.settings = {}

    def image(self, key, parameter, texels):
        """The name of a texture of linear texels."""
        wrap = self.surface.scene.textures[parameter["map"]["texture"]]["wrap_u"]
        if wrap == "mirror":
            raise NotExpressible("mirrored textures")
        name = f"{self.name}-{key}"
        height, width, channels = texels.shape
        self.made.DefineImageMap(name, texels.astype(np.float32).reshape(-1), 1.0, channels,
                                 width, height)
        self.settings |= {f"scene.textures.{name}.type": "imagemap",
                          f"scene.textures.{name}.file": name,
                          f"scene.textures.{name}.gamma": 1.0,
                          f"scene.textures.{name}.wrap": wrap}
        return name

    def value(self, key):
        parameter = self.surface[key]
        texels = self.surface.texels(parameter)
        return parameter["factor"] if texels is None else self.image(key, parameter, texels)

    def base_colour(self):
        colour = self.value("base_colour")
        if self.mesh.colours is None:
            return colour
        vertices, product = f"{self.name}-vertices", f"{self.name}-product"
        self.settings |= {f"scene.textures.{vertices}.type": "hitpointcolor",
                          f"scene.textures.{product}.type": "scale",
                          f"scene.textures.{product}.texture1": colour,
                          f"scene.textures.{product}.texture2": vertices}
        return product

    def material(self, name, **fields):
        """Adds a material; returns its name."""
        self.settings |= {f"scene.materials.{name}.{key}": value for key, value in fields.items()}
        return name

    def opaque(self, name):
        surface = self.surface
        colour = self.base_colour()
        if not surface.is_metallic:
            return self.material(name, type="matte", kd=colour)
        coat, gloss = surfaces.disney_coat(surface)
        fields = {"type": "disney", "basecolor": colour, "roughness": self.value("roughness"),
                  "metallic": self.value("metallic"), "clearcoat": coat,
                  "clearcoatgloss": gloss, "specular": surfaces.disney_specular(surface)}
        strength, _ = surface.anisotropy
        if strength > 0.0:
            fields["roughness"], fields["anisotropic"] = surfaces.disney_anisotropy(surface)
        normals = surface.normal_texels()
        if normals is not None:
            image = self.image("normals", surface["normal_map"], normals)
            bumps = f"{self.name}-bumps"
            self.settings |= {f"scene.textures.{bumps}.type": "normalmap",
                              f"scene.textures.{bumps}.texture": image}
            fields["bumptex"] = bumps
        return self.material(name, **fields)

    def glass(self, name):
        surface = self.surface
        fields = {"kr": [1.0, 1.0, 1.0], "kt": surface.crossing_tint(),
                  "interiorior": surface.ior, "exteriorior": 1.0}
        if not surface["solid"]:
            if not surface.is_smooth:
                raise NotExpressible("rough thin glass")
            return self.material(name, type="archglass", **fields)
        if surface.is_smooth:
            return self.material(name, type="glass", **fields)
        # Maps of roughness in glass are taken as one value, their mean.
        texels = surface.texels(surface["roughness"])
        roughness = surface.factor("roughness") if texels is None else float(texels.mean())
        alpha = surfaces.alpha_of(roughness)
        return self.material(name, type="roughglass", uroughness=alpha, vroughness=alpha, **fields)

    def add(self, both_sides):
        """Makes the material of that name."""
        share = self.surface.transmits
        name = self.name
        if surfaces.is_none(share) and not both_sides:
            self.opaque(f"{name}-front")
            self.material(f"{name}-back", type="matte", kd=[0.0, 0.0, 0.0])
            self.material(name, type="twosided", frontmaterial=f"{name}-front",
                          backmaterial=f"{name}-back")
        elif surfaces.is_none(share):
            self.opaque(name)
        elif surfaces.is_all(share):
            self.glass(name)
        else:
            self.opaque(f"{name}-opaque")
            self.glass(f"{name}-glass")
            self.material(name, type="mix", material1=f"{name}-opaque",
                          material2=f"{name}-glass", amount=share)
        opacity = self.surface.opacity()
        if opacity is None:
            return
        if not isinstance(opacity, float):
            opacity = self.image("opacity", self.surface["opacity"]["alpha"], opacity)
        self.material(name, transparency=opacity)


def settings(scene, surface, mesh, name, both_sides):
    """Properties of a material by that name; image maps that it needs are defined in `scene`."""
    materials = Materials(scene, surface, mesh, name)
    materials.add(both_sides)
    return materials.settings
