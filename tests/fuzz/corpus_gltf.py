# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Seeds of the target gltf, which reads .gltf and .glb."""
import base64
import json
import struct

from corpus_images import jpeg, png

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
FORMATS = {BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I", FLOAT: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
CORNERS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]


class Builder:
    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": []}

    def view(self, data, **extra):
        self.binary += bytes(-len(self.binary) % 4)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **extra})
        self.binary += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, numbers, component, kind, **extra):
        data = struct.pack(f"<{len(numbers)}{FORMATS[component]}", *numbers)
        self.json["accessors"].append(
            {"bufferView": self.view(data), "componentType": component, "type": kind,
             "count": len(numbers) // WIDTHS[kind], **extra})
        return len(self.json["accessors"]) - 1

    def mesh(self, **primitive):
        """One node with one mesh; the positions of a square unless attributes are given."""
        if "attributes" not in primitive:
            primitive["attributes"] = {"POSITION": self.accessor(CORNERS, FLOAT, "VEC3")}
        if "indices" not in primitive and "mode" not in primitive:
            primitive["indices"] = self.accessor([0, 1, 2, 2, 1, 3], USHORT, "SCALAR")
        meshes = self.json.setdefault("meshes", [])
        meshes.append({"primitives": [primitive]})
        self.node(mesh=len(meshes) - 1)
        return primitive

    def node(self, **node):
        nodes = self.json.setdefault("nodes", [])
        nodes.append(node)
        roots = self.json.setdefault("scenes", [{"nodes": []}])[0]["nodes"]
        roots.append(len(nodes) - 1)
        return len(nodes) - 1

    def complete(self, uri=None):
        made = {key: value for key, value in self.json.items() if value != []}
        if self.binary:
            made["buffers"] = [{"byteLength": len(self.binary)}]
            if uri:
                made["buffers"][0]["uri"] = uri
        return made

    def gltf(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
        return json.dumps(self.complete(uri), separators=(",", ":"))

    def glb(self):
        def chunk(kind, data, fill):
            data += fill * (-len(data) % 4)
            return struct.pack("<I4s", len(data), kind) + data

        text = json.dumps(self.complete(), separators=(",", ":")).encode()
        body = chunk(b"JSON", text, b" ") + chunk(b"BIN\0", self.binary, b"\0")
        return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def attributes():
    b = Builder()
    b.mesh(attributes={
        "POSITION": b.accessor(CORNERS, FLOAT, "VEC3"),
        "NORMAL": b.accessor([0, 0, 1] * 4, FLOAT, "VEC3"),
        "TEXCOORD_0": b.accessor([0, 0, 1, 0, 0, 1, 1, 1], FLOAT, "VEC2"),
        "COLOR_0": b.accessor([255, 0, 0, 255] * 4, UBYTE, "VEC4", normalized=True),
    }, material=0)
    image = b.view(png(2, 2))
    b.json.update(
        materials=[{"name": "m", "doubleSided": True, "emissiveFactor": [1, 0.5, 0],
                    "pbrMetallicRoughness": {
                        "baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0,
                        "baseColorTexture": {"index": 0, "texCoord": 0, "extensions": {
                            "KHR_texture_transform": {"offset": [0.1, 0], "rotation": 1,
                                                      "scale": [2, 2]}}}},
                    "emissiveTexture": {"index": 0},
                    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 5}}}],
        textures=[{"source": 0, "sampler": 0}],
        samplers=[{"magFilter": 9728, "wrapS": 33071, "wrapT": 33648}],
        images=[{"bufferView": image, "mimeType": "image/png"}],
        extensionsUsed=["KHR_texture_transform", "KHR_materials_emissive_strength"])
    return b


def quantized():
    b = Builder()
    view = b.view(struct.pack("<12h", 0, 0, 0, 0, 9, 0, 0, 0, 0, 9, 0, 0), byteStride=8)
    b.json["accessors"].append({"bufferView": view, "componentType": SHORT, "type": "VEC3",
                                "count": 3, "normalized": True})
    b.mesh(attributes={"POSITION": 0,
                       "NORMAL": b.accessor([0, 0, 127] * 3, BYTE, "VEC3", normalized=True),
                       "COLOR_0": b.accessor([65535, 0, 0] * 3, USHORT, "VEC3",
                                             normalized=True)},
           indices=b.accessor([0, 1, 2], UBYTE, "SCALAR"))
    b.json["extensionsRequired"] = b.json["extensionsUsed"] = ["KHR_mesh_quantization"]
    return b


def sparse():
    b = Builder()
    indices = b.view(struct.pack("<2H", 1, 2))
    values = b.view(struct.pack("<6f", 1, 0, 0, 0, 1, 0))
    b.json["accessors"].append(
        {"componentType": FLOAT, "type": "VEC3", "count": 3,
         "sparse": {"count": 2, "indices": {"bufferView": indices, "componentType": USHORT},
                    "values": {"bufferView": values}}})
    b.mesh(attributes={"POSITION": 0}, mode=4)
    return b


def modes():
    b = Builder()
    b.mesh(mode=5)
    b.mesh(mode=6, indices=b.accessor([0, 1, 3, 2], UINT, "SCALAR"))
    b.mesh(mode=1)
    b.mesh(targets=[{"POSITION": 0}])
    return b


def nodes():
    b = Builder()
    b.mesh()
    b.json["nodes"][0].update(name="leaf", translation=[1, 2, 3], rotation=[0, 0, 0.6, 0.8],
                              scale=[1, -2, 1])
    b.json["nodes"] += [
        {"children": [0, 2], "matrix": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 5, 6, 7, 1]},
        {"camera": 0, "translation": [0, 0, 4], "name": "eye"},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"extensions": {"KHR_lights_punctual": {"light": 1}}, "mesh": 0},
        {"extensions": {"KHR_lights_punctual": {"light": 2}}, "camera": 1, "skin": 0}]
    b.json.update(
        scene=0, scenes=[{"nodes": [1, 3, 4, 5], "name": "s"}],
        cameras=[{"type": "perspective", "name": "c",
                  "perspective": {"yfov": 0.7, "aspectRatio": 1.5, "znear": 0.1, "zfar": 100}},
                 {"type": "orthographic",
                  "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}}],
        extensionsUsed=["KHR_lights_punctual", "EXT_other"],
        animations=[{"channels": [], "samplers": []}],
        extensions={"KHR_lights_punctual": {"lights": [
            {"type": "point", "color": [1, 0.5, 0.2], "intensity": 20, "range": 5},
            {"type": "spot", "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}},
            {"type": "directional", "intensity": 3, "name": "sun"}]}})
    return b


def animation():
    b = Builder()
    b.mesh()
    b.node(children=[2], translation=[0, 1, 0])
    b.json["nodes"].append({"camera": 0, "rotation": [0, 0.6, 0, 0.8]})
    b.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.7}}]
    times = b.accessor([0, 0.5, 2], FLOAT, "SCALAR")
    places = b.accessor([0, 0, 0, 1, 0, 0, 1, 1, 0], FLOAT, "VEC3")
    turns = b.accessor([0, 0, 0, 32767, 0, 23170, 0, 23170, 0, -32768, 0, 0], SHORT, "VEC4",
                       normalized=True)
    spline = b.accessor([0, 0, 0, 1, 1, 1, 0, 1, 0] * 3, FLOAT, "VEC3")
    turned = b.accessor([0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0] * 3, FLOAT, "VEC4")
    b.json["animations"] = [
        {"samplers": [{"input": times, "output": places},
                      {"input": times, "output": turns, "interpolation": "LINEAR"},
                      {"input": times, "output": spline, "interpolation": "CUBICSPLINE"}],
         "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}},
                      {"sampler": 1, "target": {"node": 1, "path": "rotation"}},
                      {"sampler": 2, "target": {"node": 2, "path": "scale"}},
                      {"sampler": 0, "target": {"node": 0, "path": "weights"}}]},
        {"samplers": [{"input": times, "output": turned, "interpolation": "CUBICSPLINE"},
                      {"input": times, "output": places, "interpolation": "STEP"}],
         "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}},
                      {"sampler": 1, "target": {"node": 0, "path": "translation"}},
                      {"sampler": 1, "target": {"node": 1, "path": "translation"}},
                      {"sampler": 1, "target": {"path": "translation"}}]}]
    return b


def skin():
    b = Builder()
    b.mesh(attributes={
        "POSITION": b.accessor(CORNERS, FLOAT, "VEC3"),
        "NORMAL": b.accessor([0, 0, 1] * 4, FLOAT, "VEC3"),
        "JOINTS_0": b.accessor([0, 1, 0, 0] * 4, UBYTE, "VEC4"),
        "WEIGHTS_0": b.accessor([0.5, 0.5, 0, 0, 1, 0, 0, 0, 0, 0.9, 0, 0, 0, 0, 0, 0], FLOAT,
                                "VEC4"),
        "JOINTS_1": b.accessor([1, 0, 0, 0] * 4, USHORT, "VEC4"),
        "WEIGHTS_1": b.accessor([255, 0, 0, 0] * 4, UBYTE, "VEC4", normalized=True)})
    b.json["nodes"][0].update(skin=0, name="mesh")
    b.node(children=[2], translation=[0, 1, 0])
    b.json["nodes"] += [{"children": [3]}, {"translation": [0, 0.5, 0]}]
    matrices = b.accessor([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] * 2, FLOAT, "MAT4")
    b.json["skins"] = [{"joints": [2, 3], "inverseBindMatrices": matrices, "skeleton": 2}]
    times = b.accessor([0, 1], FLOAT, "SCALAR")
    turns = b.accessor([0, 0, 0, 1, 0, 0, 0.6, 0.8], FLOAT, "VEC4")
    sizes = b.accessor([1, 1, 1, 2, -1, 1], FLOAT, "VEC3")
    b.json["animations"] = [
        {"samplers": [{"input": times, "output": turns}, {"input": times, "output": sizes}],
         "channels": [{"sampler": 0, "target": {"node": 3, "path": "rotation"}},
                      {"sampler": 1, "target": {"node": 1, "path": "scale"}}]}]
    return b


def morph():
    b = Builder()
    indices = b.view(struct.pack("<H", 2))
    values = b.view(struct.pack("<3b", 0, 0, 127))
    b.json["accessors"].append(
        {"componentType": BYTE, "normalized": True, "type": "VEC3", "count": 4,
         "sparse": {"count": 1, "indices": {"bufferView": indices, "componentType": USHORT},
                    "values": {"bufferView": values}}})
    moved = b.accessor([0, 0, 1] * 4, FLOAT, "VEC3")
    b.mesh(attributes={"POSITION": b.accessor(CORNERS, FLOAT, "VEC3"),
                       "NORMAL": b.accessor([0, 0, 1] * 4, FLOAT, "VEC3")},
           targets=[{"POSITION": 0, "NORMAL": moved}, {"POSITION": moved}])
    b.json["meshes"][0]["weights"] = [0.5, 0]
    b.node(mesh=0, weights=[-1, 2])
    b.node(mesh=0)
    times = b.accessor([0, 2], FLOAT, "SCALAR")
    weights = b.accessor([0, 1, 1, 0], FLOAT, "SCALAR")
    spline = b.accessor([0, 0, 0, 255, 0, 9] * 2, UBYTE, "SCALAR", normalized=True)
    b.json["animations"] = [
        {"samplers": [{"input": times, "output": weights, "interpolation": "STEP"},
                      {"input": times, "output": spline, "interpolation": "CUBICSPLINE"}],
         "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}},
                      {"sampler": 1, "target": {"node": 1, "path": "weights"}}]}]
    return b


def materials():
    b = Builder()
    names = ["unlit", "transmission", "volume", "clearcoat", "sheen", "specular", "ior",
             "pbrSpecularGlossiness"]
    b.json["materials"] = [
        {"alphaMode": "BLEND", "normalTexture": {"index": 0}, "occlusionTexture": {"index": 0},
         "extensions": {"KHR_materials_" + name: {} for name in names}},
        {"pbrMetallicRoughness": {"roughnessFactor": 0.5, "baseColorFactor": [2, -1, 0.5, 1],
                                  "baseColorTexture": {"index": 1}}}]
    b.mesh(material=0)
    b.mesh(material=1)
    image = "data:image/jpeg;base64," + base64.b64encode(jpeg(8, 8, 1)).decode()
    b.json.update(images=[{"uri": "pixel.tga"}, {"uri": image}],
                  textures=[{"source": 0}, {"source": 1}, {"name": "none"}])
    return b


def surfaces():
    """Every field of every kind of surface."""
    b = Builder()

    def info(index, coordinates=0, **more):
        return {"index": index, "texCoord": coordinates, **more}

    moved = info(0, 1, extensions={"KHR_texture_transform": {
        "offset": [0.1, 0.2], "rotation": 1, "scale": [2, 3], "texCoord": 0}})
    plain = {"baseColorFactor": [0.5, 0.6, 0.7, 0.8], "baseColorTexture": info(0),
             "metallicFactor": 0.5, "roughnessFactor": 0.25, "metallicRoughnessTexture": info(0, 1)}
    glass = {
        "KHR_materials_ior": {"ior": 1.33},
        "KHR_materials_specular": {
            "specularFactor": 0.5, "specularTexture": info(0),
            "specularColorFactor": [1, 2, 0.5], "specularColorTexture": moved},
        "KHR_materials_transmission": {
            "transmissionFactor": 0.75, "transmissionTexture": info(0)},
        "KHR_materials_volume": {"thicknessFactor": 0.1, "thicknessTexture": info(0),
                                 "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0]},
        "KHR_materials_clearcoat": {
            "clearcoatFactor": 1, "clearcoatTexture": info(0), "clearcoatRoughnessFactor": 0.5,
            "clearcoatRoughnessTexture": info(0), "clearcoatNormalTexture": info(0, scale=2)},
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1,
                                     "anisotropyTexture": info(0)}}
    glossy = {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [1, 1, 1, 0.5], "diffuseTexture": info(0),
        "specularFactor": [0.2, 0.3, 0.4], "glossinessFactor": 0.5,
        "specularGlossinessTexture": info(0)}}
    b.json["materials"] = [
        {"pbrMetallicRoughness": plain, "normalTexture": info(0, scale=0.5), "extensions": glass,
         "alphaMode": "MASK", "alphaCutoff": 0.25},
        {"extensions": glossy, "alphaMode": "BLEND"},
        {"extensions": {"KHR_materials_unlit": {}}},
        {"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                        "KHR_materials_volume": {"thicknessFactor": 1}}}]
    for material in range(3):
        b.mesh(attributes={"POSITION": b.accessor(CORNERS, FLOAT, "VEC3"),
                           "TEXCOORD_0": b.accessor([0, 0, 1, 0, 0, 1, 1, 1], FLOAT, "VEC2"),
                           "TEXCOORD_1": b.accessor([1, 1, 0, 1, 1, 0, 0, 0], FLOAT, "VEC2"),
                           "COLOR_0": b.accessor([255, 0, 0, 128] * 4, UBYTE, "VEC4",
                                                 normalized=True)}, material=material)
    # A closed mesh: solid glass.
    b.mesh(attributes={"POSITION": b.accessor([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], FLOAT, "VEC3")},
           indices=b.accessor([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3], USHORT, "SCALAR"), material=3)
    b.json.update(images=[{"uri": "pixel.tga"}], textures=[{"source": 0}])
    return b


def image_light():
    """A cube of light from all around."""
    b = Builder()
    b.mesh()
    b.json["images"] = [{"bufferView": b.view(png(2, 2, 6)), "mimeType": "image/png"}]
    b.json["extensions"] = {"EXT_lights_image_based": {"lights": [
        {"name": "sky", "intensity": 2, "rotation": [0, 1, 0, 1], "specularImageSize": 2,
         "specularImages": [[0, 0, 0, 0, 0, 0]], "irradianceCoefficients": [[1, 1, 1]] * 9}]}}
    b.json["scenes"][0]["extensions"] = {"EXT_lights_image_based": {"light": 0}}
    return b


def media():
    b = Builder()
    b.json["materials"] = [{"extensions": {
        "WEFT_medium": {"scattering": [1, 2, 3], "absorption": [0, 0, 1], "anisotropy": 0.5,
                        "emission": [1, 0.5, 0],
                        "density": {"uri": "smoke.vol", "grid": "density",
                                    "box": [0, 0, 0, 1, 1, 1]}},
        "KHR_materials_volume": {"attenuationDistance": 2}}}]
    b.mesh(material=0)
    b.json["scenes"][0]["extensions"] = {"WEFT_medium": {"density": {
        "uri": "smoke.vol", "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 1, 1, 1]}}}
    return b


def outside():
    b = Builder()
    b.json.update(buffers=[{"uri": "data.bin", "byteLength": 36}],
                  bufferViews=[{"buffer": 0, "byteLength": 36}],
                  accessors=[{"bufferView": 0, "componentType": FLOAT, "type": "VEC3",
                              "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}])
    b.mesh(attributes={"POSITION": 0}, mode=4)
    return b


def files():
    ring = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
            "nodes": [{"children": [1]}, {"children": [2]}, {"children": [1]}]}
    made = {"attributes": attributes(), "quantized": quantized(), "sparse": sparse(),
            "modes": modes(), "nodes": nodes(), "animation": animation(),
            "skin": skin(), "morph": morph(),
            "materials": materials(), "surfaces": surfaces(), "media": media(),
            "image_light": image_light(),
            "outside": outside()}
    out = {name + ".gltf": builder.gltf() for name, builder in made.items()}
    binary = ("attributes", "sparse", "nodes", "animation", "skin", "morph", "surfaces")
    out.update({name + ".glb": made[name].glb() for name in binary})
    out["outside.gltf"] = json.dumps(made["outside"].json)
    out["badring.gltf"] = json.dumps(ring, indent=1)
    out["badversion.gltf"] = '{"asset": {"version": "1.0"}}'
    return out
