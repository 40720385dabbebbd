# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Times of two builds by turns: of frames, and of first pictures without compiled kernels."""

import json
import pathlib
import random
import statistics
import tempfile

from builds import run, scene_options

ALGORITHMS = ("ais", "igi", "ic", "path")
SCENES = ("cornell-box", "sibenik", "office-pm")
BACKENDS = ("opencl", "native")
COLD = "cold"  # in place of an algorithm: a first picture
COLD_ALGORITHM = "ais"
LEAST_RATIO = 0.98
RESAMPLES = 2000
BOTH = ("before", "after")


class Timer:
    """Measures one process of a build at a time."""

    def __init__(self, args):
        self.args = args
        self.programs = {"before": args.before, "after": args.weft}

    def stats(self, build, scene, backend, options, environment=None):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            command = [self.programs[build], "render", *scene_options(self.args.scenes, scene),
                       "-o", folder / "picture.exr", "--stats", folder / "stats.json",
                       "--progress", "none", "--backend", backend, "--size",
                       f"{self.args.size}x{self.args.size}", *options, *self.args.options]
            command += ["--threads", self.args.threads] if self.args.threads else []
            run(command, environment)
            return json.loads((folder / "stats.json").read_text(encoding="utf-8"))

    def frames(self, build, scene, backend, algorithm):
        """Milliseconds of the frames of one process but the first, which warms up."""
        options = ["--algorithm", algorithm, "--spp", self.args.frames + 1]
        stats = self.stats(build, scene, backend, options)
        return [frame["ms"] for frame in stats["frames"][1:]]

    def first_picture(self, build, scene, backend):
        """Milliseconds from the start of a program that has to compile its kernels to the written
        picture."""
        with tempfile.TemporaryDirectory() as folder:
            environment = {"WEFT_CACHE_DIR": f"{folder}/weft", "POCL_CACHE_DIR": f"{folder}/pocl"}
            options = ["--algorithm", COLD_ALGORITHM, "--spp", 1]
            stats = self.stats(build, scene, backend, options, environment)
        return [stats["times"]["total_ms"]]

    def measure(self, build, cell):
        scene, backend, algorithm = cell
        if algorithm == COLD:
            return self.first_picture(build, scene, backend)
        return self.frames(build, scene, backend, algorithm)


def cells_of(args):
    """What is timed: scene, backend, algorithm. Native kernels need no compiling."""
    found = [(scene, backend, algorithm) for scene in args.only for backend in args.backends
             for algorithm in args.algorithms]
    return found + [(scene, "opencl", COLD) for scene in args.only if "opencl" in args.backends
                    and not args.no_cold]


def median_of(rounds, build):
    """Of the medians of all processes."""
    return statistics.median(statistics.median(pair[build]) for pair in rounds)


def ratio_of(rounds):
    return median_of(rounds, "before") / median_of(rounds, "after")


def interval_of(rounds):
    """The interval that holds the ratio with 95 %, by drawing rounds anew."""
    chance = random.Random(1)
    ratios = sorted(ratio_of(chance.choices(rounds, k=len(rounds))) for _ in range(RESAMPLES))
    return ratios[RESAMPLES // 40], ratios[-1 - RESAMPLES // 40]


def summary_of(rounds):
    low, high = interval_of(rounds)
    shortest = {build: min(min(pair[build]) for pair in rounds) for build in BOTH}
    return {"before_ms": median_of(rounds, "before"), "after_ms": median_of(rounds, "after"),
            "ratio": ratio_of(rounds), "low": low, "high": high,
            "shortest_ratio": shortest["before"] / shortest["after"], "rounds": len(rounds)}


def measure(args, results, save):
    """Rounds that visit everything once, both builds in turn, so that whatever else the machine
    does meets all alike. `results` holds the rounds so far by cell; `save` is called after each."""
    timer = Timer(args)
    cells = cells_of(args)
    warm = set()
    for number in range(args.repetitions):
        for place, cell in enumerate(cells):
            rounds = results.setdefault(" ".join(cell), [])
            if len(rounds) > number:
                continue
            order = BOTH if (number + place) % 2 == 0 else BOTH[::-1]
            if cell[2] != COLD and cell not in warm:  # compiles what is missing, reads the files
                warm.add(cell)
                for build in order:
                    timer.measure(build, cell)
            rounds.append({build: timer.measure(build, cell) for build in order})
            save()
        print(f"round {number + 1} of {args.repetitions}", flush=True)
    return {" ".join(cell): summary_of(results[" ".join(cell)]) for cell in cells}


def show(summaries):
    """The table of all cells; how many are too slow."""
    width = max(len(name) for name in summaries)
    print(f"\n{'':{width}}  before, ms   after, ms   ratio         95 %      shortest")
    slow = 0
    for name, found in summaries.items():
        late = found["ratio"] < LEAST_RATIO
        slow += late
        print(f"{name:{width}}{found['before_ms']:12.2f}{found['after_ms']:12.2f}"
              f"{found['ratio']:8.3f}   {found['low']:.3f} .. {found['high']:.3f}"
              f"{found['shortest_ratio']:11.3f}{'   SLOWER' if late else ''}")
    return slow
