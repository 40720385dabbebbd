#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""LuxCore's path tracer PATHCPU, as the Python module pyluxcore."""

import os
import time

import equal_time
import exported_scene
import luxcore_surfaces
from equal_time import Renderer
from expressible import NotExpressible

DEPTH = 256  # of paths: it has no unlimited setting
POLL_SECONDS = 0.002
# By columns: its images turn about +z, and begin and end at +x.
SKY_TO_WORLD = [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


def start():
    # Its look for OpenCL devices, which PATHCPU does without, ends in a crash with some drivers.
    os.environ["OCL_ICD_VENDORS"] = os.devnull
    import pyluxcore
    return pyluxcore


def probe(_):
    pyluxcore = start()
    return f"LuxCore {pyluxcore.Version()}"


class LuxCore(Renderer):
    name = "LuxCore PATHCPU"

    def __init__(self, _, scene, threads):
        import numpy
        pyluxcore = start()
        self.lux, self.numpy = pyluxcore, numpy
        scene.refuse("media with density grids", "media that shine")
        pyluxcore.Init()
        self.version = pyluxcore.Version()
        self.size = scene.camera["size"]
        self.notes = [f"{self.name}: paths of up to {DEPTH} vertices, its own Russian roulette, no "
                      "clamping, Sobol sampler, box filter; it renders until the time is over"]
        made = pyluxcore.Scene()
        self.textures(made, scene)
        sky = scene.environment_texels()
        if sky is not None:
            made.DefineImageMap("sky", numpy.ascontiguousarray(sky, numpy.float32).reshape(-1),
                                1.0, 3, sky.shape[1], sky.shape[0])
        for number, light in enumerate(scene.lights):
            if light["type"] == "spot":
                texels = exported_scene.spot_texels(light)
                made.DefineImageMap(f"spot{number}", texels.reshape(-1), 1.0, 3,
                                    exported_scene.SPOT_EDGE, exported_scene.SPOT_EDGE)
        made.Parse(self.properties(self.media_settings(scene)))
        made.Parse(self.properties(self.scene_settings(scene)))
        for number, mesh in enumerate(scene.meshes):
            self.add_mesh(made, scene, mesh, f"mesh{number}")
        for number, mesh in enumerate(scene.boundary_meshes):
            self.add_boundary(made, scene.boundaries[number], mesh, f"boundary{number}")
        config = pyluxcore.RenderConfig(self.properties(self.engine_settings(threads)), made)
        self.session = pyluxcore.RenderSession(config)
        self.scene = made  # the session refers to it
        self.session.Start()
        self.session.Pause()

    def properties(self, settings):
        made = self.lux.Properties()
        for key, value in settings.items():
            made.Set(self.lux.Property(key, value))
        return made

    def engine_settings(self, threads):
        width, height = self.size
        return {"renderengine.type": "PATHCPU", "sampler.type": "SOBOL",
                "native.threads.count": threads, "film.width": width, "film.height": height,
                "film.filter.type": "BOX", "film.filter.width": 0.5,
                "path.pathdepth.total": DEPTH, "path.pathdepth.diffuse": DEPTH,
                "path.pathdepth.glossy": DEPTH, "path.pathdepth.specular": DEPTH,
                "path.clamping.variance.maxvalue": 0.0, "path.forceblackbackground.enable": False,
                "film.outputs.0.type": "RGB", "film.outputs.0.filename": "unused.exr",
                "film.noiseestimation.warmup": 0, "film.hw.enable": False,
                "film.imagepipelines.0.0.type": "NOP"}

    def scene_settings(self, scene):
        camera = scene.camera
        numpy = self.numpy
        position = numpy.array(camera["position"])
        target = position - scene.radius * numpy.array(camera["backward"])
        # It takes the field of view of the shorter edge.
        tangent = numpy.tan(camera["vertical_fov"] / 2.0) * min(1.0, self.size[0] / self.size[1])
        settings = {"scene.camera.type": "perspective",
                    "scene.camera.screenwindow": self.screen_window(),
                    "scene.camera.lookat.orig": position.tolist(),
                    "scene.camera.lookat.target": target.tolist(),
                    "scene.camera.up": camera["up"],
                    "scene.camera.fieldofview": float(numpy.degrees(2.0 * numpy.arctan(tangent))),
                    "scene.camera.autovolume.enable": False,
                    "scene.camera.cliphither": 1e-5 * scene.radius,
                    "scene.camera.clipyon": 1e5 * scene.radius}
        if scene.camera_medium is not None:
            settings["scene.camera.volume"] = f"medium{scene.camera_medium}"
        for number, light in enumerate(scene.lights):
            settings |= self.light_settings(light, number)
        if scene.environment_image is not None:
            settings |= {"scene.lights.sky.type": "infinite", "scene.lights.sky.file": "sky",
                         "scene.lights.sky.gamma": 1.0,
                         "scene.lights.sky.transformation": SKY_TO_WORLD}
        elif max(scene.environment) > 0.0:
            settings |= {"scene.lights.sky.type": "constantinfinite",
                         "scene.lights.sky.color": scene.environment}
        return settings

    def light_settings(self, light, number):
        key = f"scene.lights.light{number}"
        strength = [float(value) for value in light["intensity"]]
        settings = {f"{key}.gain": strength}
        if light["type"] == "directional":
            return settings | {f"{key}.type": "sharpdistant",
                               f"{key}.direction": light["direction"]}
        settings |= {f"{key}.power": 0.0, f"{key}.position": light["position"]}
        if light["type"] == "point":
            return settings | {f"{key}.type": "point"}
        # Its spot lights fall off differently: a projector shows what the light casts.
        target = self.numpy.array(light["position"]) + self.numpy.array(light["direction"])
        edge = float(self.numpy.degrees(exported_scene.spot_angle(light)))
        return settings | {f"{key}.type": "projection", f"{key}.target": target.tolist(),
                           f"{key}.fov": 2.0 * edge, f"{key}.mapfile": f"spot{number}",
                           f"{key}.gamma": 1.0}

    @staticmethod
    def media_settings(scene):
        settings = {}
        for number, medium in enumerate(scene.media):
            key = f"scene.volumes.medium{number}"
            scattered = [float(total * share) for total, share
                         in zip(medium["extinction"], medium["albedo"])]
            absorbed = [float(total - part) for total, part
                        in zip(medium["extinction"], scattered)]
            settings |= {f"{key}.type": "homogeneous", f"{key}.ior": 1.0,
                         f"{key}.scattering": scattered, f"{key}.absorption": absorbed,
                         f"{key}.asymmetry": [float(medium["anisotropy"])] * 3,
                         f"{key}.multiscattering": True}
        return settings

    def add_boundary(self, made, boundary, mesh, name):
        """A closed surface that is nothing but the bounds of a medium."""
        if boundary["interior"] is None or boundary["exterior"] is not None:
            raise NotExpressible("media within media")
        made.DefineMesh(name, self.rows(mesh.positions), self.rows(mesh.triangles), None, None,
                        None, None)
        made.Parse(self.properties({
            f"scene.materials.{name}.type": "null",
            f"scene.materials.{name}.volume.interior": f"medium{boundary['interior']}",
            f"scene.objects.{name}.shape": name, f"scene.objects.{name}.material": name}))

    def screen_window(self):
        """What the film covers. It is a pixel off in height, which is made up for here."""
        width, height = self.size
        shorter = min(width, height)
        across, along, pixel = width / shorter, height / shorter, 2.0 / shorter
        return [-across, across, -along - pixel, along - pixel]

    def textures(self, made, scene):
        for number, texture in enumerate(scene.textures):
            if texture["texels"] is None:
                continue
            values = scene.linear_texels(number).astype(self.numpy.float32)
            made.DefineImageMap(f"image{number}", values.reshape(-1), 1.0, 3, texture["width"],
                                texture["height"])

    def reflectance(self, scene, fields, mesh, name):
        """Properties of textures that make the colour, and what a material calls it."""
        colour = [float(value) for value in fields["reflectance"]]
        settings, current = {}, colour

        def multiply(other):
            nonlocal current
            key = f"{name}-{len(settings)}"
            settings.update({f"scene.textures.{key}.type": "scale",
                             f"scene.textures.{key}.texture1": current,
                             f"scene.textures.{key}.texture2": other})
            current = key

        if fields["texture"] is not None and mesh.uvs is not None:
            key = f"scene.textures.{name}-image"
            wrap = scene.textures[fields["texture"]]["wrap_u"]
            if wrap == "mirror":
                raise NotExpressible("mirrored textures")
            settings |= {f"{key}.type": "imagemap", f"{key}.file": f"image{fields['texture']}",
                         f"{key}.gamma": 1.0, f"{key}.wrap": wrap}
            multiply(f"{name}-image")
        if mesh.colours is not None:
            settings[f"scene.textures.{name}-vertices.type"] = "hitpointcolor"
            multiply(f"{name}-vertices")
        return settings, current

    def add_mesh(self, made, scene, mesh, name):
        fields, rows = scene.materials[mesh.material], self.rows
        made.DefineMesh(name, rows(mesh.positions), rows(mesh.triangles), rows(mesh.normals),
                        rows(mesh.uvs), rows(mesh.colours), None)
        if surface := scene.surface(mesh.material):
            self.add_surface(made, scene, surface, mesh, name)
            return
        settings, colour = self.reflectance(scene, fields, mesh, name)
        key = f"scene.materials.{name}"
        settings |= {f"{key}.type": "matte", f"{key}.kd": colour}
        if scene.emits(mesh.material):
            settings |= self.emission(f"{key}.emission", fields["radiance"])
        material = name
        if not fields["two_sided"] or fields["emits_both_sides"]:
            material = f"{name}-sides"
            settings |= self.back(fields, name, key, material, colour,
                                  scene.emits(mesh.material))
        settings |= {f"scene.objects.{name}.shape": name,
                     f"scene.objects.{name}.material": material}
        made.Parse(self.properties(settings))

    def add_surface(self, made, scene, surface, mesh, name):
        """A mesh, defined already, of a material beyond Lambert's law."""
        fields = scene.materials[mesh.material]
        settings = luxcore_surfaces.settings(made, surface, mesh, name, fields["two_sided"])
        if scene.emits(mesh.material):
            front = f"{name}-front" if f"scene.materials.{name}-front.type" in settings else name
            settings |= self.emission(f"scene.materials.{front}.emission", fields["radiance"])
        settings |= {f"scene.objects.{name}.shape": name, f"scene.objects.{name}.material": name}
        made.Parse(self.properties(settings))

    @staticmethod
    def rows(array):
        return None if array is None else [tuple(row) for row in array.tolist()]

    @staticmethod
    def emission(key, radiance):
        return {key: [float(value) for value in radiance], f"{key}.power": 0.0,
                f"{key}.gain": [1.0, 1.0, 1.0]}

    def back(self, fields, name, key, material, colour, emits):
        """A material whose back differs from its front."""
        back = f"scene.materials.{name}-back"
        sides = f"scene.materials.{material}"
        settings = {f"{back}.type": "matte",
                    f"{back}.kd": colour if fields["two_sided"] else [0.0, 0.0, 0.0],
                    f"{sides}.type": "twosided", f"{sides}.frontmaterial": name,
                    f"{sides}.backmaterial": f"{name}-back"}
        if emits and fields["emits_both_sides"]:
            settings |= self.emission(f"{back}.emission", fields["radiance"])
        return settings

    def render_for(self, budget):
        """Renders from nothing for that long: the image, the seconds and samples a pixel."""
        session = self.session
        session.BeginSceneEdit()  # ends the rendering threads, so that a new film begins
        session.EndSceneEdit()
        begin = time.perf_counter()
        if session.IsInPause():
            session.Resume()
        while time.perf_counter() - begin < budget:
            time.sleep(POLL_SECONDS)
        session.Pause()
        seconds = time.perf_counter() - begin
        session.WaitNewFrame()
        session.UpdateStats()
        width, height = self.size
        samples = session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat()
        values = self.numpy.zeros(3 * width * height, self.numpy.float32)
        session.GetFilm().GetOutputFloat(self.lux.FilmOutputType.RGB, values, 0, True)
        image = values.reshape(height, width, 3)[::-1].copy()
        return image, seconds, samples / (width * height)


if __name__ == "__main__":
    equal_time.main(probe, LuxCore)
