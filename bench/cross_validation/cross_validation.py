#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""An independent check of Weft's path tracer: Mitsuba 3 renders the same Mitsuba XML files.

For every scene the two renderers' images are compared pixel by pixel with a z-test that uses both
estimated variances, and by the ratio of their means. With --slope the relative mean squared error
against a long Mitsuba rendering of a small image is fitted over growing sample counts: unbiased
estimates fall as 1 / N. What the reference's own noise adds to that error is subtracted, as the
reference estimates it.

Needs Python packages mitsuba and numpy, for example in an environment of its own:
    python3 -m venv cross-validation && cross-validation/bin/pip install mitsuba numpy
    ./weft bench cross_validation --python cross-validation/bin/python --scenes DIR
"""

import argparse
import hashlib
import json
import math
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))

import media_scenes  # noqa: E402
from mitsuba_comparison import (ACCEPTED_SHARE, EXIT_OUTPUT, Mitsuba, choose_variant,  # noqa: E402
                                mean_test, mi, np, render_weft, write_report, z_test)

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EVERY_SCENE = ("cornell-box", "sibenik", "conference", "office", "desk")
FOG = "-fog"  # DIR/NAME/NAME-fog.xml
EVERY_MEDIUM = ("cornell-box-fog", "office-fog", "sibenik-fog", *media_scenes.SCENES)
REFERENCE_PASSES = 32
SHARED_PASSES = 16  # of an algorithm whose pixels share noise
LEAST_COUNT = 256


def render(args, path, samples, size, seed=0):
    """The layers of an image by Weft."""
    return render_weft(args.weft, path, samples, size, seed, args.algorithm, args.backend,
                       args.threads)


def render_parts(args, path):
    """The layers of an image by Weft, and the independent images that it is the mean of."""
    if args.algorithm == "path":
        return render(args, path, args.spp, args.size), ()
    samples = max(2, args.spp // SHARED_PASSES)
    parts = [render(args, path, samples, args.size, seed) for seed in range(SHARED_PASSES)]
    found = {name: np.mean([part[name] for part in parts], axis=0) for name in parts[0]}
    found["variance"] = found["variance"] / SHARED_PASSES
    return found, [part[""] for part in parts]


def compare(args, name, path):
    theirs, their_variance = Mitsuba(path, args.size).estimate(args.spp // args.passes, args.passes)
    found, parts = render_parts(args, path)
    images = [found[""], found["variance"], theirs, their_variance]
    share, limit, z = z_test(*images)
    bias, error = mean_test(*images, parts)
    result = {"scene": name, "algorithm": args.algorithm, "size": args.size, "spp": args.spp,
              "share": share, "z_limit": limit,
              "accepted": share >= ACCEPTED_SHARE, "bias": bias, "bias_error": error,
              "z_root_mean_square": float(np.sqrt((z * z).mean()))}
    dark = found["emission"].sum(axis=-1) == 0.0
    if dark.any() and not dark.all():
        bias, error = mean_test(*[image[dark] for image in images],
                                [part[dark] for part in parts])
        result.update({"lampless_share": float(dark.mean()), "lampless_bias": bias,
                       "lampless_bias_error": error})
    return result


def reference(args, name, path):
    """The long rendering and its variance; kept in --cache, whatever it depends on in its name."""
    file = None
    if args.cache:
        digest = hashlib.sha256(path.read_bytes()).hexdigest()[:12]
        file = pathlib.Path(args.cache) / (f"{name}-{digest}-{args.slope_size}-"
                                           f"{args.slope_reference}-{mi.variant()}-"
                                           f"{mi.__version__}.npz")
        if file.is_file():
            with np.load(file) as kept:
                return kept["mean"], kept["variance"]
    mean, variance = Mitsuba(path, args.slope_size).estimate(
        args.slope_reference // REFERENCE_PASSES, REFERENCE_PASSES)
    if file:
        file.parent.mkdir(parents=True, exist_ok=True)
        part = file.with_suffix(".part.npz")
        np.savez(part, mean=mean, variance=variance)
        os.replace(part, file)
    return mean, variance


def line_fit(x, y, error):
    """Slope of the weighted line through points, and its standard error. Where the points scatter
    more than their errors say, the error is as much larger."""
    weight = 1.0 / np.square(error)
    centre = (weight * x).sum() / weight.sum()
    spread = (weight * np.square(x - centre)).sum()
    slope = (weight * (x - centre) * y).sum() / spread
    rest = y - slope * (x - centre) - (weight * y).sum() / weight.sum()
    scatter = (weight * rest * rest).sum() / max(len(x) - 2, 1)
    return float(slope), math.sqrt(max(scatter, 1.0) / spread)


def slope(args, name, path):
    """Exponent of relMSE over the sample count; -1 for an unbiased estimate."""
    mean, variance = reference(args, name, path)
    scale = np.square(mean) + 1e-2 * mean.mean() ** 2
    counts = [LEAST_COUNT]
    while 4 * counts[-1] <= args.slope:
        counts.append(4 * counts[-1])
    values, errors = [], []
    for count in counts:
        # Every count gets as many samples in all: where few were made, rare bright paths would be
        # missing, and with them most of the error.
        repeats = args.slope // count
        pixels = 0.0
        for repeat in range(repeats):
            ours = render(args, path, count, args.slope_size, seed=100 * count + repeat)[""]
            pixels = pixels + ((np.square(ours - mean) - variance) / scale).mean(axis=-1) / repeats
        values.append(float(pixels.mean()))
        errors.append(float(pixels.std(ddof=1) / math.sqrt(pixels.size)))
    values, errors = np.array(values), np.array(errors)
    result = {"scene": name, "size": args.slope_size, "reference_spp": args.slope_reference,
              "reference_relmse": float((variance / scale).mean()), "counts": counts,
              "relmse": values.tolist(), "relmse_error": errors.tolist()}
    if (values > 0.0).all():
        result["slope"], result["slope_error"] = line_fit(np.log(counts), np.log(values),
                                                          errors / values)
    return result


def summary(results):
    """The numbers that matter, over the scenes."""
    tests = [r["test"] for r in results if "test" in r]
    slopes = [r["slope"] for r in results if "slope" in r]
    found = {}
    if tests:
        found["share_min"] = min(t["share"] for t in tests)
        found["bias_max"] = max(abs(t["bias"]) for t in tests)
        found["bias_error_max"] = max(t["bias_error"] for t in tests)
    if slopes:
        fitted = [s for s in slopes if "slope" in s]
        complete = len(fitted) == len(slopes)
        found["slope_max"] = max(s["slope"] for s in fitted) if complete else None
        found["slope_min"] = min(s["slope"] for s in fitted) if complete else None
    return found


class Parser(argparse.ArgumentParser):
    """Fails as Weft's other programs do."""

    def error(self, message):
        self.exit(1, f"{self.prog}: {message}\n")


def parse():
    parser = Parser(prog="bench cross_validation", description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="small images and few samples")
    parser.add_argument("--scenes", default=str(ROOT.parent / "shared" / "data" / "scenes"),
                        help="folder of scenes, each DIR/NAME/NAME.xml")
    parser.add_argument("--only", nargs="+", help="names of scenes")
    parser.add_argument("--media", action="store_true",
                        help="scenes with participating media instead of those without")
    parser.add_argument("--json", help="write machine, versions, all figures and a summary")
    parser.add_argument("--weft", default=str(ROOT / "build" / "release" / "weft"),
                        help="the program")
    parser.add_argument("--algorithm", default="path", choices=("path", "reference"),
                        help="of Weft")
    parser.add_argument("--backend", default="opencl", help="of Weft")
    parser.add_argument("--threads", type=int, default=0, help="of both; 0: all")
    parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba")
    parser.add_argument("--size", type=int, help="of the image, default 128")
    parser.add_argument("--spp", type=int, help="samples per pixel, default 1024")
    parser.add_argument("--passes", type=int, default=32, help="of Mitsuba, for its variance")
    parser.add_argument("--slope", type=int, default=0, metavar="N",
                        help="instead of testing, fit the error up to N samples, 1024 to 65536")
    parser.add_argument("--slope-size", type=int, help="of the image, default 24")
    parser.add_argument("--slope-reference", type=int, help="samples per pixel, default 65536")
    parser.add_argument("--cache", metavar="DIR", help="keep references here, and use them again")
    args = parser.parse_args()
    ordinary = {"size": 128, "spp": 1024, "slope_size": 24, "slope_reference": 65536}
    quick = {"size": 32, "spp": 256, "slope_size": 16, "slope_reference": 8192}
    for key, value in (quick if args.quick else ordinary).items():
        if getattr(args, key) is None:
            setattr(args, key, value)
    if args.quick and args.slope:
        args.slope = min(args.slope, 4 * LEAST_COUNT)
    if args.slope and not 4 * LEAST_COUNT <= args.slope <= 65536:
        parser.error("--slope is out of range, expected 1024 to 65536")
    if args.passes < 2 or args.spp < args.passes or args.slope_reference < REFERENCE_PASSES:
        parser.error("expected at least 2 passes and a sample for each")
    return args


def scene_file(args, name, folder):
    """Where a scene is; one of its own is written into the folder."""
    if name in media_scenes.SCENES:
        return media_scenes.write_scene(name, folder)
    return pathlib.Path(args.scenes) / name.removesuffix(FOG) / f"{name}.xml"


def measure(args, folder):
    """The results of all scenes that are there."""
    results = []
    for name in args.only or (EVERY_MEDIUM if args.media else EVERY_SCENE):
        path = scene_file(args, name, folder)
        if not path.is_file():
            continue
        result = ({"slope": slope(args, name, path)} if args.slope
                  else {"test": compare(args, name, path)})
        print(json.dumps(result), flush=True)
        results.append(result)
    return results


def main():
    args = parse()
    if not choose_variant(args.variant, args.threads):
        return 1
    with tempfile.TemporaryDirectory() as folder:
        results = measure(args, pathlib.Path(folder))
    if not results:
        print(f"bench cross_validation: no scene in {args.scenes}, expected DIR/NAME/NAME.xml",
              file=sys.stderr)
        return 1
    print(json.dumps(summary(results)))
    if args.json and not write_report(args, results, summary(results)):
        return EXIT_OUTPUT
    failed = [r for r in results if not r.get("test", {"accepted": True})["accepted"]]
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
