#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Renderers of known cost get the samples that fit a budget: run as a program."""

import io
import json
import pathlib
import sys
import types
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench" / "other_renderers"))

import equal_time  # noqa: E402
import other_renderers  # noqa: E402


class Made(equal_time.Renderer):
    """Takes `fixed` and `each` seconds of a clock of its own."""

    def __init__(self, fixed, each):
        self.fixed, self.each = fixed, each

    def render(self, samples, seed):
        return seed, self.fixed + self.each * samples


class EqualTime(unittest.TestCase):
    def samples(self, fixed, each, budget):
        renderer, costs = Made(fixed, each), equal_time.Costs()
        equal_time.warm_up(renderer, costs)
        _, samples, seconds = equal_time.within(renderer, costs, budget, 1)
        self.assertAlmostEqual(seconds, fixed + each * samples)
        return samples

    def test_fills_the_budget_and_never_exceeds_it(self):
        for fixed, each in ((0.0, 0.001), (0.0, 0.07), (0.2, 0.003), (0.05, 0.2)):
            for budget in (0.3, 1.0, 3.0, 10.0):
                samples = self.samples(fixed, each, budget)
                if fixed + each > budget:
                    self.assertEqual(samples, 1)
                    continue
                self.assertLessEqual(fixed + each * samples, 1.05 * budget)
                most = (budget - fixed) / each
                self.assertGreaterEqual(samples, int(0.8 * most))

    def test_one_sample_where_none_fits(self):
        self.assertEqual(self.samples(0.0, 2.0, 0.3), 1)
        self.assertEqual(self.samples(1.0, 0.01, 0.3), 1)


class Disturbed(equal_time.Renderer):
    """As above, but the images of these numbers take as many times as long."""

    def __init__(self, each, factors):
        self.each, self.factors, self.made = each, factors, 0

    def render(self, samples, seed):
        self.made += 1
        return seed, self.each * samples * self.factors.get(self.made, 1.0)


class Unfilled(unittest.TestCase):
    def within(self, each, factors, first=20, budget=10.0):
        """Begins where an image of a few samples has been measured, twenty times too slow."""
        costs = equal_time.Costs()
        costs.add(first, 20.0 * first * each)
        renderer = Disturbed(each, factors)
        return equal_time.within(renderer, costs, budget, 1), renderer

    def test_an_image_that_is_too_short_is_rendered_again(self):
        found, renderer = self.within(0.031, {})
        self.assertTrue(found.filled)
        self.assertGreaterEqual(found.seconds, 8.5)
        self.assertLessEqual(found.seconds, 10.5)
        self.assertGreater(renderer.made, 1)

    def test_disturbed_images_are_rendered_again(self):
        for factors in ({1: 30.0}, {2: 5.0}, {1: 3.0, 3: 4.0}, {2: 0.5}):
            found, _ = self.within(0.031, factors)
            self.assertTrue(found.filled, factors)
            self.assertGreaterEqual(found.seconds, 8.5, factors)
            self.assertLessEqual(found.seconds, 10.5, factors)

    def test_says_so_where_no_image_fills_its_budget(self):
        wild = {number: 0.3 if number % 2 else 30.0 for number in range(1, 20)}
        found, renderer = self.within(0.031, wild)
        self.assertFalse(found.filled)
        self.assertEqual(renderer.made, equal_time.TRIES)
        self.assertIn("left out at 10 s", found.unfilled(10.0))

    def test_a_sample_more_must_fit(self):
        # Two samples would take 1.3 s, or 1.04 s; a third of 0.4 s takes 1.2 s.
        for each, samples in ((0.65, 1), (0.52, 1), (0.4, 2), (0.33, 3), (0.5, 2)):
            found, _ = self.within(each, {}, first=1, budget=1.0)
            self.assertTrue(found.filled)
            self.assertEqual(found.samples, samples, each)

    def test_serve_leaves_it_out_but_for_its_mean(self):
        class Never(equal_time.Renderer):
            name, version, made = "Never", "1", 0

            def render(self, samples, seed):
                self.made += 1
                return None, 0.3 if self.made % 2 else 30.0

        lines = io.StringIO()
        args = types.SimpleNamespace(budgets=[10.0], check=0.0, reference=0.0, mirror=False,
                                     output=".")
        exr_file = types.SimpleNamespace(write_exr=lambda file, image: None)  # needs no numpy
        modules = {"exr_file": exr_file}
        with mock.patch.dict(sys.modules, modules):
            equal_time.serve(Never(), args, lines)
        found = [json.loads(line) for line in lines.getvalue().splitlines()]
        self.assertEqual(len(found), 3)
        self.assertTrue(found[1]["unfilled"].startswith("Never: left out at 10 s"))
        self.assertTrue(found[2]["check"])

    def test_serve_makes_a_reference_of_its_own(self):
        class Steady(equal_time.Renderer):
            name, version = "Steady", "1"

            def render(self, samples, seed):
                return None, 0.01 * samples

        lines, files = io.StringIO(), []
        args = types.SimpleNamespace(budgets=[1.0], check=0.0, reference=20.0, mirror=False,
                                     output=".")
        exr_file = types.SimpleNamespace(write_exr=lambda file, image: files.append(file.name))
        with mock.patch.dict(sys.modules, {"exr_file": exr_file}):
            equal_time.serve(Steady(), args, lines)
        found = [json.loads(line) for line in lines.getvalue().splitlines()]
        self.assertEqual(files, ["steady-1.exr", "steady-reference.exr"])
        self.assertNotIn("reference", found[1])
        self.assertTrue(found[2]["reference"])
        self.assertGreater(found[2]["samples"], 10 * found[1]["samples"])


class Verdict(unittest.TestCase):
    @staticmethod
    def image(name, hdrflip, **fields):
        return {"name": name, "budget_s": 1.0, "seconds": 1.0, "denoised": False,
                "mean_ratio": 1.0, "hdrflip": hdrflip, **fields}

    def verdict(self, *images):
        other_renderers.judge(images)
        return other_renderers.verdict(images, 1.0)

    def test_the_lower_error_wins(self):
        ours, theirs = self.image("Weft path", 0.2), self.image("Other", 0.3)
        self.assertTrue(self.verdict(ours, theirs)["wins"])
        self.assertFalse(self.verdict(self.image("Weft path", 0.4), theirs)["wins"])

    def test_late_images_of_weft_and_other_images_of_renderers_do_not_count(self):
        late = self.image("Weft ais", 0.1, seconds=1.2)
        theirs = self.image("Other", 0.3)
        self.assertFalse(self.verdict(late, theirs)["wins"])
        brighter = self.image("Brighter", 0.05, mean_ratio=1.05)
        ours = self.image("Weft path", 0.2)
        self.assertTrue(self.verdict(ours, theirs, brighter)["wins"])
        self.assertIsNone(self.verdict(ours, brighter)["wins"])

    def test_denoised_renderers_stand_apart(self):
        found = self.verdict(self.image("Weft path", 0.2), self.image("Other", 0.3),
                             self.image("Other, denoised", 0.1, denoised=True))
        self.assertTrue(found["wins"])
        self.assertFalse(found["wins_denoised"])


class HandedOver(unittest.TestCase):
    def test_is_what_weft_reads_and_no_more(self):
        def image(name, comparable):
            return {"name": name, "budget_s": 0.3, "seconds": 0.29, "samples": 4,
                    "denoised": False, "picture": "a.exr", "mean_ratio": 1.0, "hdrflip": 0.1,
                    "comparable": comparable, "late": False}
        found = other_renderers.handed_over([image("Weft path", True), image("Other", True),
                                   image("Dark", False)], ["a note"])
        # The keys that host/tradeoff/other_renderers.cpp knows.
        self.assertEqual(set(found), {"weft_peers", "pictures", "notes"})
        self.assertEqual([set(one) for one in found["pictures"]],
                         [{"name", "budget_s", "seconds", "samples", "denoised", "picture"}])
        self.assertEqual(found["pictures"][0]["name"], "Other")
        self.assertEqual(len(found["notes"]), 2)
        self.assertTrue(found["notes"][1].startswith("Dark: "))


if __name__ == "__main__":
    unittest.main()
