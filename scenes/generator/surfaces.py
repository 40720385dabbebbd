# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Metals, glass, glazes and plastics as glTF has them, for scenes that show more than diffuse
surfaces. Each function adds one material to a builder, under its name."""

# Reflectance of clean metals straight on, linear Rec.709.
SILVER = (0.96, 0.94, 0.9)
ALUMINIUM = (0.91, 0.92, 0.92)
CHROMIUM = (0.55, 0.556, 0.554)
STEEL = (0.56, 0.57, 0.58)
COPPER = (0.95, 0.62, 0.5)
BRASS = (0.89, 0.76, 0.46)


def metal(builder, name, colour, roughness, brushed=0.0):
    """`brushed` is the strength of the anisotropy: facets are rougher along tangents."""
    extensions = {"anisotropy": {"anisotropyStrength": brushed}} if brushed else {}
    builder.materials[name] = builder.document.add_surface(name, colour, 1.0, roughness,
                                                           **extensions)


def glossy(builder, name, colour, roughness, ior=1.5, texture=None):
    """A dielectric over a diffuse body: plastic, glaze, varnish, wax, rubber."""
    extensions = {} if ior == 1.5 else {"ior": {"ior": ior}}
    builder.materials[name] = builder.document.add_surface(name, colour, 0.0, roughness, texture,
                                                           **extensions)


def glass(builder, name, ior=1.5, roughness=0.0, absorption=None):
    """A solid that light passes through; its meshes have to be closed. `absorption`: the colour
    that white light has after a way through it, and that way in metres."""
    volume = {"thicknessFactor": 1.0}
    if absorption:
        colour, distance = absorption
        volume.update(attenuationColor=list(colour), attenuationDistance=distance)
    extensions = {} if ior == 1.5 else {"ior": {"ior": ior}}
    builder.materials[name] = builder.document.add_surface(
        name, (1.0, 1.0, 1.0), 0.0, roughness, transmission={"transmissionFactor": 1.0},
        volume=volume, **extensions)


def pane(builder, name, colour=(1.0, 1.0, 1.0)):
    """Glass without thickness, which does not bend light."""
    builder.materials[name] = builder.document.add_surface(
        name, colour, 0.0, 0.0, transmission={"transmissionFactor": 1.0})


def lacquer(builder, name, colour, flake_roughness):
    """Car paint: flakes of metal below a smooth clear coat."""
    builder.materials[name] = builder.document.add_surface(
        name, colour, 1.0, flake_roughness,
        clearcoat={"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.0})
