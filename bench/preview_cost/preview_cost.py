#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What mirrors, glass and gloss add to the time of a sample of a preview.

Each scene is rendered as it is and with `--materials diffuse`, in turn, several times; the ratio of
the times of the samples after the first is printed, by the median of all rounds, and with `--amax`
what `amax` takes over `ais`, both as the scene is: for all of the image, and for each component that
mirrors, glass and gloss call for. The program writes scenes of its own; scenes of
the user may follow."""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the source folder is no place for it

from preview_scenes import PARTS, scene_text  # noqa: E402 (after the line above, on purpose)


COMPONENTS = ("reflection", "refraction", "glossy")


def measure(options, scene, folder, *more):
    """Milliseconds of a sample after the first: of all of it, and of each of COMPONENTS."""
    stats = folder / "stats.json"
    subprocess.run([options.weft, "render", str(scene), "--backend", options.backend, "--size",
                    f"{options.size}x{options.size}", "--spp", str(options.spp), "--progress",
                    "none", "--stats", str(stats), "-o", str(folder / "image.exr"), *more],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    frames = json.loads(stats.read_text(encoding="utf-8"))["frames"][1:]
    times = [statistics.mean(frame["ms"] for frame in frames)]
    for name in COMPONENTS:
        times.append(statistics.mean(sum(stage["ms"] for stage in frame["stages"]
                                         if stage["component"] == name) for frame in frames))
    return times


def over(first, second):
    """Their ratio, or None where nothing was measured."""
    return first / second if second > 0.0 else None


def cell(value):
    return f" {'-' if value is None else format(value, '.2f'):>10}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--weft", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--backend", default="native")
    parser.add_argument("--size", type=int, default=512)
    # Further samples of a scene with mirrors refine it, which others do not.
    parser.add_argument("--spp", type=int, default=4)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--amax", action="store_true", help="measures amax over ais as well")
    parser.add_argument("--json", type=pathlib.Path, help="writes the figures to this file")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    if options.spp < 2:
        parser.error("--spp is less than 2; the first sample does not count")
    figures = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scenes = {}
        for number, part in enumerate(PARTS):
            scenes[part] = folder / f"{number}.gltf"
            scenes[part].write_text(scene_text(part), encoding="utf-8")
        scenes.update({scene.stem: scene for scene in options.scenes})
        ratios = ("/diffuse", "amax/ais", *COMPONENTS) if options.amax else ("/diffuse",)
        print(f"{'scene':32} {'ms':>7}" + "".join(f" {name:>10}" for name in ratios))
        for scene, path in scenes.items():
            rows = []
            for _ in range(options.rounds):
                full = measure(options, path, folder)
                plain = measure(options, path, folder, "--materials", "diffuse")
                row = [full[0], over(full[0], plain[0])]
                if options.amax:
                    amax = measure(options, path, folder, "--algorithm", "amax")
                    row += [over(*pair) for pair in zip(amax, full)]
                rows.append(row)
            ms, *found = (None if None in one else statistics.median(one) for one in zip(*rows))
            figures[scene] = {"ms": ms, **dict(zip(ratios, found))}
            print(f"{scene:32} {ms:7.1f}" + "".join(map(cell, found)), flush=True)
    if options.json:
        options.json.write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
