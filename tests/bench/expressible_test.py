#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes that no renderer's program can express are left out: run as a program."""

import pathlib
import sys
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench" / "other_renderers"))

import expressible  # noqa: E402


def scene_of(*materials):
    """An exported scene of these materials and nothing else."""
    return types.SimpleNamespace(materials=materials, lights=[], textures=[], meshes=[], media=[])


class Refuse(unittest.TestCase):
    def test_other_lobes_are_refused_without_being_named(self):
        scene = scene_of({"lambertian": True}, {"lambertian": False})
        with self.assertRaises(expressible.NotExpressible) as caught:
            expressible.refuse(scene, ["media"])
        self.assertEqual(str(caught.exception), "surfaces that are not Lambertian")

    def test_textured_emission_is_refused_without_being_named(self):
        scene = scene_of({"lambertian": True, "textured_emission": True})
        with self.assertRaises(expressible.NotExpressible) as caught:
            expressible.refuse(scene, [])
        self.assertEqual(str(caught.exception), "textured emission")

    def test_lamberts_is_not(self):
        expressible.refuse(scene_of({"lambertian": True}, {}), ["media", "textures"])


if __name__ == "__main__":
    unittest.main()
