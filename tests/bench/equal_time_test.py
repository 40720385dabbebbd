#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Renderers of known cost get the samples that fit a budget: run as a program."""

import pathlib
import sys
import unittest

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
