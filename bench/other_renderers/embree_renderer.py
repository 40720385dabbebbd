#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Embree's tutorial program `pathtracer` (Debian: embree-tools).

It knows no surfaces that shine: area_lights are handed over as its quad lights, which rays from the
camera pass. It writes 8 bits a colour without a curve: lights are scaled so that little is clipped,
and the image is scaled back.
"""

import os
import pathlib
import shutil
import subprocess
import tempfile

import equal_time
from equal_time import Renderer, stopwatch
from expressible import NotExpressible

PROGRAM = "pathtracer"
MOST_LIGHTS = 256  # it samples all of them at every vertex
PATH_LENGTH = 64
BRIGHT = 0.9  # of the largest value in a file, where nearly all pixels should lie below
BRIGHT_PERCENTILE = 99.5
PATIENCE_SECONDS = 600.0
TINY = 16  # pixels along an edge of the image that tells what set-up costs


def probe(_):
    program = shutil.which(PROGRAM)
    if program is None:
        raise FileNotFoundError(f"no program {PROGRAM}, expected Debian's embree-tools")
    shown = subprocess.run([program, "--help"], capture_output=True, text=True, check=False,
                           timeout=30)
    if "--max-path-length" not in shown.stdout:
        raise ValueError(f"{program} is not Embree's path tracer")
    packages = subprocess.run(["dpkg-query", "-W", "-f=${Version}", "embree-tools"],
                              capture_output=True, text=True, check=False)
    return f"Embree's pathtracer {packages.stdout.strip()}".strip()


def parallelograms(mesh):
    """Pairs of triangles that make parallelograms, each as corner and two edges in the order of
    their outside. Raises where a triangle is left."""
    left = [corners.astype(float) for corners in mesh.positions[mesh.triangles]]
    found = []
    while left:
        first = left.pop()
        for number, second in enumerate(left):
            made = parallelogram(first, second)
            if made:
                found.append(made)
                left.pop(number)
                break
        else:
            raise NotExpressible("area lights that are no parallelograms")
    return found


def parallelogram(first, second):
    import numpy
    scale = numpy.abs(first).max() + numpy.ptp(first, axis=0).max()
    for turn in range(3):
        a, b, c = numpy.roll(first, -turn, axis=0)
        # The edge from b to c is the shared one; the other triangle's far corner faces a.
        fourth = b + c - a
        distance = numpy.linalg.norm(second - fourth, axis=1)
        if distance.min() < 1e-5 * scale:
            others = numpy.delete(second, distance.argmin(), axis=0)
            shared = {0, 1} == {int(numpy.linalg.norm(numpy.stack([b, c]) - other, axis=1).argmin())
                                for other in others}
            if shared:
                return a, b - a, c - a
    return None


class Embree(Renderer):
    name = "Embree pathtracer"

    def __init__(self, _, scene, threads):
        import numpy
        self.numpy = numpy
        self.version = probe("")
        if not any(scene.emits(mesh.material) for mesh in scene.meshes):
            raise NotExpressible("scenes without area lights")
        scene.refuse("media", "textures", "lights without area", "vertex colours",
                     "metals, plastics and glass")
        self.size = scene.camera["size"]
        self.exported = scene
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="weft-embree-"))
        self.arguments = ["--threads", threads, "--max-path-length", PATH_LENGTH,
                          "--righthanded", *self.camera_arguments(scene)]
        self.scale = 1.0 / max(max(material["radiance"]) for material in scene.materials)
        try:
            self.set_up()
        except BaseException:
            self.close()
            raise
        self.notes = [f"{self.name}: paths of up to {PATH_LENGTH} vertices, 8 bits a colour, lights "
                      "cannot be seen in its images; what an image of "
                      f"{TINY} x {TINY} pixels takes as a process, {self.overhead:.3f} s, counts "
                      "as set-up and is left out"]

    def set_up(self):
        self.write()
        for _ in range(3):
            self.expose()
        if self.run(*self.size, 1)[0].max() == 0.0:
            raise NotExpressible("area lights: this version has no light from quad lights")
        self.overhead = sorted(self.run(TINY, TINY, 1)[1] for _ in range(3))[1]

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def expose(self):
        """Scales the lights so that images use the range of a file."""
        values = self.run(*self.size, 1)[0]
        bright = self.numpy.percentile(values, BRIGHT_PERCENTILE)
        self.scale *= BRIGHT / bright if bright > 0.0 else 4.0
        self.write()

    def camera_arguments(self, scene):
        camera = scene.camera
        position = self.numpy.array(camera["position"])
        target = position - scene.radius * self.numpy.array(camera["backward"])
        fov = float(self.numpy.degrees(camera["vertical_fov"]))
        return ["--vp", *position, "--vi", *target, "--vu", *camera["up"], "--fov", fov]

    def write(self):
        lines = ['<?xml version="1.0"?>', "<scene>", "<Group>"]
        for number, mesh in enumerate(self.exported.meshes):
            if self.exported.emits(mesh.material):
                lines += self.area_light(mesh)
            else:
                lines += self.surface(mesh, number)
        if max(self.exported.environment) > 0.0:
            lines.append(f"<AmbientLight><L>{self.vector(self.exported.environment, self.scale)}"
                         "</L></AmbientLight>")
        (self.folder / "scene.xml").write_text("\n".join([*lines, "</Group>", "</scene>"]),
                                               encoding="ascii")

    @staticmethod
    def vector(values, scale=1.0):
        return " ".join(f"{scale * float(value):.9g}" for value in values)

    def rows(self, array):
        return "\n".join(self.vector(row) for row in array.tolist())

    def surface(self, mesh, number):
        material = self.exported.materials[mesh.material]
        if not material["two_sided"]:
            raise NotExpressible("surfaces with a black back")
        colour = self.vector(material["reflectance"])
        indices = "\n".join(" ".join(map(str, row)) for row in mesh.triangles.tolist())
        normals = [] if mesh.normals is None else [
            f"<normals>{self.rows(mesh.normals)}</normals>"]
        return ["<TriangleMesh>", f"<positions>{self.rows(mesh.positions)}</positions>", *normals,
                f"<triangles>{indices}</triangles>", f'<material id="material{number}">',
                '<code>"Matte"</code>', f'<parameters><float3 name="reflectance">{colour}</float3>',
                "</parameters></material>", "</TriangleMesh>"]

    def area_light(self, mesh):
        material = self.exported.materials[mesh.material]
        if material["emits_both_sides"]:
            raise NotExpressible("area lights that shine both ways")
        found = parallelograms(mesh)
        if len(found) > MOST_LIGHTS:
            raise NotExpressible(f"{len(found)} area lights, all of which it samples")
        lines = []
        for corner, along, across in found:
            normal = self.numpy.cross(along, across)
            columns = self.numpy.stack([along, across, normal, corner], axis=1)
            space = " ".join(f"{value:.9g}" for value in columns.reshape(-1))
            lines.append(f"<QuadLight><AffineSpace>{space}</AffineSpace>"
                         f"<L>{self.vector(material['radiance'], self.scale)}</L></QuadLight>")
        return lines

    def run(self, width, height, samples):
        """Values of the file, between 0 and 1, and seconds of the process."""
        output = self.folder / "image.ppm"
        output.unlink(missing_ok=True)
        command = [PROGRAM, "-i", self.folder / "scene.xml", *self.arguments, "--size", width,
                   height, "--spp", samples, "-o", output]
        environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
        seconds = stopwatch()
        done = subprocess.run([str(word) for word in command], capture_output=True, check=False,
                              timeout=PATIENCE_SECONDS, env=environment)
        taken = seconds()
        if not output.is_file():
            said = (done.stderr or done.stdout).decode(errors="replace").strip().splitlines()
            raise RuntimeError(f"{PROGRAM} wrote no image: {(said or ['no word'])[-1]}")
        return self.read_ppm(output), taken

    def read_ppm(self, file):
        data = file.read_bytes()
        fields, place = [], 0
        while len(fields) < 4:
            end = place
            while data[end:end + 1] not in b" \n\t\r":
                end += 1
            if end > place:
                fields.append(data[place:end])
            place = end + 1
        width, height = int(fields[1]), int(fields[2])
        values = self.numpy.frombuffer(data, self.numpy.uint8, 3 * width * height, place)
        return values.reshape(height, width, 3).astype(self.numpy.float32) / 255.0

    def render(self, samples, seed):
        values, seconds = self.run(*self.size, samples)
        return values / self.scale, max(seconds - self.overhead, 1e-6)


if __name__ == "__main__":
    equal_time.main(probe, Embree)
