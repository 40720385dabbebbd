# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""glTF's surfaces as BSDFs of Mitsuba 3: `principled` where opaque, dielectrics for glass."""

import numpy as np

import surfaces
from expressible import NotExpressible

LEAST_SPECULAR = 1e-3  # Mitsuba refuses 0

def rgb(values):
    return {"type": "rgb", "value": [float(value) for value in values]}


def bitmap(mi, surface, parameter, texels):
    """A texture of linear texels, wrapped as that of the parameter."""
    texture = surface.scene.textures[parameter["map"]["texture"]]
    return {"type": "bitmap", "raw": True, "wrap_mode": texture["wrap_u"],
            "bitmap": mi.Bitmap(np.ascontiguousarray(texels, dtype=np.float32)),
            "filter_type": "nearest" if texture["nearest"] else "bilinear"}


def value(mi, surface, parameter):
    """A parameter as a texture or a constant."""
    texels = surface.texels(parameter)
    if texels is not None:
        return bitmap(mi, surface, parameter, texels)
    factor = parameter["factor"]
    return rgb(factor) if isinstance(factor, list) else float(factor)


def base_colour(mi, surface, mesh):
    if mesh.colours is None:
        return value(mi, surface, surface["base_colour"])
    if surface["base_colour"]["map"] or surface.factor("base_colour") != [1.0, 1.0, 1.0]:
        raise NotExpressible("vertex colours on a texture or a colour")
    return {"type": "mesh_attribute", "name": "vertex_color"}


def opaque(mi, surface, mesh):
    colour = base_colour(mi, surface, mesh)
    if not surface.is_metallic:
        return {"type": "diffuse", "reflectance": colour}
    coat, gloss = surfaces.disney_coat(surface)
    made = {"type": "principled", "base_color": colour,
            "roughness": value(mi, surface, surface["roughness"]),
            "metallic": value(mi, surface, surface["metallic"]),
            "specular": max(surfaces.disney_specular(surface), LEAST_SPECULAR)}
    strength, _ = surface.anisotropy
    if strength > 0.0:
        made["roughness"], made["anisotropic"] = surfaces.disney_anisotropy(surface)
    if coat > 0.0:
        made["clearcoat"], made["clearcoat_gloss"] = coat, gloss
    return made


def glass(surface):
    tint = rgb(surface.crossing_tint())
    if not surface["solid"]:
        if not surface.is_smooth:
            raise NotExpressible("rough thin glass")
        return {"type": "thindielectric", "int_ior": surface.ior, "ext_ior": 1.0,
                "specular_transmittance": tint}
    if surface.ior == 1.0:
        raise NotExpressible("solids without an index")
    made = {"type": "dielectric", "int_ior": surface.ior, "ext_ior": 1.0,
            "specular_transmittance": tint}
    if surface.is_smooth:
        return made
    # Maps of roughness in glass are taken as one value, their mean.
    texels = surface.texels(surface["roughness"])
    roughness = surface.factor("roughness") if texels is None else float(texels.mean())
    return made | {"type": "roughdielectric", "distribution": "ggx",
                   "alpha": surfaces.alpha_of(roughness)}


def with_gaps(mi, surface, bsdf):
    opacity = surface.opacity()
    if opacity is None:
        return bsdf
    if not isinstance(opacity, float):
        opacity = bitmap(mi, surface, surface["opacity"]["alpha"], opacity)
    return {"type": "mask", "opacity": opacity, "bsdf": bsdf}


def bsdf(mi, surface, mesh, both_sides):
    """What load_dict takes."""
    share = surface.transmits
    made = None
    if not surfaces.is_all(share):
        made = opaque(mi, surface, mesh)
        normals = surface.normal_texels()
        if normals is not None:
            made = {"type": "normalmap", "bsdf": made,
                    "normalmap": bitmap(mi, surface, surface["normal_map"], normals)}
        if both_sides and surfaces.is_none(share):
            made = {"type": "twosided", "bsdf": made}
    if not surfaces.is_none(share):
        through = glass(surface)
        made = through if made is None else \
            {"type": "blendbsdf", "weight": share, "first": made, "second": through}
    return with_gaps(mi, surface, made)
