#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Checks an exported scene against the glTF file that it was made of: exported_box.py FILE FOLDER.

The file is one whose nodes with meshes have no transforms, such as the Cornell box. Ends with exit
code 1 and one line where the two differ.
"""

import array
import base64
import json
import math
import pathlib
import sys

COMPONENTS = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC3": 3}


def expect(condition, what):
    if not condition:
        sys.exit(f"exported_box.py: {what}")


def accessor(document, buffers, number):
    """Rows of an accessor without stride."""
    fields = document["accessors"][number]
    view = document["bufferViews"][fields["bufferView"]]
    kind, width = COMPONENTS[fields["componentType"]], WIDTHS[fields["type"]]
    values = array.array(kind)
    first = view.get("byteOffset", 0) + fields.get("byteOffset", 0)
    size = fields["count"] * width * values.itemsize
    values.frombytes(buffers[view["buffer"]][first:first + size])
    return [tuple(values[i:i + width]) for i in range(0, len(values), width)]


def file_triangles(document, folder):
    """Corners of all triangles by the name of their material, each list sorted."""
    buffers = []
    for buffer in document["buffers"]:
        head, comma, data = buffer["uri"].partition(",")
        buffers.append(base64.b64decode(data) if comma else (folder / head).read_bytes())
    found = {}
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        expect(not {"matrix", "translation", "rotation", "scale"} & set(node), "a mesh is moved")
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            points = accessor(document, buffers, primitive["attributes"]["POSITION"])
            order = [row[0] for row in accessor(document, buffers, primitive["indices"])]
            name = document["materials"][primitive["material"]]["name"]
            corners = [points[i] for i in order]
            found.setdefault(name, []).extend(zip(corners[::3], corners[1::3], corners[2::3]))
    return {name: sorted(triangles) for name, triangles in found.items()}


def exported_triangles(fields, folder):
    found = {}
    for mesh in fields["meshes"]:
        positions, order = array.array("f"), array.array("I")
        positions.frombytes((folder / mesh["positions"]).read_bytes())
        order.frombytes((folder / mesh["triangles"]).read_bytes())
        expect(len(positions) == 3 * mesh["vertex_count"], "vertex_count is wrong")
        expect(len(order) == 3 * mesh["triangle_count"], "triangle_count is wrong")
        corners = [tuple(positions[3 * i:3 * i + 3]) for i in order]
        name = fields["materials"][mesh["material"]]["name"]
        found.setdefault(name, []).extend(zip(corners[::3], corners[1::3], corners[2::3]))
    return {name: sorted(triangles) for name, triangles in found.items()}


def near(first, second, tolerance):
    return math.dist(first, second) <= tolerance


def check_materials(document, fields):
    exported = {material["name"]: material for material in fields["materials"]}
    expect(len(exported) == len(fields["materials"]), "two materials have the same name")
    for theirs in document["materials"]:
        name = theirs["name"]
        expect(name in exported, f"material {name} is missing")
        ours = exported[name]
        colour = theirs["pbrMetallicRoughness"]["baseColorFactor"][:3]
        expect(ours["lambertian"] is True, f"lobe of {name}")
        expect(near(ours["reflectance"], colour, 1e-6), f"reflectance of {name}")
        strength = theirs.get("extensions", {}).get(
            "KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
        radiance = [strength * value for value in theirs.get("emissiveFactor", [0.0] * 3)]
        expect(near(ours["radiance"], radiance, 1e-5 * max(1.0, strength)), f"radiance of {name}")
        emits = max(radiance) > 0.0
        expect(ours["emits_both_sides"] == (emits and theirs.get("doubleSided", False)),
               f"sides of {name}")


def main():
    file, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    document = json.loads(file.read_text(encoding="utf-8"))
    fields = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    expect(fields["weft_scene_export"] == 1, "the version is not 1")
    check_materials(document, fields)
    ours, theirs = exported_triangles(fields, folder), file_triangles(document, file.parent)
    expect(ours.keys() == theirs.keys(), "other materials have triangles")
    expect(any(theirs.values()), "there are no triangles")
    for name, triangles in theirs.items():
        expect(len(ours[name]) == len(triangles), f"{name} has another number of triangles")
        for one, other in zip(ours[name], triangles):
            # Corners begin anywhere; their order is the side.
            turns = [other[turn:] + other[:turn] for turn in range(3)]
            expect(any(all(near(p, q, 1e-6) for p, q in zip(one, turned)) for turned in turns),
                   f"a triangle of {name} lies elsewhere")
    camera = document["cameras"][0]["perspective"]
    expect(abs(fields["camera"]["vertical_fov"] - camera["yfov"]) < 1e-6, "the field of view")
    node = next(node for node in document["nodes"] if "camera" in node)
    expect(near(fields["camera"]["position"], node["translation"], 1e-9), "the camera's place")
    expect(not fields["lights"] and not fields["media"], "there is light or fog from nowhere")


if __name__ == "__main__":
    main()
