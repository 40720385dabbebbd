# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Mitsuba 3 as several benchmarks use it."""

import sys

EXIT_MISSING = 69  # as ./weft says where a package is missing


def import_or_exit(program, *modules):
    """Imports modules by name; where one is missing, ends the program with one line."""
    found = []
    for module in modules:
        try:
            found.append(__import__(module))
        except ImportError:
            print(f"{program}: {sys.executable or 'this Python'} has no module {module}, expected "
                  "one that has (--python PROGRAM or WEFT_BENCH_PYTHON; pip install mitsuba "
                  "numpy)", file=sys.stderr)
            sys.exit(EXIT_MISSING)
    return found


def load_scene(mi, path, size, max_depth=-1, **parameters_of_file):
    """A scene of Mitsuba XML as an image of `size` squared, its paths of any length or as long as
    its parameter `max_depth` lets them be. `parameters_of_file` are others that it has."""
    scene = mi.load_file(str(path), max_depth=max_depth, **parameters_of_file)
    parameters = mi.traverse(scene)
    for key in parameters.keys():
        if key.endswith("film.size") or key.endswith("film.crop_size"):
            parameters[key] = [size, size]
    parameters.update()
    return scene
