#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Open scenes, before a sky or in the dark: whether the default is as good as path tracing.

Each scene is rendered by `ais` as by default and by `path` in the same time, and both are compared
with a path-traced reference: mean HDR-FLIP, the mean of the image over that of the reference, and
how many pixels are brighter than the brightest of the reference's 3x3 pixels about them, times 1.5.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "identity"))

import exr_pixels  # noqa: E402
import scene_files  # noqa: E402
from processor import processor  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CANDIDATES = {"ais": [], "path": ["--algorithm", "path"]}
SPECK = 1.5


class Failure(Exception):
    """One line for the user."""


def parse():
    parser = argparse.ArgumentParser(prog="bench open_scenes", description=__doc__.splitlines()[0])
    parser.add_argument("--weft", type=pathlib.Path, default=ROOT / "build" / "release" / "weft")
    parser.add_argument("--scenes", nargs="*", type=pathlib.Path, default=[], metavar="FILE",
                        help="further scenes")
    parser.add_argument("--times", nargs="+", type=float, default=[1.0, 4.0], metavar="SECONDS")
    parser.add_argument("--size", default="256x256", metavar="WxH")
    parser.add_argument("--spp", type=int, default=4096, help="of the references")
    parser.add_argument("--backend", default="native", help="opencl, embree or native")
    parser.add_argument("--options", nargs=argparse.REMAINDER, default=[],
                        help="further options of ais, to the end of the line")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER",
                        help="where scenes and images are left, and references found again")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE")
    return parser.parse_args()


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(done.stderr.strip().splitlines()[-1])
    return done.stdout


def luminances(path):
    """Rows of luminance of an image's beauty."""
    image = exr_pixels.Image(path)
    rows = []
    for first in range(0, image.height, image.lines):
        data, at = image.lines_of(first), 0
        for _ in range(min(image.lines, image.height - first)):
            found = {}
            for name, kind in image.channels:
                size = image.width * exr_pixels.TYPE_BYTES[kind]
                if name in ("R", "G", "B"):
                    found[name] = exr_pixels.values(data[at:at + size], kind)
                at += size
            rows.append([0.2126 * r + 0.7152 * g + 0.0722 * b
                         for r, g, b in zip(found["R"], found["G"], found["B"])])
    return rows


def specks(image, reference):
    """Pixels that are too bright beside the reference's pixels about them."""
    count = 0
    for y, row in enumerate(image):
        around = reference[max(0, y - 1):y + 2]
        for x, value in enumerate(row):
            most = max(max(line[max(0, x - 1):x + 2]) for line in around)
            count += value > SPECK * most
    return count


def measure(options, folder, scene):
    common = [scene, "--size", options.size, "--backend", options.backend, "--progress", "none"]
    reference = folder / (scene.stem + "-reference.exr")
    if not reference.exists():
        run(options.weft, "render", *common, "--algorithm", "path", "--spp", options.spp, "--seed",
            "1000", "-o", reference)
    expected = luminances(reference)
    rows = []
    for seconds in options.times:
        for name, words in CANDIDATES.items():
            image = folder / f"{scene.stem}-{name}-{seconds:g}s.exr"
            stats = image.with_suffix(".json")
            further = options.options if name == "ais" else []
            run(options.weft, "render", *common, *words, *further, "--time", f"{seconds:g}s",
                "--stats", stats, "-o", image)
            compared = json.loads(run(options.weft, "compare", reference, image, "--metric", "hdrflip",
                                      "--metric", "mean_ratio", "--json"))
            plan = json.loads(stats.read_text()).get("plan") or {}
            rows.append({"scene": scene.stem, "seconds": seconds, "algorithm": name,
                         "hdrflip": compared["hdrflip"]["mean"],
                         "mean_ratio": compared["mean_ratio"],
                         "specks": specks(luminances(image), expected),
                         "indirect": plan.get("indirect"), "landed": plan.get("vpls_landed")})
            print("{scene:20} {seconds:4g} s {algorithm:5} HDR-FLIP {hdrflip:.4f} mean "
                  "{mean_ratio:.4f} specks {specks:6} {indirect} {landed}".format(**rows[-1]),
                  flush=True)
    return rows


def main():
    options = parse()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        scenes = []
        for name, write in scene_files.SCENES.items():
            scenes.append(folder / f"{name}.gltf")
            write(scenes[-1])
        rows = [row for scene in [*scenes, *options.scenes]
                for row in measure(options, folder, scene)]
    ratios = []
    for ours in rows:
        for other in rows:
            same = all(ours[key] == other[key] for key in ("scene", "seconds"))
            if same and (ours["algorithm"], other["algorithm"]) == ("ais", "path"):
                ratios.append(ours["hdrflip"] / other["hdrflip"])
    own = [row for row in rows if row["algorithm"] == "ais"]
    summary = {"hdrflip_over_path_max": max(ratios),
               "specks_max": max(row["specks"] for row in own),
               "mean_ratio_min": min(row["mean_ratio"] for row in own),
               "mean_ratio_max": max(row["mean_ratio"] for row in own)}
    print(json.dumps(summary))
    if options.json:
        options.json.write_text(json.dumps(
            {"processor": processor(), "summary": summary, "rows": rows}, indent=1))


if __name__ == "__main__":
    try:
        main()
    except (Failure, exr_pixels.NotReadable) as failure:
        sys.exit(f"bench open_scenes: {failure}")
