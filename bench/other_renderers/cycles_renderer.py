#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Cycles, the path tracer of Blender, as the Python module bpy. Variants: plain, denoised."""

import math
import os
import tempfile

import equal_time
import cycles_surfaces
import exported_scene
from equal_time import Renderer, stopwatch
from expressible import NotExpressible

BOUNCES = 1024  # the most that Cycles takes
TINY = 4  # pixels along an edge of the image that tells what set-up costs


def probe(_):
    import bpy
    return f"Cycles of Blender {bpy.app.version_string}"


class Cycles(Renderer):
    def __init__(self, variant, scene, threads):
        import bpy
        import numpy
        self.bpy, self.numpy = bpy, numpy
        scene.refuse("media with density grids", "media that shine")
        self.denoised = variant == "denoised"
        self.name = "Cycles, denoised" if self.denoised else "Cycles"
        self.version = bpy.app.version_string
        self.size = scene.camera["size"]
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        self.set_up(threads)
        self.materials = {}
        self.images = {}
        for number, mesh in enumerate(scene.meshes):
            self.add_mesh(scene, mesh, f"mesh{number}")
        for number, mesh in enumerate(scene.boundary_meshes):
            self.add_boundary(scene, scene.boundaries[number], mesh, f"boundary{number}")
        for light in scene.lights:
            self.add_light(light)
        self.add_world(scene.environment, scene.environment_texels())
        self.add_camera(scene.camera, scene.radius)
        self.overhead = self.measure_overhead()
        self.notes = [f"{self.name}: up to {BOUNCES} bounces, no clamping, no light sampling "
                      "threshold, no adaptive sampling, box filter; what an image of "
                      f"{TINY} x {TINY} pixels takes with everything in place, "
                      f"{self.overhead:.3f} s, counts as set-up and is left out"]
        if self.denoised:
            self.notes.append(f"{self.name}: Open Image Denoise with albedo and normal, the "
                              "quality as Blender has it by default; its time counts")

    def set_up(self, threads):
        settings = self.scene.render
        settings.engine = "CYCLES"
        settings.resolution_percentage = 100
        settings.use_persistent_data = True
        settings.threads_mode, settings.threads = "FIXED", threads
        settings.use_compositing = settings.use_sequencer = False
        image = settings.image_settings
        image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
        image.exr_codec = "NONE"
        cycles = self.scene.cycles
        cycles.device = "CPU"
        cycles.use_adaptive_sampling = False
        cycles.use_auto_tile = False
        cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
        cycles.light_sampling_threshold = 0.0
        cycles.max_bounces = cycles.diffuse_bounces = cycles.volume_bounces = BOUNCES
        cycles.glossy_bounces = cycles.transmission_bounces = BOUNCES
        cycles.blur_glossy = 0.0
        cycles.transparent_max_bounces = BOUNCES
        cycles.use_denoising = self.denoised
        if self.denoised:
            cycles.denoiser = "OPENIMAGEDENOISE"

    def measure_overhead(self):
        """Median time of tiny images: what each render spends besides rendering."""
        denoised, self.scene.cycles.use_denoising = self.denoised, False
        self.render_size(*self.size, 1, 1)
        times = sorted(self.render_size(TINY, TINY, 1, 1) for _ in range(3))
        self.scene.cycles.use_denoising = denoised
        return times[1]

    def render_size(self, width, height, samples, seed):
        settings = self.scene.render
        settings.resolution_x, settings.resolution_y = width, height
        self.scene.cycles.samples, self.scene.cycles.seed = samples, seed
        seconds = stopwatch()
        self.bpy.ops.render.render(write_still=False)
        return seconds()

    def render(self, samples, seed):
        seconds = self.render_size(*self.size, samples, seed) - self.overhead
        return self.rendered_image(), max(seconds, 1e-6)

    def rendered_image(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "picture.exr")
            self.bpy.data.images["Render Result"].save_render(file, scene=self.scene)
            image = self.bpy.data.images.load(file)
            image.colorspace_settings.is_data = True  # values as they are
            values = self.numpy.empty(4 * self.size[0] * self.size[1], self.numpy.float32)
            image.pixels.foreach_get(values)
            self.bpy.data.images.remove(image)
        return values.reshape(self.size[1], self.size[0], 4)[::-1, :, :3].copy()

    def add_mesh(self, scene, mesh, name):
        self.add_triangles(mesh, name, self.material(scene, mesh))

    def add_boundary(self, scene, boundary, mesh, name):
        """A closed surface that is nothing but the bounds of a medium."""
        if boundary["interior"] is None or boundary["exterior"] is not None:
            raise NotExpressible("media within media")
        medium = scene.media[boundary["interior"]]
        made = self.bpy.data.materials.new(name)
        made.use_nodes = True
        tree = made.node_tree
        tree.nodes.clear()
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        scattered = [total * share for total, share
                     in zip(medium["extinction"], medium["albedo"])]
        absorbed = [total - part for total, part in zip(medium["extinction"], scattered)]
        scatter = self.volume(tree, "ShaderNodeVolumeScatter", scattered, lambda part: part)
        scatter.inputs["Anisotropy"].default_value = medium["anisotropy"]
        # What it does not absorb is the colour of an absorbing medium.
        absorb = self.volume(tree, "ShaderNodeVolumeAbsorption", absorbed, lambda part: 1.0 - part)
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(scatter.outputs[0], both.inputs[0])
        tree.links.new(absorb.outputs[0], both.inputs[1])
        tree.links.new(both.outputs[0], output.inputs["Volume"])
        self.add_triangles(mesh, name, made)

    @staticmethod
    def volume(tree, kind, coefficients, colour):
        made = tree.nodes.new(kind)
        density = max(coefficients)
        made.inputs["Density"].default_value = density
        made.inputs["Color"].default_value = (
            *(colour(value / density if density > 0.0 else 1.0) for value in coefficients), 1.0)
        return made

    def add_triangles(self, mesh, name, material):
        data = self.bpy.data.meshes.new(name)
        corners = mesh.triangles.reshape(-1).astype(self.numpy.int32)
        data.vertices.add(len(mesh.positions))
        data.vertices.foreach_set("co", mesh.positions.reshape(-1))
        data.loops.add(len(corners))
        data.loops.foreach_set("vertex_index", corners)
        data.polygons.add(len(mesh.triangles))
        starts = self.numpy.arange(0, len(corners), 3, dtype=self.numpy.int32)
        data.polygons.foreach_set("loop_start", starts)
        data.update(calc_edges=True)
        smooth = mesh.normals is not None
        data.polygons.foreach_set("use_smooth", self.numpy.full(len(mesh.triangles), smooth))
        if smooth:
            data.normals_split_custom_set_from_vertices(mesh.normals)
        if mesh.uvs is not None:
            uvs = mesh.uvs * (1.0, -1.0) + (0.0, 1.0)  # v grows upwards here
            layer = data.uv_layers.new(name="uv")
            layer.data.foreach_set("uv", uvs[corners].astype(self.numpy.float32).reshape(-1))
        if mesh.colours is not None:
            colours = self.numpy.ones((len(corners), 4), self.numpy.float32)
            colours[:, :3] = mesh.colours[corners]
            layer = data.color_attributes.new("colours", "FLOAT_COLOR", "CORNER")
            layer.data.foreach_set("color", colours.reshape(-1))
        data.materials.append(material)
        self.scene.collection.objects.link(self.bpy.data.objects.new(name, data))

    def material(self, scene, mesh):
        key = (mesh.material, mesh.colours is not None)
        if key in self.materials:
            return self.materials[key]
        fields = scene.materials[mesh.material]
        made = self.bpy.data.materials.new(fields["name"] or "material")
        made.use_nodes = True
        tree = made.node_tree
        tree.nodes.clear()
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        front = self.front_factor(tree)
        if surface := scene.surface(mesh.material):
            shader = cycles_surfaces.shader(self.bpy, tree, surface, mesh, fields["two_sided"])
        else:
            shader = self.diffuse(scene, tree, fields, mesh, front)
        made.cycles.emission_sampling = "NONE"
        if scene.emits(mesh.material):
            both = fields["emits_both_sides"]
            made.cycles.emission_sampling = "FRONT_BACK" if both else "FRONT"
            emission = tree.nodes.new("ShaderNodeEmission")
            strength = max(fields["radiance"])
            hue = [value / strength for value in fields["radiance"]]
            emission.inputs["Color"].default_value = (*hue, 1.0)
            emission.inputs["Strength"].default_value = strength
            if not both:
                scaled = self.node(tree, "ShaderNodeMath", front, strength, operation="MULTIPLY")
                tree.links.new(scaled, emission.inputs["Strength"])
            both_shaders = tree.nodes.new("ShaderNodeAddShader")
            tree.links.new(shader, both_shaders.inputs[0])
            tree.links.new(emission.outputs[0], both_shaders.inputs[1])
            shader = both_shaders.outputs[0]
        tree.links.new(shader, output.inputs["Surface"])
        self.materials[key] = made
        return made

    def diffuse(self, scene, tree, fields, mesh, front):
        made = tree.nodes.new("ShaderNodeBsdfDiffuse")
        colour = self.colour(scene, tree, fields, mesh)
        if not fields["two_sided"]:
            colour = self.times(tree, colour, front)
        self.connect(tree, colour, made.inputs["Color"])
        return made.outputs[0]

    @staticmethod
    def connect(tree, value, socket):
        """Links an output, or sets a constant."""
        if isinstance(value, (tuple, float)):
            socket.default_value = value
        else:
            tree.links.new(value, socket)

    def node(self, tree, kind, first, second, operation):
        made = tree.nodes.new(kind)
        made.operation = operation
        self.connect(tree, first, made.inputs[0])
        self.connect(tree, second, made.inputs[1])
        return made.outputs[0]

    def times(self, tree, first, second):
        shorter = [value[:3] if isinstance(value, tuple) else value for value in (first, second)]
        return self.node(tree, "ShaderNodeVectorMath", *shorter, operation="MULTIPLY")

    def front_factor(self, tree):
        """1 on the outside of a surface, 0 on its back."""
        geometry = tree.nodes.new("ShaderNodeNewGeometry")
        return self.node(tree, "ShaderNodeMath", 1.0, geometry.outputs["Backfacing"],
                         operation="SUBTRACT")

    def colour(self, scene, tree, fields, mesh):
        colour = (*fields["reflectance"], 1.0)
        if fields["texture"] is not None and mesh.uvs is not None:
            node = tree.nodes.new("ShaderNodeTexImage")
            texture = scene.textures[fields["texture"]]
            node.image = self.image(scene, fields["texture"])
            node.interpolation = "Closest" if texture["nearest"] else "Linear"
            node.extension = {"repeat": "REPEAT", "clamp": "EXTEND", "mirror": "MIRROR"}[
                texture["wrap_u"]]
            colour = self.times(tree, node.outputs["Color"], colour)
        if mesh.colours is not None:
            node = tree.nodes.new("ShaderNodeVertexColor")
            node.layer_name = "colours"
            colour = self.times(tree, node.outputs["Color"], colour)
        return colour

    def image(self, scene, number):
        if number not in self.images:
            texels = scene.linear_texels(number)
            height, width, _ = texels.shape
            image = self.bpy.data.images.new(f"texture{number}", width, height, float_buffer=True,
                                             is_data=True)
            values = self.numpy.ones((height, width, 4), self.numpy.float32)
            values[..., :3] = texels[::-1]
            image.pixels.foreach_set(values.reshape(-1))
            image.update()
            self.images[number] = image
        return self.images[number]

    def add_light(self, light):
        kind = {"point": "POINT", "spot": "SPOT", "directional": "SUN"}[light["type"]]
        data = self.bpy.data.lights.new("light", kind)
        strength = max(light["intensity"])
        data.color = [value / strength for value in light["intensity"]]
        if kind == "SUN":
            data.angle = 0.0
            data.energy = strength
        else:
            data.shadow_soft_size = 0.0
            data.energy = 4.0 * math.pi * strength  # watts of a light that shines all around
        if kind == "SPOT":
            self.shape_spot(data, light)
        made = self.bpy.data.objects.new("light", data)
        from mathutils import Vector
        made.rotation_mode = "QUATERNION"
        made.rotation_quaternion = Vector(light["direction"]).to_track_quat("-Z", "Y")
        made.location = light["position"]
        self.scene.collection.objects.link(made)

    def shape_spot(self, data, light):
        """Gives a light the fall-off of the scene's; its own has another form, and lies beyond."""
        if light.get("linear_edge"):
            raise NotExpressible("spot lights that fall off linearly with the angle")
        data.spot_size = 2.0 * exported_scene.spot_angle(light)
        data.spot_blend = 0.0
        data.use_nodes = True
        tree = data.node_tree
        geometry = tree.nodes.new("ShaderNodeNewGeometry")
        along = tree.nodes.new("ShaderNodeVectorMath")
        along.operation = "DOT_PRODUCT"
        tree.links.new(geometry.outputs["Incoming"], along.inputs[0])
        along.inputs[1].default_value = light["direction"]
        ramp = tree.nodes.new("ShaderNodeMapRange")  # linear, and ends at 0 and 1
        tree.links.new(along.outputs["Value"], ramp.inputs["Value"])
        ramp.inputs["From Min"].default_value = light["cos_outer"]
        ramp.inputs["From Max"].default_value = light["cos_outer"] + exported_scene.spot_rim(light)
        squared = self.node(tree, "ShaderNodeMath", ramp.outputs["Result"], 2.0, operation="POWER")
        emission = next(node for node in tree.nodes if node.type == "EMISSION")
        tree.links.new(squared, emission.inputs["Strength"])

    def add_world(self, radiance, texels):
        world = self.bpy.data.worlds.new("world")
        self.scene.world = world
        world.use_nodes = True
        background = world.node_tree.nodes.get("Background")
        background.inputs["Color"].default_value = (*radiance, 1.0)
        background.inputs["Strength"].default_value = 1.0
        if texels is not None:
            self.add_environment_map(world.node_tree, background, texels)

    def add_environment_map(self, tree, background, texels):
        """Its directions are turned: (x, y, z) is (x, -z, y) to the node, whose axis is +z."""
        height, width, _ = texels.shape
        image = self.bpy.data.images.new("environment", width, height, float_buffer=True,
                                         is_data=True)
        values = self.numpy.ones((height, width, 4), self.numpy.float32)
        values[..., :3] = texels[::-1]
        image.pixels.foreach_set(values.reshape(-1))
        image.update()
        node = tree.nodes.new("ShaderNodeTexEnvironment")
        node.image = image
        parts = tree.nodes.new("ShaderNodeSeparateXYZ")
        turned = tree.nodes.new("ShaderNodeCombineXYZ")
        direction = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
        tree.links.new(direction, parts.inputs[0])
        opposite = self.node(tree, "ShaderNodeMath", parts.outputs["Z"], -1.0,
                             operation="MULTIPLY")
        tree.links.new(parts.outputs["X"], turned.inputs["X"])
        tree.links.new(opposite, turned.inputs["Y"])
        tree.links.new(parts.outputs["Y"], turned.inputs["Z"])
        tree.links.new(turned.outputs[0], node.inputs["Vector"])
        tree.links.new(node.outputs["Color"], background.inputs["Color"])

    def add_camera(self, camera, radius):
        from mathutils import Matrix
        data = self.bpy.data.cameras.new("camera")
        data.sensor_fit = "VERTICAL"
        data.angle = camera["vertical_fov"]
        data.clip_start, data.clip_end = 1e-5 * radius, 1e5 * radius
        made = self.bpy.data.objects.new("camera", data)
        columns = [camera["right"], camera["up"], camera["backward"], camera["position"]]
        made.matrix_world = Matrix([[column[row] for column in columns] for row in range(3)]
                                   + [[0.0, 0.0, 0.0, 1.0]])
        self.scene.collection.objects.link(made)
        self.scene.camera = made


if __name__ == "__main__":
    equal_time.main(probe, Cycles)
