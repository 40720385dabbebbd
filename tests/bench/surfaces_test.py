#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What other renderers are told of glTF's surfaces and of images of the environment: run as a
program. Needs numpy."""

import math
import pathlib
import sys
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench" / "other_renderers"))

try:
    import numpy
    import expressible
    import surfaces
except ImportError:
    numpy = None


def parameter(factor, texture=None, channel="rgb"):
    return {"factor": factor, "map": texture if texture is None
            else {"texture": texture, "channel": channel}}


def fields(**changes):
    """A grey plastic as export_scene tells it."""
    return {"model": "metallic", "several_coordinates": False, "normal_map": None,
            "base_colour": parameter([0.5, 0.5, 0.5]), "metallic": parameter(0.0),
            "roughness": parameter(0.5), "ior": 1.5, "specular": parameter(1.0),
            "specular_colour": parameter([1.0, 1.0, 1.0]), "transmission": parameter(0.0),
            "anisotropy": {"strength": 0.0, "rotation": 0.0, "map": None},
            "tints_by_root": False, "solid": False,
            "absorption": {"colour": [1.0, 1.0, 1.0], "distance": 0.0},
            "opacity": {"mode": "opaque", "cutoff": 0.5, "alpha": parameter(1.0)}, **changes}


def surface(**changes):
    texel = numpy.array([[[0, 51, 255, 102]]], dtype=numpy.uint8)
    scene = types.SimpleNamespace(textures=[{"texels": texel}],
                                  linear_texels=lambda number: numpy.ones((1, 1, 3)))
    return surfaces.Surface(scene, fields(**changes))


@unittest.skipIf(numpy is None, "numpy is not installed")
class Surfaces(unittest.TestCase):
    def test_an_index_of_one_and_a_half_reflects_four_percent(self):
        self.assertAlmostEqual(surface().reflectance(), 0.04)
        self.assertAlmostEqual(surface(specular=parameter(0.5)).reflectance(), 0.02)

    def test_two_crossings_absorb_what_the_file_says(self):
        inside = {"colour": [0.25, 1.0, 1.0], "distance": 2.0}
        glass = surface(base_colour=parameter([1.0, 1.0, 1.0]), solid=True, absorption=inside)
        tint = glass.crossing_tint()
        self.assertAlmostEqual(tint[0] ** 2, 0.25)
        self.assertAlmostEqual(tint[1], 1.0)
        self.assertEqual(surface(absorption=inside).crossing_tint(), [0.5, 0.5, 0.5])

    def test_metal_lets_nothing_through(self):
        half = surface(transmission=parameter(1.0), metallic=parameter(0.5))
        self.assertAlmostEqual(half.transmits, 0.5)

    def test_maps_have_their_channel(self):
        rough = surface(roughness=parameter(0.5, 0, "green"))
        self.assertAlmostEqual(float(rough.texels(rough["roughness"])[0, 0, 0]), 0.1, places=6)

    def test_masks_are_all_or_nothing(self):
        alpha = parameter(1.0, 0, "alpha")
        for cutoff, there in ((0.3, 1.0), (0.5, 0.0)):
            masked = surface(opacity={"mode": "mask", "cutoff": cutoff, "alpha": alpha})
            self.assertEqual(float(masked.opacity()[0, 0, 0]), there)
        self.assertIsNone(surface().opacity())

    def test_what_no_renderer_is_told_of_is_refused(self):
        for changes in ({"model": "other"}, {"model": "unlit"}, {"several_coordinates": True}):
            with self.assertRaises(expressible.NotExpressible):
                surface(**changes)

    def test_disneys_parameters_stand_for_gltfs(self):
        self.assertAlmostEqual(surfaces.disney_specular(surface()), 0.5)
        coated = surface(clearcoat={"factor": parameter(0.5), "roughness": parameter(0.0),
                                    "normal_map": None})
        self.assertEqual(surfaces.disney_coat(coated), (2.0, 1.0))
        brushed = surface(anisotropy={"strength": 1.0, "rotation": 0.0, "map": None})
        rough, anisotropic = surfaces.disney_anisotropy(brushed)
        aspect = math.sqrt(1.0 - 0.9 * anisotropic)
        self.assertAlmostEqual(rough ** 2 / aspect, 1.0)
        self.assertAlmostEqual(rough ** 2 * aspect, 0.25)

    def test_anisotropy_is_that_of_the_extension(self):
        brushed = surface(anisotropy={"strength": 1.0, "rotation": 0.0, "map": None})
        self.assertEqual(surfaces.anisotropic_alphas(brushed, 0.5), (1.0, 0.25))


@unittest.skipIf(numpy is None, "numpy is not installed")
class Environment(unittest.TestCase):
    def setUp(self):
        columns = 64
        u = (numpy.arange(columns) + 0.5) / columns
        texels = numpy.repeat((2.0 + numpy.sin(2.0 * math.pi * u))[None, :, None], 32, axis=0)
        self.texels = numpy.repeat(texels, 3, axis=2).astype(numpy.float32)
        self.image = {"texels": self.texels, "rows_at_poles": False,
                      "to_world": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]}

    def test_as_it_is(self):
        self.assertIs(surfaces.environment_in_world(self.image), self.texels)

    def test_turned_by_a_quarter(self):
        # What was at +x, the middle, is at +z then, a quarter of the width to the right.
        self.image["to_world"] = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]
        turned = surfaces.environment_in_world(self.image)
        expected = numpy.roll(self.texels, 16, axis=1)
        self.assertLess(float(numpy.abs(turned - expected).max()), 1e-5)


if __name__ == "__main__":
    unittest.main()
