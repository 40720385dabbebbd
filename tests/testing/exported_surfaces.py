#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Checks the surfaces of an exported scene against the glTF file that it was made of:
exported_surfaces.py FILE FOLDER.

Ends with exit code 1 and one line where the two differ.
"""

import json
import math
import pathlib
import sys


def expect(condition, what):
    if not condition:
        sys.exit(f"exported_surfaces.py: {what}")


def near(first, second):
    return math.isclose(first, second, rel_tol=1e-6, abs_tol=1e-7)


def scalars(theirs):
    """Numbers of a material by the key of the export, with glTF's defaults."""
    rough = theirs.get("pbrMetallicRoughness", {})
    extensions = theirs.get("extensions", {})

    def extension(name):
        return extensions.get(f"KHR_materials_{name}", {})

    return {"metallic": rough.get("metallicFactor", 1.0),
            "roughness": rough.get("roughnessFactor", 1.0),
            "ior": extension("ior").get("ior", 1.5),
            "specular": extension("specular").get("specularFactor", 1.0),
            "transmission": extension("transmission").get("transmissionFactor", 0.0),
            "clearcoat": extension("clearcoat").get("clearcoatFactor", 0.0),
            "anisotropy": extension("anisotropy").get("anisotropyStrength", 0.0)}


def told(surface, key):
    value = surface[key]
    while isinstance(value, dict):
        value = value["factor"] if "factor" in value else value["strength"]
    return value


def main():
    file, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    document = json.loads(file.read_text(encoding="utf-8"))
    fields = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    exported = {material["name"]: material for material in fields["materials"]}
    checked = 0
    for theirs in document["materials"]:
        name = theirs["name"]
        if name not in exported:
            continue  # no surface has it
        surface = exported[name]["surface"]
        expect(exported[name]["lambertian"] == (surface is None), f"lobe of {name}")
        if surface is None:
            continue
        checked += 1
        for key, value in scalars(theirs).items():
            expect(near(told(surface, key), value), f"{key} of {name}")
        expect(surface["solid"] == ("KHR_materials_volume" in theirs.get("extensions", {})),
               f"whether {name} is solid")
    expect(checked > 0, "no material has a surface beyond Lambert's law")
    for mesh in fields["meshes"]:
        surface = fields["materials"][mesh["material"]]["surface"]
        if surface and surface["anisotropy"]["strength"] > 0.0:
            expect(mesh["uvs"] is not None, "a surface with a direction has no coordinates")
            size = (folder / mesh["uvs"]).stat().st_size
            expect(size == 8 * mesh["vertex_count"], "coordinates are missing")


if __name__ == "__main__":
    main()
