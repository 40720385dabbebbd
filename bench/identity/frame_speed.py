# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Times of two builds by turns: of frames, and of first images without compiled kernels."""

import json
import pathlib
import random
import statistics
import tempfile

from builds import processor_ms, run, scene_options

ALGORITHMS = ("ais", "igi", "ic", "path")
SCENES = ("cornell-box", "sibenik", "office-pm")
BACKENDS = ("opencl", "native")
COLD = "cold"  # in place of an algorithm: a first image
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
        stats = self.stats(build, scene, backend,
                           ["--algorithm", algorithm, "--spp", self.args.frames + 1])
        return [frame["ms"] for frame in stats["frames"][1:]]

    def processor_frame(self, build, scene, backend, algorithm):
        """Milliseconds of frames, and what one of them takes of the processors on average: what a
        process with one frame takes is that of setting up."""
        begin = processor_ms()
        self.stats(build, scene, backend, ["--algorithm", algorithm, "--spp", 1])
        alone = processor_ms()
        frames = self.frames(build, scene, backend, algorithm)
        return frames, (processor_ms() - alone - (alone - begin)) / self.args.frames

    def first_image(self, build, scene, backend):
        """Milliseconds from the start of a program that has to compile its kernels to the written
        image."""
        with tempfile.TemporaryDirectory() as folder:
            environment = {"WEFT_CACHE_DIR": f"{folder}/weft", "POCL_CACHE_DIR": f"{folder}/pocl"}
            options = ["--algorithm", COLD_ALGORITHM, "--spp", 1]
            stats = self.stats(build, scene, backend, options, environment)
        return [stats["times"]["total_ms"]]

    def measure(self, build, cell):
        """Milliseconds, and of the processors or None."""
        scene, backend, algorithm = cell
        if algorithm == COLD:
            return self.first_image(build, scene, backend), None
        if self.args.cpu:
            return self.processor_frame(build, scene, backend, algorithm)
        return self.frames(build, scene, backend, algorithm), None

    def round(self, cell, order):
        """Both builds in this order."""
        found = {build: self.measure(build, cell) for build in order}
        result = {build: ms for build, (ms, _) in found.items()}
        if None not in (processor for _, processor in found.values()):
            result["cpu"] = {build: processor for build, (_, processor) in found.items()}
        return result


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


def processor_ratio(rounds):
    """Of medians; None where it was not measured in every round."""
    found = [pair["cpu"] for pair in rounds if "cpu" in pair]
    if len(found) < len(rounds):
        return None
    before, after = (statistics.median(pair[build] for pair in found) for build in BOTH)
    return before / after if after > 0.0 else None


def summary_of(rounds):
    low, high = interval_of(rounds)
    shortest = {build: min(min(pair[build]) for pair in rounds) for build in BOTH}
    return {"before_ms": median_of(rounds, "before"), "after_ms": median_of(rounds, "after"),
            "ratio": ratio_of(rounds), "low": low, "high": high,
            "shortest_ratio": shortest["before"] / shortest["after"],
            "cpu_ratio": processor_ratio(rounds), "rounds": len(rounds)}


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
            rounds.append(timer.round(cell, order))
            save()
        print(f"round {number + 1} of {args.repetitions}", flush=True)
    return {" ".join(cell): summary_of(results[" ".join(cell)]) for cell in cells}


def show(summaries):
    """The table of all cells; how many are too slow."""
    width = max(len(name) for name in summaries)
    print(f"\n{'':{width}}{'before, ms':>13}{'after, ms':>12}{'ratio':>8}{'95 %':>17}"
          f"{'shortest':>10}{'cpu':>8}")
    slow = 0
    for name, found in summaries.items():
        late = found["ratio"] < LEAST_RATIO
        slow += late
        interval = f"{found['low']:.3f} .. {found['high']:.3f}"
        cpu = "-" if found["cpu_ratio"] is None else f"{found['cpu_ratio']:.3f}"
        print(f"{name:{width}}{found['before_ms']:13.2f}{found['after_ms']:12.2f}"
              f"{found['ratio']:8.3f}{interval:>17}{found['shortest_ratio']:10.3f}{cpu:>8}"
              f"{'  SLOWER' if late else ''}")
    return slow
