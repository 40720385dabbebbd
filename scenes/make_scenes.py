#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the scenes that ship with Weft. Needs nothing but Python 3.

    make_scenes.py            writes every file of this folder's scenes
    make_scenes.py --check    compares them with what would be written; exit code 1 if one differs
    make_scenes.py --only desk office    some of them
"""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True  # a check leaves nothing behind in the source tree

from generator import (  # noqa: E402 (after the line above, on purpose)
    bathroom, car_paint, conference, cornell, desk, deskar, figure, gallery, office, shafts,
    shirley6, sibenik, smoke, still_life, subdivided)

SCENES = (cornell, gallery, shafts, smoke, figure, sibenik, subdivided, desk, deskar, shirley6,
          office, conference, still_life, bathroom, car_paint)
NAMES = {scene.__name__.rpartition(".")[2]: scene for scene in SCENES}


def difference(path, wanted):
    """What is wrong with a file, or None."""
    if not path.is_file():
        return "is missing"
    found = path.read_bytes()
    if found == wanted:
        return None
    common = min(len(found), len(wanted))
    first = next((i for i in range(common) if found[i] != wanted[i]), common)
    return (f"differs from byte {first} on ({len(found)} bytes, expected {len(wanted)}); "
            "run make_scenes.py to write it anew")


def main():
    parser = argparse.ArgumentParser(description="Makes the scenes that ship with Weft.")
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent,
                        help="folder to write to or compare with (default: this script's)")
    parser.add_argument("--only", nargs="+", choices=sorted(NAMES), metavar="SCENE",
                        help="these of " + ", ".join(sorted(NAMES)))
    options = parser.parse_args()
    wrong = 0
    scenes = [NAMES[name] for name in options.only] if options.only else SCENES
    files = {name: content for scene in scenes for name, content in scene.build().items()}
    for name, content in files.items():
        path = options.out / name
        if not options.check:
            path.write_bytes(content)
            print(f"{path}: {len(content)} bytes")
            continue
        problem = difference(path, content)
        if problem:
            wrong += 1
            print(f"{path}: {problem}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
