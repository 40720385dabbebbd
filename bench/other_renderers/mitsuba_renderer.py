#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Mitsuba 3: `path`, in scenes with media `volpath`. Variants: scalar_rgb, llvm_ad_rgb, the latter
with the LLVM library that DRJIT_LIBLLVM_PATH names."""

import equal_time
import exported_scene
import mitsuba_surfaces
from equal_time import Renderer, stopwatch
from expressible import NotExpressible

MOST_LANES = 1 << 22  # of one pass of a vectorised variant: its memory grows with them
UNLIMITED = -1
GAP = 2.0 ** -14  # of the scene's radius, between the sides of an area_light that shines both ways


def start(variant):
    import drjit
    import mitsuba
    mitsuba.set_variant(variant)
    drjit.eval(mitsuba.Float(0.0) + 1.0)  # fails here where there is no compiler
    return mitsuba, drjit


def probe(variant):
    return f"Mitsuba {start(variant)[0].__version__}, {variant}"


class Mitsuba(Renderer):
    def __init__(self, variant, scene, threads):
        import numpy
        self.mi, drjit = start(variant)
        self.numpy = numpy
        drjit.set_thread_count(threads)
        scene.refuse("media with density grids", "media that shine")
        self.vectorised = variant != "scalar_rgb"
        self.compiled = set()  # numbers of samples that there are kernels for
        integrator = "volpath" if scene.media else "path"
        self.name = f"Mitsuba {integrator}, {'llvm' if self.vectorised else 'scalar'}"
        self.version = f"{self.mi.__version__}, {variant}"
        self.notes = [f"{self.name}: integrator {integrator} with paths of any length and its own "
                      "Russian roulette, independent sampler, box filter"]
        self.size = scene.camera["size"]
        self.scene = self.mi.load_dict(self.description(scene, integrator))

    def passes(self, samples):
        """Samples of each pass. Kernels are compiled for a number of samples: powers of two make
        them few."""
        if not self.vectorised:
            return [samples]
        fitting = max(1, MOST_LANES // (self.size[0] * self.size[1]))
        largest = 1 << (fitting.bit_length() - 1)
        whole, rest = divmod(samples, largest)
        bits = reversed(range(rest.bit_length()))
        return [largest] * whole + [1 << bit for bit in bits if rest >> bit & 1]

    def render_pass(self, samples, seed):
        image = self.mi.render(self.scene, spp=samples, seed=seed)
        return samples * self.numpy.array(image)[..., :3]

    def render(self, samples, seed):
        passes = self.passes(samples)
        for part in set(passes) - self.compiled if self.vectorised else ():
            self.render_pass(part, 0)
            self.compiled.add(part)
        seconds = stopwatch()
        total = sum(self.render_pass(part, 1000 * seed + number)
                    for number, part in enumerate(passes))
        return total / samples, seconds()

    def description(self, scene, integrator):
        parts = {"type": "scene", "integrator": {"type": integrator, "max_depth": UNLIMITED},
                 "sensor": self.sensor(scene)}
        media = [self.medium(medium) for medium in scene.media]
        if scene.camera_medium is not None:
            parts["sensor"]["medium"] = media[scene.camera_medium]
        for number, mesh in enumerate(scene.meshes):
            parts[f"mesh{number}"] = self.surface(scene, mesh)
            if scene.emits(mesh.material) and scene.materials[mesh.material]["emits_both_sides"]:
                turned = mesh.turned(GAP * scene.radius)
                parts[f"mesh{number}behind"] = self.surface(scene, turned)
        for number, mesh in enumerate(scene.boundary_meshes):
            parts[f"boundary{number}"] = self.boundary(scene.boundaries[number], mesh, media)
        for number, light in enumerate(scene.lights):
            parts[f"light{number}"] = self.light(light)
        if scene.environment_image is not None:
            parts["environment"] = self.environment_map(scene.environment_texels())
        elif max(scene.environment) > 0.0:
            parts["environment"] = {"type": "constant", "radiance": self.rgb(scene.environment)}
        return parts

    def environment_map(self, texels):
        """Its images begin a quarter of their width further right."""
        turned = self.numpy.roll(texels, -(texels.shape[1] // 4), axis=1)
        return {"type": "envmap",
                "bitmap": self.mi.Bitmap(self.numpy.ascontiguousarray(turned, self.numpy.float32))}

    @staticmethod
    def rgb(values):
        return {"type": "rgb", "value": [float(value) for value in values]}

    def sensor(self, scene):
        camera = scene.camera
        numpy = self.numpy
        position = numpy.array(camera["position"])
        target = position - scene.radius * numpy.array(camera["backward"])
        look_at = self.mi.ScalarTransform4f().look_at(
            origin=position.tolist(), target=target.tolist(), up=camera["up"])
        return {"type": "perspective", "fov_axis": "y", "to_world": look_at,
                "fov": float(numpy.degrees(camera["vertical_fov"])),
                "near_clip": 1e-5 * scene.radius, "far_clip": 1e5 * scene.radius,
                "sampler": {"type": "independent"},
                "film": {"type": "hdrfilm", "width": self.size[0], "height": self.size[1],
                         "pixel_format": "rgb", "component_format": "float32",
                         "rfilter": {"type": "box"}, "sample_border": False}}

    def reflectance(self, scene, material, mesh):
        factor = self.numpy.array(material["reflectance"], dtype=self.numpy.float32)
        if material["texture"] is None:
            return {"type": "mesh_attribute", "name": "vertex_color"} \
                if mesh.colours is not None else self.rgb(factor)
        if mesh.colours is not None:
            raise NotExpressible("vertex colours on a texture")
        texture = scene.textures[material["texture"]]
        texels = (scene.linear_texels(material["texture"]) * factor).astype(self.numpy.float32)
        return {"type": "bitmap", "raw": True, "bitmap": self.mi.Bitmap(texels),
                "wrap_mode": texture["wrap_u"],
                "filter_type": "nearest" if texture["nearest"] else "bilinear"}

    def bsdf(self, scene, mesh):
        material = scene.materials[mesh.material]
        both = material["two_sided"] and not (scene.emits(mesh.material)
                                              and material["emits_both_sides"])
        if surface := scene.surface(mesh.material):
            return mitsuba_surfaces.bsdf(self.mi, surface, mesh, both)
        bsdf = {"type": "diffuse", "reflectance": self.reflectance(scene, material, mesh)}
        return {"type": "twosided", "bsdf": bsdf} if both else bsdf

    def surface(self, scene, mesh):
        material = scene.materials[mesh.material]
        properties = self.mi.Properties()
        properties["bsdf"] = self.mi.load_dict(self.bsdf(scene, mesh))
        if scene.emits(mesh.material):
            properties["emitter"] = self.mi.load_dict(
                {"type": "area", "radiance": self.rgb(material["radiance"])})
        colours = mesh.colours
        if colours is not None and not material.get("surface"):
            colours = colours * self.numpy.array(material["reflectance"], self.numpy.float32)
        return self.mesh(mesh, properties, colours)

    def mesh(self, mesh, properties, colours=None):
        made = self.mi.Mesh("mesh", vertex_count=len(mesh.positions),
                            face_count=len(mesh.triangles), props=properties,
                            has_vertex_normals=mesh.normals is not None,
                            has_vertex_texcoords=mesh.uvs is not None)
        if colours is not None:
            made.add_attribute("vertex_color", 3, colours.reshape(-1).tolist())
        parameters = self.mi.traverse(made)
        values = {"vertex_positions": mesh.positions, "vertex_normals": mesh.normals,
                  "vertex_texcoords": mesh.uvs}
        for key, array in values.items():
            if array is not None:
                parameters[key] = self.mi.Float(array.reshape(-1)) if self.vectorised else \
                    array.reshape(-1)
        faces = mesh.triangles.reshape(-1)
        parameters["faces"] = self.mi.UInt32(faces) if self.vectorised else faces
        parameters.update()
        return made

    def boundary(self, boundary, mesh, media):
        properties = self.mi.Properties()
        properties["bsdf"] = self.mi.load_dict({"type": "null"})
        for side in ("interior", "exterior"):
            if boundary[side] is not None:
                properties[side] = media[boundary[side]]
        return self.mesh(mesh, properties)

    def medium(self, medium):
        phase = {"type": "hg", "g": float(medium["anisotropy"])} if medium["anisotropy"] else \
            {"type": "isotropic"}
        # Colours end at 1, extinctions do not.
        largest = max(medium["extinction"])
        extinction = [value / largest for value in medium["extinction"]]
        return self.mi.load_dict({"type": "homogeneous", "albedo": self.rgb(medium["albedo"]),
                                  "sigma_t": self.rgb(extinction), "scale": largest,
                                  "phase": phase})

    def light(self, light):
        if light["type"] == "directional":
            return {"type": "directional", "direction": light["direction"],
                    "irradiance": self.rgb(light["intensity"])}
        if light["type"] == "point":
            return {"type": "point", "position": light["position"],
                    "intensity": self.rgb(light["intensity"])}
        # Its own fall-off is another one, and lies beyond the image's here.
        edge = float(self.numpy.degrees(exported_scene.spot_angle(light)))
        place, axis = self.numpy.array(light["position"]), self.numpy.array(light["direction"])
        across = self.numpy.eye(3)[abs(axis).argmin()]
        look_at = self.mi.ScalarTransform4f().look_at(
            origin=place.tolist(), target=(place + axis).tolist(), up=across.tolist())
        image = {"type": "bitmap", "raw": True, "wrap_mode": "clamp",
                   "bitmap": self.mi.Bitmap(exported_scene.spot_texels(light))}
        return {"type": "spot", "to_world": look_at, "intensity": self.rgb(light["intensity"]),
                "cutoff_angle": edge, "beam_width": 0.999 * edge, "texture": image}


if __name__ == "__main__":
    equal_time.main(probe, Mitsuba)
