#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What each lobe of a material adds to the time of a sample of path tracing.

The program writes one scene after the other: a grey room with an area light and a ball, whose
material is the one measured. Light scatters about the ball as the material makes it, so that a time
holds longer or shorter paths as well as the code of the lobe: of a mirror all paths go on, of a
black surface none. Rays are therefore listed beside it. The scenes are rendered in turn, several
times; times are ratios to the diffuse ball in the same round, and their median is printed."""

import argparse
import json
import math
import pathlib
import statistics
import struct
import subprocess
import sys
import tempfile

MATERIALS = {
    "diffuse": {"metallic": 0.0, "roughness": 1.0, "lambert": True},
    "diffuse beside a metal": {"metallic": 0.0, "roughness": 1.0, "lambert": True, "speck": True},
    "metal, smooth": {"metallic": 1.0, "roughness": 0.0},
    "metal, roughness 0.5": {"metallic": 1.0, "roughness": 0.5},
    "metal, anisotropic": {
        "metallic": 1.0, "roughness": 0.3,
        "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.8}}},
    "dielectric on a diffuse body": {"metallic": 0.0, "roughness": 0.3},
    "the same with a clear coat": {
        "metallic": 0.0, "roughness": 0.3,
        "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1.0}}},
    "thin glass": {
        "metallic": 0.0, "roughness": 0.0,
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0}}},
    "solid glass, smooth": {
        "metallic": 0.0, "roughness": 0.0,
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0},
                       "KHR_materials_volume": {"thicknessFactor": 1.0}}},
    "solid glass, roughness 0.3": {
        "metallic": 0.0, "roughness": 0.3,
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0},
                       "KHR_materials_volume": {"thicknessFactor": 1.0}}},
    "half there, by alpha": {"metallic": 0.0, "roughness": 1.0, "lambert": True, "alpha": 0.5},
}


def ball(rings=24):
    """Positions and triangles of a unit ball, counter-clockwise from outside."""
    points, faces = [], []
    columns = 2 * rings
    for i in range(rings + 1):
        for j in range(columns + 1):
            theta, phi = math.pi * i / rings, 2.0 * math.pi * j / columns
            points.append((math.sin(theta) * math.cos(phi), math.cos(theta),
                           -math.sin(theta) * math.sin(phi)))
    for i in range(rings):
        for j in range(columns):
            a = i * (columns + 1) + j
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            if i > 0:
                faces.append((a, c, b))
            if i < rings - 1:
                faces.append((b, c, d))
    return points, faces


def quad(corner, u, v):
    """A rectangle, seen from the side of u x v."""
    add = lambda p, q: tuple(x + y for x, y in zip(p, q))
    return [corner, add(corner, u), add(add(corner, u), v), add(corner, v)], [(0, 1, 2), (0, 2, 3)]


def gltf_material(entry):
    """A glTF material of an entry of MATERIALS."""
    material = {"pbrMetallicRoughness": {
        "baseColorFactor": [0.8, 0.8, 0.8, entry.get("alpha", 1.0)],
        "metallicFactor": entry["metallic"], "roughnessFactor": entry["roughness"]},
        "extensions": dict(entry.get("extensions", {}))}
    if entry.get("lambert"):
        material["extensions"]["KHR_materials_specular"] = {"specularFactor": 0.0}
    if "alpha" in entry:
        material["alphaMode"] = "BLEND"
    return material


def write_scene(path, entry):
    """Writes the scene of a material: a room open to the camera, with a lamp and the ball."""
    grey = {"metallic": 0.0, "roughness": 1.0, "lambert": True}
    lamp = gltf_material(grey)
    lamp["emissiveFactor"] = [1.0, 1.0, 1.0]
    lamp["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": 10.0}
    parts = [(quad((-2, 0, -2), (0, 0, 4), (4, 0, 0)), 0), (quad((-2, 4, -2), (4, 0, 0), (0, 0, 4)), 0),
             (quad((-2, 0, -2), (4, 0, 0), (0, 4, 0)), 0), (quad((-2, 0, -2), (0, 4, 0), (0, 0, 4)), 0),
             (quad((2, 0, -2), (0, 0, 4), (0, 4, 0)), 0),
             (quad((-0.6, 3.9, -0.6), (1.2, 0, 0), (0, 0, 1.2)), 1), (ball(), 2)]
    materials = [gltf_material(grey), lamp, gltf_material(entry)]
    nodes = [{"mesh": i} for i in range(len(parts))]
    nodes[-1]["translation"] = [0.0, 1.4, 0.0]
    nodes[-1]["scale"] = [1.3, 1.3, 1.3]
    if entry.get("speck"):
        # Out of sight: all that it does is to call for materials.
        materials.append(gltf_material({"metallic": 1.0, "roughness": 0.5}))
        parts.append((quad((0, 0, 50), (0.1, 0, 0), (0, 0.1, 0)), 3))
        nodes.append({"mesh": len(parts) - 1})
    data, views, accessors, meshes = bytearray(), [], [], []

    def add(packed, count, kind, component, **bounds):
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        data.extend(packed)
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count,
                          "type": kind, **bounds})
        return len(accessors) - 1

    for (points, faces), material in parts:
        flat = [float(x) for point in points for x in point]
        low = [min(p[k] for p in points) for k in range(3)]
        high = [max(p[k] for p in points) for k in range(3)]
        at = add(struct.pack(f"<{len(flat)}f", *flat), len(points), "VEC3", 5126, min=low, max=high)
        attributes = {"POSITION": at}
        if len(points) > 4:
            attributes["NORMAL"] = at
        order = [i for face in faces for i in face]
        indices = add(struct.pack(f"<{len(order)}I", *order), len(order), "SCALAR", 5125)
        meshes.append({"primitives": [{"attributes": attributes, "indices": indices,
                                       "material": material}]})
    nodes.append({"camera": 0, "translation": [0.0, 1.9, 7.0]})
    used = sorted({name for m in materials for name in m["extensions"]})
    path.with_suffix(".bin").write_bytes(bytes(data))
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "extensionsUsed": used, "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
        "materials": materials, "accessors": accessors, "bufferViews": views,
        "buffers": [{"uri": path.with_suffix(".bin").name, "byteLength": len(data)}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.01}}],
    }), encoding="utf-8")


def measure(weft, scene, backend, size, spp, folder):
    """Milliseconds that the samples took, and rays per path of the camera."""
    stats = folder / "stats.json"
    subprocess.run([weft, "render", str(scene), "--algorithm", "path", "--backend", backend,
                    "--size", f"{size}x{size}", "--spp", str(spp), "--threads", "1", "--stats",
                    str(stats), "-o", str(folder / "image.exr")], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    found = json.loads(stats.read_text(encoding="utf-8"))
    frames = found["frames"]
    time = sum(frame["ms"] for frame in frames)
    return time, sum(frame["rays"] for frame in frames) / (size * size * spp)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--weft", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--backend", default="native")
    parser.add_argument("--size", type=int, default=192)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=pathlib.Path, help="writes the figures to this file")
    options = parser.parse_args()
    ratios = {name: [] for name in MATERIALS}
    rays = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, entry in enumerate(MATERIALS.values()):
            write_scene(folder / f"{number}.gltf", entry)
        for _ in range(options.rounds):
            first = None
            for number, material in enumerate(MATERIALS):
                time, rays[material] = measure(options.weft, folder / f"{number}.gltf",
                                               options.backend, options.size, options.spp, folder)
                first = first or time
                ratios[material].append(time / first)
    print(f"{'material of the ball':32} {'time':>6} {'rays':>6}")
    figures = {}
    for material, values in ratios.items():
        figures[material] = {"time": statistics.median(values), "rays": rays[material]}
        print(f"{material:32} {figures[material]['time']:6.2f} {rays[material]:6.2f}")
    if options.json:
        options.json.write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
