#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The newest LLVM library that Mitsuba works with is taken, and its scalar variant where none is:
run as a program."""

import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench" / "common"))

import mitsuba_variant  # noqa: E402
from mitsuba_variant import SCALAR, VECTORISED  # noqa: E402

WORKS = {"version": "3", "llvm": "19"}
NO_MITSUBA = {"problem": "has no module mitsuba", "missing": True}


class Libraries(unittest.TestCase):
    def test_versions_stand_in_names(self):
        for name, version in (("libLLVM-14.so.1", (14,)), ("libLLVM-14.0.6.so.1", (14, 0, 6)),
                              ("libLLVM.so.19.1", (19, 1)), ("libLLVM-15.so", (15,)),
                              ("libLLVM.so", ()), ("libLLVMCore.so", None), ("libLLVM-9.a", None),
                              ("libLLVM-16.so.1.bak", None)):
            self.assertEqual(mitsuba_variant.library_version(pathlib.Path(name)), version, name)

    def test_each_once_the_newest_first(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve()
            for file in ("libLLVM-9.so.1", "libLLVM-14.so.1", "libLLVM.so.19.1", "libLLVMCore.so"):
                (folder / file).touch()
            (folder / "libLLVM-19.so").symlink_to("libLLVM.so.19.1")
            (folder / "libLLVM-20.so").symlink_to("gone")
            found = mitsuba_variant.libraries([str(folder), str(folder / "none")])
        self.assertEqual([pathlib.Path(file).name for file in found],
                         ["libLLVM.so.19.1", "libLLVM-14.so.1", "libLLVM-9.so.1"])


class Choice(unittest.TestCase):
    def choose(self, answers, variant="", wished=None):
        """`answers`: by variant and library; all others fail. Also gives what was tried."""
        tried = []

        def prove(name, library):
            tried.append((name, library))
            return answers.get((name, library), {"problem": "it ended by signal 6"})

        values = {mitsuba_variant.LIBRARY: wished} if wished else {}
        with mock.patch.dict(os.environ, values):
            if not wished:
                os.environ.pop(mitsuba_variant.LIBRARY, None)
            return mitsuba_variant.choose(variant, lambda: ["new", "old"], prove), tried

    def test_the_newest_library_that_works(self):
        found, tried = self.choose({(VECTORISED, "new"): WORKS, (VECTORISED, "old"): WORKS})
        self.assertEqual((found["variant"], found["library"]), (VECTORISED, "new"))
        self.assertEqual(tried, [(VECTORISED, "new")])
        found, _ = self.choose({(VECTORISED, "old"): WORKS, (SCALAR, ""): WORKS})
        self.assertEqual((found["variant"], found["library"]), (VECTORISED, "old"))
        self.assertEqual([one["library"] for one in found["failed"]], ["new"])

    def test_scalar_where_none_works(self):
        found, tried = self.choose({(SCALAR, ""): WORKS})
        self.assertEqual((found["variant"], found["library"]), (SCALAR, ""))
        self.assertEqual(tried, [(VECTORISED, "new"), (VECTORISED, "old"), (SCALAR, "")])

    def test_only_the_library_that_the_user_names(self):
        found, tried = self.choose({(VECTORISED, "new"): WORKS, (SCALAR, ""): WORKS},
                                   wished="mine")
        self.assertEqual(found["variant"], SCALAR)
        self.assertEqual(tried, [(VECTORISED, "mine"), (SCALAR, "")])

    def test_only_the_variant_that_the_user_names(self):
        found, tried = self.choose({(VECTORISED, "new"): WORKS, (SCALAR, ""): WORKS}, SCALAR)
        self.assertEqual((found["variant"], tried), (SCALAR, [(SCALAR, "")]))
        found, _ = self.choose({(SCALAR, ""): WORKS}, VECTORISED)
        self.assertIn("old: it ended by signal 6", found["problem"])
        self.assertNotIn("variant", found)

    def test_without_mitsuba_no_library_is_tried(self):
        found, tried = self.choose({(VECTORISED, "new"): NO_MITSUBA})
        self.assertEqual(found["problem"], NO_MITSUBA["problem"])
        self.assertEqual(len(tried), 1)

    def test_the_library_is_handed_to_the_process(self):
        self.assertEqual(mitsuba_variant.environment("mine")[mitsuba_variant.LIBRARY], "mine")


if __name__ == "__main__":
    unittest.main()
