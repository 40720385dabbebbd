# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Writes open scenes as glTF files: a terrain under a sun; things on the ground and a single model,
which get the default light."""

import array
import base64
import json
import math


class Gltf:
    """Gathers meshes into one file that holds its own data."""

    def __init__(self):
        self.data = bytearray()
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
                     "nodes": [], "meshes": [], "materials": [], "accessors": [],
                     "bufferViews": []}

    def material(self, *colour):
        self.json["materials"].append(
            {"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1], "metallicFactor": 0}})
        return len(self.json["materials"]) - 1

    def accessor(self, values, kind, component, width):
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": 4 * len(values)}
        self.data += array.array("f" if component == 5126 else "I", values).tobytes()
        self.json["bufferViews"].append(view)
        found = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component,
                 "count": len(values) // width, "type": kind}
        if kind == "VEC3":
            found["min"] = [min(values[c::3]) for c in range(3)]
            found["max"] = [max(values[c::3]) for c in range(3)]
        self.json["accessors"].append(found)
        return len(self.json["accessors"]) - 1

    def node(self, **node):
        self.json["nodes"].append(node)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def add(self, positions, triangles, material, normals=None, **placement):
        attributes = {"POSITION": self.accessor(positions, "VEC3", 5126, 3)}
        if normals:
            attributes["NORMAL"] = self.accessor(normals, "VEC3", 5126, 3)
        indices = self.accessor(triangles, "SCALAR", 5125, 1)
        self.json["meshes"].append({"primitives": [
            {"attributes": attributes, "indices": indices, "material": material}]})
        self.node(mesh=len(self.json["meshes"]) - 1, **placement)

    def camera(self, place, pitch, yaw=0.0, fov=0.7):
        """At a place, turned about x after y, degrees."""
        p, y = math.radians(pitch) / 2, math.radians(yaw) / 2
        turn = [math.sin(p) * math.cos(y), math.cos(p) * math.sin(y), -math.sin(p) * math.sin(y),
                math.cos(p) * math.cos(y)]
        self.json["cameras"] = [{"type": "perspective",
                                 "perspective": {"yfov": fov, "znear": 0.1}}]
        self.node(camera=0, translation=place, rotation=turn)

    def sun(self, irradiance, turn):
        self.json["extensionsUsed"] = ["KHR_lights_punctual"]
        self.json["extensions"] = {"KHR_lights_punctual": {"lights": [
            {"type": "directional", "intensity": irradiance}]}}
        self.node(extensions={"KHR_lights_punctual": {"light": 0}}, rotation=turn)

    def write(self, path):
        encoded = base64.b64encode(bytes(self.data)).decode()
        self.json["buffers"] = [{"byteLength": len(self.data),
                                 "uri": "data:application/octet-stream;base64," + encoded}]
        path.write_text(json.dumps(self.json))


def grid(cells, place):
    """Positions and triangles of a grid whose vertex (i, j) of 0 to 1 lies at place(i, j)."""
    positions, triangles = [], []
    for j in range(cells + 1):
        for i in range(cells + 1):
            positions += place(i / cells, j / cells)
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            triangles += [a, a + cells + 1, a + 1, a + 1, a + cells + 1, a + cells + 2]
    return positions, triangles


def height(x, z):
    """Hills in several sizes."""
    return (1.2 * math.sin(0.9 * x + 0.4) * math.cos(0.7 * z)
            + 0.5 * math.sin(2.3 * x - 1.1 * z) + 0.2 * math.cos(5.1 * x + 3.7 * z))


def sphere(cells):
    def place(u, v):
        angle, down = 2 * math.pi * u, math.pi * v
        return [math.sin(down) * math.cos(angle), math.cos(down), -math.sin(down) * math.sin(angle)]
    return grid(cells, place)


def cube():
    positions, triangles = [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(positions) // 3
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = [0, 0, 0]
                corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = side, a, b
                positions += corner
            order = (0, 1, 2, 0, 2, 3) if side > 0 else (0, 2, 1, 0, 3, 2)
            triangles += [first + k for k in order]
    return positions, triangles


def terrain(path):
    made = Gltf()
    positions, triangles = grid(120, lambda u, v: [
        20 * u - 10, height(20 * u - 10, 20 * v - 10), 20 * v - 10])
    made.add(positions, triangles, made.material(0.45, 0.5, 0.3))
    made.sun(3.0, [-0.35, 0.25, 0.1, 0.897])
    made.camera([0, 4.5, 11], -18)
    made.write(path)


def things(path):
    made = Gltf()
    made.add([-8, 0, 8, 8, 0, 8, 8, 0, -8, -8, 0, -8], [0, 1, 2, 0, 2, 3],
             made.material(0.7, 0.68, 0.6))
    red, white, blue = (made.material(*c) for c in ((0.8, 0.15, 0.1), (0.85, 0.85, 0.85),
                                                    (0.1, 0.25, 0.7)))
    positions, triangles = sphere(48)
    made.add(positions, triangles, white, positions, translation=[-1.3, 1, 0])
    for place, size, colour in (([1.2, 0.8, -0.4], [0.8, 0.8, 0.8], red),
                                ([0.2, 0.4, 1.2], [0.4, 0.4, 0.4], blue),
                                ([2.9, 1.4, -1.8], [0.5, 1.4, 0.5], white)):
        positions, triangles = cube()
        made.add(positions, triangles, colour, translation=place, scale=size,
                 rotation=[0, 0.3, 0, 0.954])
    made.camera([0.4, 2.4, 7], -14)
    made.write(path)


def model(path):
    """A knot of tube without a light or a camera."""
    made = Gltf()

    def middle(t):
        return [math.sin(t) + 2 * math.sin(2 * t), math.cos(t) - 2 * math.cos(2 * t),
                -math.sin(3 * t)]

    def place(u, v):
        t, turn = 2 * math.pi * u, 2 * math.pi * v
        here, ahead = middle(t), middle(t + 1e-3)
        along = unit([b - a for a, b in zip(here, ahead)])
        side = unit(cross(along, [0.1, 0.2, 1]))
        up = cross(side, along)
        return [h + 0.55 * (math.cos(turn) * s + math.sin(turn) * w)
                for h, s, w in zip(here, side, up)]
    positions, triangles = grid(160, place)
    made.add(positions, triangles, made.material(0.75, 0.55, 0.35))
    made.write(path)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


SCENES = {"terrain": terrain, "things": things, "model": model}
