#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""An independent witness for Weft's path tracer: Mitsuba 3 renders the same Mitsuba XML files.

For every scene the two renderers' pictures are compared pixel by pixel with a z-test that uses both
estimated variances, and by the ratio of their means. With --slope the relative mean squared error
against a long Mitsuba rendering of a small picture is fitted over growing sample counts: unbiased
estimates fall as 1 / N. With --speed samples per second of both are compared.

Needs Python packages mitsuba and numpy, for example in an environment of its own:
    python3 -m venv witness && witness/bin/pip install mitsuba numpy
    witness/bin/python bench/witness/witness.py --scenes DIR
"""

import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

ALPHA = 0.01  # of the whole picture; Sidak-corrected over its pixels
ACCEPTED_SHARE = 0.9975
EVERY_SCENE = ("cornell-box", "sibenik", "conference", "office", "desk")


def normal_quantile(p):
    return statistics.NormalDist().inv_cdf(p)


def layers(path):
    """The layers of a picture by name, the picture itself as ''."""
    bitmap = mi.Bitmap(str(path))
    values = np.array(bitmap, dtype=np.float64)
    found = {}
    for index, field in enumerate(bitmap.struct_()):
        name, _, _ = field.name.rpartition(".")
        found.setdefault(name, []).append(values[..., index])
    return {name: np.stack(planes, axis=-1) for name, planes in found.items()}


def run_weft(args, scene, output, samples, seed=0, size=None):
    """Renders with Weft; returns the milliseconds that its frames took."""
    size = size or args.size
    with tempfile.NamedTemporaryFile(suffix=".json") as stats:
        command = [args.weft, "render", scene, "-o", output, "--algorithm", "path", "--spp", samples,
                   "--size", f"{size}x{size}", "--seed", seed, "--backend", args.backend,
                   "--stats", stats.name, "--progress", "none"]
        subprocess.run([str(word) for word in command], check=True, stderr=subprocess.DEVNULL)
        return sum(frame["ms"] for frame in json.load(open(stats.name))["frames"])


class Witness:
    """A scene in Mitsuba."""

    def __init__(self, path, size):
        self.scene = mi.load_file(str(path), max_depth=-1)
        parameters = mi.traverse(self.scene)
        for key in parameters.keys():
            if key.endswith("film.size"):
                parameters[key] = [size, size]
            elif key.endswith("film.crop_size"):
                parameters[key] = [size, size]
        parameters.update()
        self.seed = 1

    def render(self, samples):
        picture = np.array(mi.render(self.scene, spp=samples, seed=self.seed), dtype=np.float64)
        self.seed += 1
        return picture[..., :3]

    def estimate(self, samples, passes):
        """Mean of `passes` pictures of `samples` samples each, and its variance."""
        total = squares = 0.0
        for _ in range(passes):
            picture = self.render(samples)
            total = total + picture
            squares = squares + picture * picture
        mean = total / passes
        variance = (squares / passes - mean * mean) / (passes - 1)
        return mean, np.maximum(variance, 0.0)


def z_test(ours, our_variance, theirs, their_variance):
    """Share of pixels that agree in every channel, at the corrected level."""
    variance = our_variance + their_variance
    # Emitters seen directly have no variance; float rounding is what is left.
    tolerance = 1e-5 * np.maximum(np.abs(ours), np.abs(theirs)) + 1e-30
    difference = np.maximum(np.abs(ours - theirs) - tolerance, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        z = np.where(difference > 0.0, difference / np.sqrt(variance), 0.0)
    level = 1.0 - (1.0 - ALPHA) ** (1.0 / z.size)
    limit = normal_quantile(1.0 - level / 2.0)
    return float((z <= limit).all(axis=-1).mean()), float(limit), z


def mean_test(ours, our_variance, theirs, their_variance):
    """Bias of our mean against theirs, and its standard error, both relative."""
    scale = theirs.mean()
    bias = ours.mean() / scale - 1.0
    error = math.sqrt(our_variance.sum() + their_variance.sum()) / ours.size / scale
    return bias, error


def compare(args, name):
    path = pathlib.Path(args.scenes) / name / f"{name}.xml"
    witness = Witness(path, args.size)
    theirs, their_variance = witness.estimate(args.spp // args.passes, args.passes)
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "ours.exr")
        run_weft(args, path, output, args.spp)
        found = layers(output)
    ours, our_variance = found[""], found["variance"]
    share, limit, z = z_test(ours, our_variance, theirs, their_variance)
    bias, error = mean_test(ours, our_variance, theirs, their_variance)
    return {"scene": name, "size": args.size, "spp": args.spp, "share": share, "z_limit": limit,
            "accepted": share >= ACCEPTED_SHARE, "bias": bias, "bias_error": error,
            "z_root_mean_square": float(np.sqrt((z * z).mean()))}


def slope(args, name):
    """Exponent of relMSE over the sample count; -1 for an unbiased estimate."""
    path = pathlib.Path(args.scenes) / name / f"{name}.xml"
    reference, _ = Witness(path, args.slope_size).estimate(args.slope_reference // 16, 16)
    scale = 1e-2 * reference.mean() ** 2
    counts = [4 ** k for k in range(2, 8) if 4 ** k <= args.slope]
    errors = []
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "ours.exr")
        for count in counts:
            run_weft(args, path, output, count, seed=count, size=args.slope_size)
            ours = layers(output)[""]
            errors.append(float(((ours - reference) ** 2 / (reference ** 2 + scale)).mean()))
    exponent = float(np.polyfit(np.log(counts), np.log(errors), 1)[0])
    return {"scene": name, "counts": counts, "relmse": errors, "slope": exponent}


def speed(args, name):
    path = pathlib.Path(args.scenes) / name / f"{name}.xml"
    witness = Witness(path, args.size)
    witness.render(1)
    samples = args.size * args.size * args.spp
    theirs, ours = [], []
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "ours.exr")
        for _ in range(3):
            begin = time.perf_counter()
            witness.render(args.spp)
            theirs.append(time.perf_counter() - begin)
            ours.append(run_weft(args, path, output, args.spp) * 1e-3)
    return {"scene": name, "variant": mi.variant(), "backend": args.backend,
            "mitsuba_msamples": samples * 1e-6 / statistics.median(theirs),
            "weft_msamples": samples * 1e-6 / statistics.median(ours)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", required=True, help="folder with NAME/NAME.xml")
    parser.add_argument("--only", nargs="*", default=EVERY_SCENE, help="names of scenes")
    parser.add_argument("--weft", default="build/release/weft", help="the program")
    parser.add_argument("--backend", default="opencl")
    parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba")
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--spp", type=int, default=1024)
    parser.add_argument("--passes", type=int, default=32, help="of Mitsuba, for its variance")
    parser.add_argument("--slope", type=int, default=0, metavar="N", help="fit up to N samples")
    parser.add_argument("--slope-size", type=int, default=32)
    parser.add_argument("--slope-reference", type=int, default=262144)
    parser.add_argument("--speed", action="store_true")
    parser.add_argument("--json", help="write all figures")
    args = parser.parse_args()
    mi.set_variant(args.variant)
    results = []
    for name in args.only:
        result = {}
        if args.speed:
            result["speed"] = speed(args, name)
        elif args.slope:
            result["slope"] = slope(args, name)
        else:
            result["test"] = compare(args, name)
        print(json.dumps(result), flush=True)
        results.append(result)
    if args.json:
        with open(args.json, "w", encoding="utf-8") as file:
            json.dump({"mitsuba": mi.__version__, "results": results}, file, indent=1)
    failed = [r for r in results if not r.get("test", {"accepted": True})["accepted"]]
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
