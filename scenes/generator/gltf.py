# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Writes glTF 2.0: a readable .gltf, its binary buffer beside it or inside as a data URI."""

import base64
import json
import math
import re
import struct

ARRAY_BUFFER, ELEMENT_BUFFER = 34962, 34963
UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5121, 5123, 5125, 5126


def quaternion_towards(eye, target):
    """The rotation that turns a glTF camera or light (-z, +y up) from `eye` to `target`."""
    def unit(v):
        length = math.sqrt(math.fsum(c * c for c in v))
        return [c / length for c in v]
    z = unit([e - t for e, t in zip(eye, target)])
    x = unit([z[2], 0.0, -z[0]])
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    w = 0.5 * math.sqrt(max(1.0 + x[0] + y[1] + z[2], 0.0))
    if w < 1e-9:
        return [0.0, 1.0, 0.0, 0.0]
    q = [(y[2] - z[1]) / (4 * w), (z[0] - x[2]) / (4 * w), (x[1] - y[0]) / (4 * w), w]
    return [round(c, 9) for c in q]


class Document:
    """A glTF scene under construction. Every `add_*` returns the index of what it added."""

    def __init__(self, name, notice):
        self.json = {
            "asset": {"version": "2.0", "generator": "Weft make_scenes.py", "copyright": notice},
            "scene": 0,
            "scenes": [{"name": name, "nodes": []}],
        }
        self.binary = bytearray()
        self._extensions = set()

    def _add(self, kind, item):
        self.json.setdefault(kind, []).append(item)
        return len(self.json[kind]) - 1

    def _accessor(self, data, target, component, kind, count, extra):
        self.binary += bytes(-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        view = self._add("bufferViews", view)
        self.binary += data
        return self._add("accessors", {"bufferView": view, "componentType": component,
                                       "count": count, "type": kind, **extra})

    def _floats(self, rows, kind, bounds=False, target=ARRAY_BUFFER):
        flat = [c for row in rows for c in row]
        data = struct.pack(f"<{len(flat)}f", *flat)
        extra = {}
        if bounds:
            stored = list(struct.iter_unpack(f"<{len(rows[0])}f", data))
            extra = {"min": [min(column) for column in zip(*stored)],
                     "max": [max(column) for column in zip(*stored)]}
        return self._accessor(data, target, FLOAT, kind, len(rows), extra)

    def _bytes(self, rows, extra):
        data = bytes(c for row in rows for c in row)
        return self._accessor(data, ARRAY_BUFFER, UNSIGNED_BYTE, "VEC4", len(rows), extra)

    def _indices(self, triangles, vertices):
        flat = [i for triangle in triangles for i in triangle]
        wide = vertices > 65535
        data = struct.pack(f"<{len(flat)}{'I' if wide else 'H'}", *flat)
        component = UNSIGNED_INT if wide else UNSIGNED_SHORT
        return self._accessor(data, ELEMENT_BUFFER, component, "SCALAR", len(flat), {})

    def primitive(self, mesh, material):
        """The JSON of one primitive; its data goes into the buffer. Normals are optional."""
        attributes = {"POSITION": self._floats(mesh.positions, "VEC3", bounds=True)}
        if mesh.normals:
            attributes["NORMAL"] = self._floats(mesh.normals, "VEC3")
        if mesh.tangents:
            attributes["TANGENT"] = self._floats(mesh.tangents, "VEC4")
        if mesh.uvs:
            attributes["TEXCOORD_0"] = self._floats(mesh.uvs, "VEC2")
        if mesh.colours:
            data = bytes(round(255 * c) for rgb in mesh.colours for c in (*rgb, 1.0))
            attributes["COLOR_0"] = self._accessor(data, ARRAY_BUFFER, UNSIGNED_BYTE, "VEC4",
                                                   len(mesh.colours), {"normalized": True})
        return {"attributes": attributes, "material": material,
                "indices": self._indices(mesh.triangles, len(mesh.positions))}

    def carry(self, primitive, influences):
        """Lets joints carry a primitive: for each vertex up to four (joint of the skin, weight)."""
        joints, weights = [], []
        for listed in influences:
            listed = [*listed, *[(0, 0.0)] * (4 - len(listed))]
            bits = [round(255 * weight) for _, weight in listed]
            bits[bits.index(max(bits))] += 255 - sum(bits)
            joints.append([joint if b else 0 for (joint, _), b in zip(listed, bits)])
            weights.append(bits)
        primitive["attributes"]["JOINTS_0"] = self._bytes(joints, {})
        primitive["attributes"]["WEIGHTS_0"] = self._bytes(weights, {"normalized": True})

    def morph(self, primitive, positions, normals):
        """Adds a morph target: what it adds to each position and normal."""
        primitive.setdefault("targets", []).append({
            "POSITION": self._floats(positions, "VEC3", bounds=True),
            "NORMAL": self._floats(normals, "VEC3")})

    def add_mesh(self, name, primitives):
        return self._add("meshes", {"name": name, "primitives": primitives})

    def add_skin(self, name, joints, places):
        """A skin of nodes; `places` says where each is, unturned, where it binds vertices."""
        matrices = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -p[0], -p[1], -p[2], 1) for p in places]
        return self._add("skins", {"name": name, "joints": list(joints), "inverseBindMatrices":
                                   self._floats(matrices, "MAT4", target=None)})

    def add_animation(self, name, channels):
        """`channels` lists (node, path, times, values, interpolation); one value is a tuple, and
        of weights all those of a key follow each other."""
        animation = {"name": name, "channels": [], "samplers": []}
        inputs = {}
        for node, path, times, values, interpolation in channels:
            if times not in inputs:
                inputs[times] = self._floats([(t,) for t in times], "SCALAR", True, None)
            kind = {"rotation": "VEC4", "weights": "SCALAR"}.get(path, "VEC3")
            animation["channels"].append({"sampler": len(animation["samplers"]),
                                          "target": {"node": node, "path": path}})
            animation["samplers"].append({
                "input": inputs[times], "output": self._floats(values, kind, target=None),
                "interpolation": interpolation})
        return self._add("animations", animation)

    def add_material(self, name, albedo, texture=None, double_sided=False, radiance=None):
        """A Lambertian material; `radiance` (W/(m^2 sr), linear Rec.709) makes it a light. Without
        the extension that switches the specular reflection off, glTF's dielectrics have one."""
        surface = {"baseColorFactor": [*(round(c, 6) for c in albedo), 1],
                   "metallicFactor": 0, "roughnessFactor": 1}
        if texture is not None:
            surface["baseColorTexture"] = {"index": texture}
        self._extensions.add("KHR_materials_specular")
        material = {"name": name, "pbrMetallicRoughness": surface,
                    "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}
        if double_sided:
            material["doubleSided"] = True
        if radiance:
            peak = max(radiance)
            self._extensions.add("KHR_materials_emissive_strength")
            material["emissiveFactor"] = [round(c / peak, 6) for c in radiance]
            material["extensions"]["KHR_materials_emissive_strength"] = {
                "emissiveStrength": round(peak, 6)}
        return self._add("materials", material)

    def add_surface(self, name, colour, metallic=0.0, roughness=0.5, texture=None,
                    **extensions):
        """A metallic-roughness material. `extensions` gives the properties of KHR_materials_* by
        what follows that in their names: `ior={"ior": 1.33}`."""
        surface = {"baseColorFactor": [*(round(c, 6) for c in colour), 1],
                   "metallicFactor": metallic, "roughnessFactor": roughness}
        if texture is not None:
            surface["baseColorTexture"] = {"index": texture}
        material = {"name": name, "pbrMetallicRoughness": surface}
        for extension, properties in sorted(extensions.items()):
            self._extensions.add("KHR_materials_" + extension)
            material.setdefault("extensions", {})["KHR_materials_" + extension] = properties
        return self._add("materials", material)

    def _medium(self, scattering, absorption, anisotropy, density):
        """The JSON of WEFT_medium: coefficients per metre, the mean cosine g, a density grid."""
        self._extensions.add("WEFT_medium")
        medium = {"scattering": list(scattering), "absorption": list(absorption),
                  "anisotropy": anisotropy}
        if density:
            medium["density"] = density
        return {"WEFT_medium": medium}

    def add_medium(self, name, scattering, absorption, anisotropy=0.0, density=None):
        """A material that makes what it is on the invisible boundary of a medium."""
        return self._add("materials", {"name": name, "extensions": self._medium(
            scattering, absorption, anisotropy, density)})

    def set_outer_medium(self, scattering, absorption, anisotropy=0.0, density=None):
        """The medium outside of all boundaries; with a density grid, it ends where that ends."""
        self.json["scenes"][0]["extensions"] = self._medium(scattering, absorption, anisotropy,
                                                            density)

    def add_texture(self, name, uri, wrap):
        image = self._add("images", {"name": name, "uri": uri})
        sampler = self._add("samplers", {"magFilter": 9729, "minFilter": 9987,
                                         "wrapS": wrap, "wrapT": wrap})
        return self._add("textures", {"name": name, "source": image, "sampler": sampler})

    def add_image(self, name, png):
        """An image within the buffer."""
        self.binary += bytes(-len(self.binary) % 4)
        view = self._add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary),
                                         "byteLength": len(png)})
        self.binary += png
        return self._add("images", {"name": name, "bufferView": view, "mimeType": "image/png"})

    def set_image_light(self, name, size, faces, irradiance):
        """The light from all around: PNG images in RGBD of a cube's faces +x, -x, +y, -y, +z, -z,
        and nine spherical harmonics of the irradiance."""
        self._extensions.add("EXT_lights_image_based")
        images = [self.add_image(f"{name} {axis}", face)
                  for axis, face in zip(("+x", "-x", "+y", "-y", "+z", "-z"), faces)]
        self.json.setdefault("extensions", {})["EXT_lights_image_based"] = {"lights": [{
            "name": name, "irradianceCoefficients": irradiance, "specularImageSize": size,
            "specularImages": [images]}]}
        self.json["scenes"][0].setdefault("extensions", {})["EXT_lights_image_based"] = {
            "light": 0}

    def add_node(self, name, **fields):
        node = self._add("nodes", {"name": name, **fields})
        self.json["scenes"][0]["nodes"].append(node)
        return node

    def add_child(self, name, parent, **fields):
        node = self._add("nodes", {"name": name, **fields})
        self.json["nodes"][parent].setdefault("children", []).append(node)
        return node

    def add_camera(self, name, eye, target, yfov):
        camera = self._add("cameras", {"name": name, "type": "perspective", "perspective": {
            "yfov": round(yfov, 9), "znear": 0.01}})
        return self.add_node(name, camera=camera, translation=list(eye),
                             rotation=quaternion_towards(eye, target))

    def add_spot(self, name, eye, target, colour, intensity, inner, outer):
        """A spot light; `intensity` in W/sr, cone half-angles in radians."""
        self._extensions.add("KHR_lights_punctual")
        lights = self.json.setdefault("extensions", {}).setdefault(
            "KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"name": name, "type": "spot", "color": list(colour), "intensity": intensity,
                       "spot": {"innerConeAngle": inner, "outerConeAngle": outer}})
        reference = {"KHR_lights_punctual": {"light": len(lights) - 1}}
        return self.add_node(name, translation=list(eye), extensions=reference,
                             rotation=quaternion_towards(eye, target))

    def finish(self, bin_name=None):
        """The file's text and buffer; without `bin_name` the buffer becomes a data URI."""
        uri = bin_name or ("data:application/octet-stream;base64,"
                           + base64.b64encode(bytes(self.binary)).decode("ascii"))
        self.json["buffers"] = [{"byteLength": len(self.binary), "uri": uri}]
        if self._extensions:
            self.json["extensionsUsed"] = sorted(self._extensions)
        text = json.dumps(self.json, indent=2)
        # Short lists of numbers read better on one line.
        text = re.sub(r"\[([^][{}\"]*)\]", lambda m: "[" + " ".join(m.group(1).split()) + "]", text)
        return text + "\n", bytes(self.binary)
