#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A run of bench other_renderers goes on where another one like it ended, finds the references that
are kept, and judges by the longest image: run as a program. The fall-off of spot lights needs numpy."""

import json
import math
import pathlib
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench" / "other_renderers"))

import equal_time  # noqa: E402
import other_renderers  # noqa: E402
import weft_runs  # noqa: E402

try:
    import numpy
    import exported_scene
except ImportError:
    numpy = None


class Resume(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "peers.json"
        self.report = {"benchmark": "peers", "size": 64, "budgets": [0.3], "settings": {},
                       "machine": {"threads": 0}, "versions": {"weft": "1"}, "scenes": []}

    def earlier(self, resume=True):
        args = types.SimpleNamespace(resume=resume, json=self.file)
        return other_renderers.earlier_scenes(args, self.report)

    def test_nothing_before(self):
        self.assertEqual(self.earlier(), [])

    def test_scenes_of_a_run_like_this_one(self):
        scenes = [{"scene": "box.gltf"}]
        self.file.write_text(json.dumps({**self.report, "scenes": scenes}), encoding="utf-8")
        self.assertEqual(self.earlier(), scenes)
        self.assertEqual(self.earlier(resume=False), [])

    def test_another_run_is_refused(self):
        for key, value in (("size", 128), ("budgets", [1.0]), ("versions", {}), ("machine", {}),
                           ("settings", {"check_s": 1.0}), ("benchmark", "path")):
            self.file.write_text(json.dumps({**self.report, key: value}), encoding="utf-8")
            with self.assertRaises(weft_runs.Failure) as caught:
                self.earlier()
            self.assertIn(f"another {key}", str(caught.exception))
        for text in ("{", "[]", '{"scenes": 1}'):
            self.file.write_text(text, encoding="utf-8")
            with self.assertRaises(weft_runs.Failure) as caught:
                self.earlier()
            self.assertEqual(caught.exception.code, other_renderers.EXIT_INPUT)


class KeptReference(unittest.TestCase):
    def found(self, *names, spp=512):
        with tempfile.TemporaryDirectory() as folder:
            for name in names:
                (pathlib.Path(folder) / name).touch()
            args = types.SimpleNamespace(references=pathlib.Path(folder), size=64,
                                         reference_spp=spp)
            kept = weft_runs.kept_reference(args, pathlib.Path("scenes/box.gltf"))
            return kept and kept.name

    def test_is_of_this_image_and_has_the_most_samples(self):
        this, other = "0123456789abcdef", "fedcba9876543210"
        known, weft_runs.image_identity = weft_runs.image_identity, lambda args, scene: this
        try:
            few, many, none, small, fog = (
                f"box.gltf-64x64-box-512-{this}.exr", f"box.gltf-64x64-box-1024-{this}.exr",
                f"box.gltf-64x64-box-4096-{other}.exr", f"box.gltf-32x32-box-2048-{this}.exr",
                f"box-fog.gltf-64x64-box-2048-{this}.exr")
            self.assertEqual(self.found(few, many, none, small, fog), many)
            self.assertEqual(self.found(few), few)
            self.assertIsNone(self.found(few, spp=513))
            self.assertIsNone(self.found(none, small, fog))
        finally:
            weft_runs.image_identity = known

    def test_its_name_stands_in_the_header_of_sums(self):
        text = b"weft.picture\0string\0\x10\0\0\0" + b"0123456789abcdef" + b"weft.samples\0"
        self.assertEqual(weft_runs.IDENTITY.search(b"\0\1" + text)[1], b"0123456789abcdef")


class Halves(unittest.TestCase):
    """References that are made are two halves and their mean, and errors are those of both."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.args = types.SimpleNamespace(
            references=self.folder, reference=None, size=64, reference_spp=513, weft="weft",
            threads=0, backend=None, environment=None, half_errors=["half_errors"])
        self.commands = []
        known = weft_runs.run, weft_runs.folder_digest
        self.addCleanup(lambda: setattr(weft_runs, "run", known[0]))
        self.addCleanup(lambda: setattr(weft_runs, "folder_digest", known[1]))
        weft_runs.run = self.run_program
        weft_runs.folder_digest = lambda folder: "digest"

    def run_program(self, command):
        words = [str(word) for word in command]
        self.commands.append(words)
        if words[1] == "compare":
            return json.dumps({"mean_ratio": 1.0, "hdrflip": {"mean": 0.1}, "relmse": 0.3})
        for option in ("-o", "--mean"):
            if option in words:
                pathlib.Path(words[words.index(option) + 1]).touch()
        return json.dumps([{"relmse": 0.25, "interval": 0.01}])

    def test_halves_have_seeds_of_their_own_and_are_kept(self):
        found = weft_runs.reference(self.args, pathlib.Path("box.gltf"), self.folder)
        self.assertEqual(len(found.halves), 2)
        rendered = [words for words in self.commands if words[1] == "render"]
        self.assertEqual({words[words.index("--spp") + 1] for words in rendered}, {"257"})
        self.assertEqual(len({words[words.index("--seed") + 1] for words in rendered}), 2)
        self.assertEqual(self.commands[-1][:3], ["half_errors", *map(str, found.halves[:2])])
        self.commands.clear()
        again = weft_runs.reference(self.args, pathlib.Path("box.gltf"), self.folder)
        self.assertEqual((again.file, again.halves, self.commands),
                         (found.file, found.halves, []))

    def test_errors_are_of_both_halves(self):
        against = weft_runs.Reference("mean.exr", ["a.exr", "b.exr"])
        found = weft_runs.compare(self.args, "image.exr", against, ["hdrflip", "relmse"])
        self.assertEqual(self.commands[-1], ["half_errors", "a.exr", "b.exr", "image.exr"])
        self.assertEqual((found["relmse"], found["relmse_unbiased"], found["relmse_interval"]),
                         (0.3, 0.25, 0.01))
        self.assertEqual(weft_runs.floor(self.args, against), 0.1)
        self.assertEqual(self.commands[-1][2:4], ["a.exr", "b.exr"])

    def test_a_single_reference_has_neither(self):
        found = weft_runs.compare(self.args, "image.exr", weft_runs.Reference("mean.exr"),
                                  ["hdrflip", "relmse"])
        self.assertIsNone(found["relmse_unbiased"])
        self.assertIsNone(weft_runs.floor(self.args, weft_runs.Reference("mean.exr")))


class MitsubaVariant(unittest.TestCase):
    def test_its_library_is_handed_to_the_program(self):
        args = types.SimpleNamespace(renderer_python={"mitsuba": "py"}, variant="",
                                     mitsuba={"variant": "llvm_ad_rgb", "library": ""})
        ran = []

        def json_lines(command, patience, environment=None):
            ran.append((command, environment))
            return [{"variant": "scalar_rgb", "library": "/lib/new.so", "version": "3", "llvm": "",
                     "failed": []}], None

        known, other_renderers.json_lines = other_renderers.json_lines, json_lines
        try:
            self.assertEqual(other_renderers.choose_mitsuba(args), ("Mitsuba 3, scalar_rgb", None))
            other_renderers.child(args, "mitsuba", patience=1.0)
        finally:
            other_renderers.json_lines = known
        self.assertEqual(ran[0][0][0], "py")
        self.assertEqual(ran[1][1]["DRJIT_LIBLLVM_PATH"], "/lib/new.so")
        self.assertIn("scalar_rgb", ran[1][0])


class Check(unittest.TestCase):
    def test_the_longest_image_tells_whether_a_renderer_shows_the_same(self):
        short = {"name": "Other", "budget_s": 0.3, "seconds": 0.3, "denoised": False,
                 "mean_ratio": 1.2, "hdrflip": 0.1}
        longer = {**short, "budget_s": 3.0, "check": True}
        other_renderers.judge([short, {**longer, "mean_ratio": 1.001}])
        self.assertTrue(short["comparable"])
        other_renderers.judge([short, {**longer, "mean_ratio": 1.2}])
        self.assertFalse(short["comparable"])

    def test_is_rendered_once(self):
        class Made(equal_time.Renderer):
            rendered = []

            def render(self, samples, seed):
                self.rendered.append(samples)
                return seed, 0.5 * samples  # slower than what was measured before

        renderer, costs = Made(), equal_time.Costs()
        costs.add(1, 0.1)
        self.assertEqual(tuple(equal_time.once(renderer, costs, 1.0, 7)), (7, 9, 4.5))
        self.assertEqual(renderer.rendered, [9])


@unittest.skipUnless(numpy, "needs numpy")
class SpotLight(unittest.TestCase):
    LIGHT = {"cos_inner": math.cos(0.3), "cos_outer": math.cos(0.5)}

    def test_falls_off_as_in_gltf(self):
        middle = 0.5 * (self.LIGHT["cos_inner"] + self.LIGHT["cos_outer"])
        cosines = numpy.array([1.0, self.LIGHT["cos_inner"], middle, self.LIGHT["cos_outer"], 0.0])
        falloff = exported_scene.spot_falloff(self.LIGHT, cosines)
        numpy.testing.assert_allclose(falloff, [1.0, 1.0, 0.25, 0.0, 0.0], atol=1e-12)

    def test_falls_off_linearly_with_the_angle(self):
        cosines = numpy.cos([0.0, 0.3, 0.4, 0.45, 0.5, 1.0])
        falloff = exported_scene.spot_falloff({**self.LIGHT, "linear_edge": True}, cosines)
        numpy.testing.assert_allclose(falloff, [1.0, 1.0, 0.5, 0.25, 0.0, 0.0], atol=1e-12)

    def test_what_it_casts_is_its_falloff(self):
        texels = exported_scene.spot_texels(self.LIGHT)
        edge = exported_scene.SPOT_EDGE
        self.assertEqual(texels.shape, (edge, edge, 3))
        # The texel at this angle, right of the axis and below it.
        for angle in (0.0, 0.2, 0.35, 0.4, 0.45, 0.505):
            place = math.tan(angle) / math.tan(exported_scene.spot_angle(self.LIGHT))
            column, row = min(edge - 1, int((0.5 + 0.5 * place) * edge)), edge // 2
            wanted = exported_scene.spot_falloff(self.LIGHT, math.cos(angle))
            # Half a texel is 0.001 in the angle's tangent, over which the fall-off changes by 0.01.
            self.assertAlmostEqual(float(texels[row, column, 0]), float(wanted), delta=0.02)
            self.assertAlmostEqual(float(texels[column, row, 1]), float(wanted), delta=0.02)

    def test_too_wide_for_an_image(self):
        with self.assertRaises(exported_scene.NotExpressible):
            exported_scene.spot_texels({"cos_inner": 0.5, "cos_outer": 0.0})


class OwnReferences(unittest.TestCase):
    """Other renderers are compared with images of their own where they have made one."""

    def test_images_are_compared_with_those_of_their_renderer(self):
        against = weft_runs.Reference("weft.exr")
        seen = []

        def compare(args, image, reference, errors):
            seen.append((image.name, reference.file.name))
            return {"mean_ratio": 1.05 if not errors else 1.0, "hdrflip": 0.1}

        known = other_renderers.compare
        self.addCleanup(lambda: setattr(other_renderers, "compare", known))
        other_renderers.compare = compare

        def image(name, picture, **fields):
            return {"name": name, "picture": picture, "budget_s": 1.0, "seconds": 1.0,
                    "samples": 4, "denoised": name.endswith("denoised"), **fields}

        images, notes = other_renderers.compared(
            None, [image("Weft path", "w.exr"), image("Other", "o.exr"),
                   image("Other, denoised", "d.exr"), image("Third", "t.exr"),
                   image("Other", "long.exr", reference=True)], pathlib.Path("."), against)
        self.assertEqual([one["picture"] for one in images], ["w.exr", "o.exr", "d.exr", "t.exr"])
        self.assertEqual(seen[1:], [("w.exr", "weft.exr"), ("o.exr", "long.exr"),
                                    ("d.exr", "long.exr"), ("t.exr", "weft.exr")])
        self.assertEqual(len(notes), 1)
        self.assertIn("1.050 of that of Weft's reference", notes[0])


if __name__ == "__main__":
    unittest.main()
