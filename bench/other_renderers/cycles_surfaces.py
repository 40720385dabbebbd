# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""glTF's surfaces as nodes of Blender: its Principled BSDF, and for thin glass transparency and a
mirror, mixed by Fresnel's equations."""

import numpy as np

import surfaces
from expressible import NotExpressible

EXTENSIONS = {"repeat": "REPEAT", "clamp": "EXTEND", "mirror": "MIRROR"}


class Nodes:
    """A node tree of one material, under construction."""

    def __init__(self, bpy, tree, surface, mesh):
        self.bpy, self.tree, self.surface, self.mesh = bpy, tree, surface, mesh

    def add(self, kind, **inputs):
        made = self.tree.nodes.new(kind)
        for key, value in inputs.items():
            self.set(made.inputs[key.replace("_", " ")], value)
        return made

    def set(self, socket, value):
        """Links an output, or sets a constant; colours get an alpha of 1."""
        if isinstance(value, self.bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif isinstance(value, (list, tuple)):
            values = [float(one) for one in value]
            socket.default_value = (*values, 1.0) if socket.type == "RGBA" else values
        else:
            socket.default_value = float(value)

    def math(self, operation, first, second=0.0):
        made = self.tree.nodes.new("ShaderNodeMath")
        made.operation = operation
        self.set(made.inputs[0], first)
        self.set(made.inputs[1], second)
        return made.outputs[0]

    def mix(self, share, first, second):
        """A shader of which `share` is the second."""
        made = self.tree.nodes.new("ShaderNodeMixShader")
        self.set(made.inputs[0], share)
        self.tree.links.new(first, made.inputs[1])
        self.tree.links.new(second, made.inputs[2])
        return made.outputs[0]

    def image(self, parameter, texels):
        """The colour of a texture of linear texels, of one or three channels."""
        texture = self.surface.scene.textures[parameter["map"]["texture"]]
        height, width = texels.shape[:2]
        made = self.bpy.data.images.new("map", width, height, float_buffer=True, is_data=True)
        values = np.ones((height, width, 4), np.float32)
        values[..., :3] = texels[::-1]
        made.pixels.foreach_set(values.reshape(-1))
        made.update()
        node = self.tree.nodes.new("ShaderNodeTexImage")
        node.image = made
        node.interpolation = "Closest" if texture["nearest"] else "Linear"
        node.extension = EXTENSIONS[texture["wrap_u"]]
        return node.outputs["Color"]

    def value(self, parameter):
        texels = self.surface.texels(parameter)
        return parameter["factor"] if texels is None else self.image(parameter, texels)

    def base_colour(self):
        colour = self.value(self.surface["base_colour"])
        if self.mesh.colours is None:
            return colour
        vertices = self.tree.nodes.new("ShaderNodeVertexColor")
        vertices.layer_name = "colours"
        made = self.tree.nodes.new("ShaderNodeVectorMath")
        made.operation = "MULTIPLY"
        self.set(made.inputs[0], colour)
        self.set(made.inputs[1], vertices.outputs["Color"])
        return made.outputs[0]

    def backfacing(self):
        return self.tree.nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"]


def principled(nodes, transmission):
    surface = nodes.surface
    if not surface.is_metallic:
        return nodes.add("ShaderNodeBsdfDiffuse", Color=nodes.base_colour())
    coat, coat_roughness = surface.coat
    tint = [value * value for value in surface.crossing_tint()]  # it takes the root
    made = nodes.add("ShaderNodeBsdfPrincipled",
                     Base_Color=tint if transmission else nodes.base_colour(),
                     Metallic=0.0 if transmission else nodes.value(surface["metallic"]),
                     Roughness=nodes.value(surface["roughness"]), IOR=surface.ior,
                     Transmission_Weight=1.0 if transmission else 0.0,
                     Coat_Weight=coat, Coat_Roughness=coat_roughness, Coat_IOR=1.5)
    if not surface["specular"]["map"]:
        made.inputs["Specular IOR Level"].default_value = 0.5 * surface.factor("specular")
    strength, rotation = surface.anisotropy
    if strength > 0.0:
        rough, anisotropic = surfaces.disney_anisotropy(surface)
        made.inputs["Roughness"].default_value = rough
        made.inputs["Anisotropic"].default_value = anisotropic
        made.inputs["Anisotropic Rotation"].default_value = rotation / (2.0 * np.pi) % 1.0
        tangent = nodes.tree.nodes.new("ShaderNodeTangent")
        tangent.direction_type, tangent.uv_map = "UV_MAP", "uv"
        nodes.set(made.inputs["Tangent"], tangent.outputs["Tangent"])
    return made


def thin_glass(nodes):
    """A sheet: from both sides the same, with all reflections inside of it."""
    surface = nodes.surface
    if not surface.is_smooth:
        raise NotExpressible("rough thin glass")
    # From behind, the node takes the inverse of the index.
    index = nodes.math("POWER", surface.ior, nodes.math(
        "SUBTRACT", 1.0, nodes.math("MULTIPLY", 2.0, nodes.backfacing())))
    once = nodes.add("ShaderNodeFresnel", IOR=index).outputs[0]
    all_times = nodes.math("DIVIDE", nodes.math("MULTIPLY", 2.0, once),
                           nodes.math("ADD", 1.0, once))
    through = nodes.add("ShaderNodeBsdfTransparent", Color=surface.crossing_tint())
    mirror = nodes.add("ShaderNodeBsdfGlossy", Color=[1.0, 1.0, 1.0], Roughness=0.0)
    return nodes.mix(all_times, through.outputs[0], mirror.outputs[0])


def with_normals(nodes, shader):
    normals = nodes.surface.normal_texels()
    if normals is None:
        return
    made = nodes.add("ShaderNodeNormalMap",
                     Color=nodes.image(nodes.surface["normal_map"], normals))
    made.uv_map = "uv"
    nodes.set(shader.inputs["Normal"], made.outputs[0])


def with_gaps(nodes, shader):
    opacity = nodes.surface.opacity()
    if opacity is None:
        return shader
    if not isinstance(opacity, float):
        opacity = nodes.image(nodes.surface["opacity"]["alpha"], opacity)
    gap = nodes.add("ShaderNodeBsdfTransparent", Color=[1.0, 1.0, 1.0])
    return nodes.mix(opacity, gap.outputs[0], shader)


def shader(bpy, tree, surface, mesh, both_sides):
    """The output of the nodes that stand for a surface."""
    nodes = Nodes(bpy, tree, surface, mesh)
    share = surface.transmits
    made = None
    if not surfaces.is_all(share):
        node = principled(nodes, transmission=False)
        with_normals(nodes, node)
        made = node.outputs[0]
        if not both_sides and surfaces.is_none(share):
            black = nodes.add("ShaderNodeBsdfDiffuse", Color=[0.0, 0.0, 0.0])
            made = nodes.mix(nodes.backfacing(), made, black.outputs[0])
    if not surfaces.is_none(share):
        glass = principled(nodes, transmission=True).outputs[0] if surface["solid"] \
            else thin_glass(nodes)
        made = glass if made is None else nodes.mix(share, made, glass)
    return with_gaps(nodes, made)
