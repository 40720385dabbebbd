#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What each lobe of a material adds to the time of a sample of path tracing.

The program writes one scene after the other: a grey room with an area light and a ball, whose
material is the one measured. Light scatters about the ball as the material makes it, so that a time
holds longer or shorter paths as well as the code of the lobe: of a mirror all paths go on, of a
black surface none. Rays are therefore listed beside it. The scenes are rendered in turn, several
times; times are ratios to the diffuse ball in the same round, and their median is printed."""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the source folder is no place for it

from cost_scenes import MATERIALS, scene_text  # noqa: E402 (after the line above, on purpose)


def measure(weft, scene, backend, size, spp, folder):
    """Milliseconds that the samples took, and rays per path of the camera."""
    stats = folder / "stats.json"
    subprocess.run([weft, "render", str(scene), "--algorithm", "path", "--backend", backend,
                    "--size", f"{size}x{size}", "--spp", str(spp), "--threads", "1", "--stats",
                    str(stats), "-o", str(folder / "image.exr")], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    found = json.loads(stats.read_text(encoding="utf-8"))
    frames = found["frames"]
    time = sum(frame["ms"] for frame in frames)
    return time, sum(frame["rays"] for frame in frames) / (size * size * spp)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--weft", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--backend", default="native")
    parser.add_argument("--size", type=int, default=192)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=pathlib.Path, help="writes the figures to this file")
    options = parser.parse_args()
    ratios = {name: [] for name in MATERIALS}
    rays = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, material in enumerate(MATERIALS):
            (folder / f"{number}.gltf").write_text(scene_text(material), encoding="utf-8")
        for _ in range(options.rounds):
            first = None
            for number, material in enumerate(MATERIALS):
                time, rays[material] = measure(options.weft, folder / f"{number}.gltf",
                                               options.backend, options.size, options.spp, folder)
                first = first or time
                ratios[material].append(time / first)
    print(f"{'material of the ball':32} {'time':>6} {'rays':>6}")
    figures = {}
    for material, values in ratios.items():
        figures[material] = {"time": statistics.median(values), "rays": rays[material]}
        print(f"{material:32} {figures[material]['time']:6.2f} {rays[material]:6.2f}")
    if options.json:
        options.json.write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
