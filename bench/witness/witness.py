#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""An independent check of Weft's materials: Mitsuba 3 renders the same spheres of them.

The program writes its scenes itself (witness_scenes.py). Weft's `path` and Mitsuba render each, and
are compared as by `bench cross_validation`: by a z-test of the pixels with both estimated variances,
and by the means of the images, which must agree within three standard errors. Ends with 1 where a
scene does not.

Needs Python packages mitsuba and numpy, for example in an environment of its own:
    python3 -m venv cross-validation && cross-validation/bin/pip install mitsuba numpy
    ./weft bench witness --python cross-validation/bin/python
"""

import argparse
import fnmatch
import json
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))

import mitsuba_variant  # noqa: E402
import witness_scenes  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MOST_ERRORS = 3.0  # standard errors by which means may differ
PASSES = 32  # of Mitsuba, for its variance
# Scatterings after which Mitsuba begins with roulette, which lets 95 % of the paths in glass go on:
# after 5, its usual number, few paths along the rim of a sphere have so much weight that a z-test
# is not meant for their mean.
ROULETTE_DEPTH = 50


def compare(args, comparison, name, folder):
    """Renders a scene by both programs; its figures."""
    path = witness_scenes.write_scene(name, folder)
    depth = witness_scenes.SCENES[name].depth
    options = ["--max-bounces", depth] if depth >= 0 else []
    found = comparison.render_weft(args.weft, path, args.spp, args.size, args.seed,
                                   backend=args.backend, threads=args.threads, options=options)
    # What Mitsuba counts are segments: one more than scatterings.
    scene = comparison.Mitsuba(path, args.size, depth + 1 if depth >= 0 else -1,
                               rr_depth=ROULETTE_DEPTH)
    theirs, their_variance = scene.estimate(max(args.spp // PASSES, 1), PASSES)
    images = (found[""], found["variance"], theirs, their_variance)
    share, limit, _ = comparison.z_test(*images)
    bias, error = comparison.mean_test(*images)
    if args.images:
        keep = pathlib.Path(args.images)
        keep.mkdir(parents=True, exist_ok=True)
        comparison.np.savez(keep / f"{name}.npz", ours=found[""], our_variance=found["variance"],
                            theirs=theirs, their_variance=their_variance)
    errors = abs(bias) / error if error > 0.0 else 0.0
    agrees = share >= comparison.ACCEPTED_SHARE and errors <= MOST_ERRORS
    return {"scene": name, "depth": depth, "size": args.size, "spp": args.spp, "share": share,
            "z_limit": limit, "bias": bias, "bias_error": error, "accepted": bool(agrees)}


def line(result):
    return (f"{result['scene']:<34} {100.0 * result['share']:7.2f} %  "
            f"{100.0 * result['bias']:+7.3f} % +- {100.0 * result['bias_error']:.3f} %  "
            + ("agrees" if result["accepted"] else "DIFFERS"))


def summary(results):
    """The numbers that matter, over the scenes."""
    return {"scenes": len(results), "agree": sum(r["accepted"] for r in results),
            "share_min": min(r["share"] for r in results),
            "bias_max": max(abs(r["bias"]) for r in results),
            "bias_errors_max": max(abs(r["bias"]) / r["bias_error"] if r["bias_error"] > 0.0
                                   else 0.0 for r in results),
            "differ": [r["scene"] for r in results if not r["accepted"]]}


class Parser(argparse.ArgumentParser):
    """Fails as Weft's other programs do."""

    def error(self, message):
        self.exit(1, f"{self.prog}: {message}\n")


def parse():
    parser = Parser(prog="bench witness", description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="smaller images, fewer samples")
    parser.add_argument("--only", nargs="+", metavar="NAME",
                        help="names of scenes, or patterns such as 'rough*'")
    parser.add_argument("--list", action="store_true", help="print the names of all scenes")
    parser.add_argument("--json", help="write machine, versions, all figures and a summary")
    parser.add_argument("--images", metavar="DIR", help="keep images and variances, as NAME.npz")
    parser.add_argument("--weft", default=str(ROOT / "build" / "release" / "weft"),
                        help="the program")
    parser.add_argument("--backend", default="native", help="of Weft")
    parser.add_argument("--threads", type=int, default=0, help="of both; 0: all")
    parser.add_argument("--variant", default="", help="of Mitsuba; the fastest that works")
    parser.add_argument("--size", type=int, help="of the images, default 48")
    parser.add_argument("--spp", type=int, help="samples per pixel, default 2048")
    parser.add_argument("--seed", type=int, default=0, help="of Weft")
    args = parser.parse_args()
    for key, value in ({"size": 32, "spp": 512} if args.quick
                       else {"size": 48, "spp": 2048}).items():
        if getattr(args, key) is None:
            setattr(args, key, value)
    if args.size < 1 or args.spp < PASSES:
        parser.error(f"expected images of at least a pixel and {PASSES} samples")
    patterns = args.only or ["*"]
    args.scenes = [name for name in witness_scenes.SCENES
                   if any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)]
    if not args.scenes:
        parser.error(f"no scene is called {' or '.join(patterns)}, expected one that --list names")
    return args


def load_comparison(variant, threads):
    """The module that compares, with a variant of Mitsuba that works; None where there is none."""
    choice = mitsuba_variant.choose(variant)
    if choice.get("library"):
        os.environ[mitsuba_variant.LIBRARY] = choice["library"]  # read when Dr.Jit is loaded
    import mitsuba_comparison  # ends the program where packages are missing

    if "variant" not in choice:
        print(f"bench witness: no variant of Mitsuba works: {choice['problem']}", file=sys.stderr)
        return None
    return mitsuba_comparison if mitsuba_comparison.choose_variant(choice["variant"],
                                                                   threads) else None


def main():
    args = parse()
    if args.list:
        print("\n".join(args.scenes))
        return 0
    comparison = load_comparison(args.variant, args.threads)
    if comparison is None:
        return 1
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for name in args.scenes:
            results.append(compare(args, comparison, name, pathlib.Path(folder)))
            print(line(results[-1]), flush=True)
    total = summary(results)
    print(json.dumps(total))
    if args.json and not comparison.write_report(args, results, total):
        return comparison.EXIT_OUTPUT
    return 1 if total["differ"] else 0


if __name__ == "__main__":
    sys.exit(main())
