#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Two builds of Weft side by side: whether they make the same images, and in what time.

By default every scene is rendered by both with every algorithm on every backend, and all channels
of the EXR files are compared bit by bit. With --time frames of both are timed by turns instead.
docs/benchmarks.md says what is rendered and how the tables are read.
"""

import argparse
import concurrent.futures
import os
import pathlib
import platform
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))

import frame_speed  # noqa: E402
from builds import (EDITS, Failure, EXIT_OUTPUT, EXIT_USAGE, earlier_results,  # noqa: E402
                    program_digest, run, write_json)
from images import (BACKENDS, KINDS, MORE_KINDS, Images, all_cases, name_of,  # noqa: E402
                      scenes_digest)
from processor import processor  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EDITED = "cornell-box" + EDITS
QUICK_SCENES = ("cornell-box", "figure", "smoke")
QUICK_BACKENDS = ("native",)
DIFFERENT = 1  # the exit code


class Parser(argparse.ArgumentParser):
    """Fails as Weft's other programs do."""

    def error(self, message):
        self.exit(1, f"{self.prog}: {message}\n")


def parse():
    parser = Parser(prog="bench identity", description=__doc__.splitlines()[0])
    parser.add_argument("--before", required=True, type=pathlib.Path, metavar="PROGRAM",
                        help="the other build's program weft")
    parser.add_argument("--weft", type=pathlib.Path, default=ROOT / "build" / "release" / "weft",
                        metavar="PROGRAM", help="the build after")
    parser.add_argument("--time", action="store_true", help="time frames instead")
    parser.add_argument("--fill-cache", action="store_true",
                        help="only render what is missing of the build before")
    parser.add_argument("--only", nargs="+", metavar="SCENE", help="names of scenes")
    parser.add_argument("--algorithms", nargs="+", metavar="NAME",
                        choices=["all", *KINDS, *MORE_KINDS], help="or 'all'; by default "
                        + " ".join(KINDS) + ", with --time " + " ".join(frame_speed.ALGORITHMS))
    parser.add_argument("--backends", nargs="+", choices=BACKENDS, metavar="NAME",
                        help="by default all, with --time " + " ".join(frame_speed.BACKENDS))
    parser.add_argument("--size", type=int, help="width and height, 128; with --time 512")
    parser.add_argument("--options", nargs=argparse.REMAINDER, default=[],
                        help="further options of weft render for both, to the end of the line")
    parser.add_argument("--frames", type=int, default=5, metavar="N",
                        help="of --time: timed frames of each process, 5")
    parser.add_argument("--repetitions", type=int, metavar="N",
                        help="of --time: processes of each build, 7; --quick: 3")
    parser.add_argument("--cpu", action="store_true",
                        help="of --time: processor time as well; twice as many processes")
    parser.add_argument("--no-cold", action="store_true",
                        help="of --time: no first images with empty caches")
    parser.add_argument("--jobs", type=int, metavar="N", help="images at a time, 1")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="of each program")
    parser.add_argument("--scenes", type=pathlib.Path, default=ROOT / "scenes", metavar="DIR")
    parser.add_argument("--cache", type=pathlib.Path, metavar="DIR",
                        help="keeps the images of the build before, OUTPUT/before")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("identity"),
                        metavar="DIR", help="gets the images that differ, and the report")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE",
                        help="the report, OUTPUT/identity.json, with --time OUTPUT/time.json")
    parser.add_argument("--resume", action="store_true",
                        help="leave out what the report of the same two programs holds")
    parser.add_argument("--quick", action="store_true", help="three scenes, one backend")
    args = parser.parse_args()
    complete(parser, args)
    return args


def complete(parser, args):
    """Fills in what depends on other options, and refuses what cannot be."""
    algorithms = frame_speed.ALGORITHMS if args.time else tuple(KINDS)
    args.algorithms = args.algorithms or algorithms
    if "all" in args.algorithms:
        args.algorithms = (*KINDS, *MORE_KINDS)
    if args.time and not set(args.algorithms) <= set(frame_speed.ALGORITHMS):
        parser.error("--algorithms: with --time expected some of: " + " ".join(algorithms))
    backends = frame_speed.BACKENDS if args.time else BACKENDS
    args.backends = args.backends or (QUICK_BACKENDS if args.quick else backends)
    args.size = args.size or (512 if args.time else 128)
    args.repetitions = args.repetitions or (3 if args.quick else 7)
    args.jobs = args.jobs or 1
    for name in ("size", "frames", "repetitions", "jobs"):
        if getattr(args, name) < 1:
            parser.error(f"--{name}: expected at least 1")
    args.before, args.weft = args.before.resolve(), args.weft.resolve()
    args.cache = args.cache or args.output / "before"
    args.json = args.json or args.output / ("time.json" if args.time else "identity.json")
    known = sorted(file.stem for file in args.scenes.glob("*.gltf"))
    if (args.scenes / "cornell-box-edits.json").is_file():
        known.append(EDITED)
    quick = tuple(name for name in QUICK_SCENES if name in known)
    every = frame_speed.SCENES if args.time else (quick if args.quick else known)
    args.only = args.only or every
    for name in args.only:
        if name not in known:
            parser.error(f"--only: no scene '{name}' in {args.scenes}, expected some of: "
                         + " ".join(known))


def new_report(args, benchmark, **settings):
    settings = {"scenes": scenes_digest(args.scenes), "size": args.size,
                "threads": args.threads, "options": args.options, **settings}
    versions = {key: run([program, "--version"]).strip()
                for key, program in (("before", args.before), ("after", args.weft))}
    machine = {"processor": processor(), "hardware_threads": os.cpu_count()}
    return {"benchmark": benchmark, "settings": settings, "machine": machine,
            "versions": {**versions, "python": platform.python_version()},
            "programs": {"before": args.before_digest, "after": program_digest(args.weft)}}


def cases_of(args):
    cases = all_cases(args.scenes, args.only, args.algorithms, args.backends)
    if not cases:
        raise Failure("nothing to render: these algorithms are for scenes that move", EXIT_USAGE)
    return cases


def on_all(args, cases, action, done):
    """Runs the action on all cases, several at a time, and calls `done` with each that is ready, in
    whatever order."""
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        under_way = {pool.submit(action, case): case for case in cases}
        try:
            for future in concurrent.futures.as_completed(under_way):
                done(under_way[future], future.result())
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def fill_cache(args):
    images = Images(args)
    cases = cases_of(args)
    kept = []

    def made(case):
        try:
            return images.before(case).name
        except Failure as failure:
            return f"not rendered, {failure}"

    def done(case, what):
        kept.append(case)
        print(f"[{len(kept)}/{len(cases)}] {name_of(case)}: {what}", flush=True)

    on_all(args, cases, made, done)
    return 0


def words_of(found):
    """What differs in one image."""
    if "before" in found:
        return f"before: {found['before']}; after: {found['after']}"
    if "shape" in found:
        return f"{found['picture']}: {found['shape']}"
    layers = ", ".join(f"{layer['layer']} by up to "
                       + ("something not finite" if layer["largest"] is None
                          else f"{layer['largest']:.3g}") for layer in found["layers"])
    return f"{found['picture']}: {found['pixels']} pixels differ: {layers}"


def show(args, cases, results):
    """A row for each scene and backend; what differs or is refused, below; how many differ."""
    known = {name_of(case): case for case in cases}
    width = max(len(name) for name in args.only) + 8
    print(f"\npictures that are the same, of all\n{'':{width}}"
          + "".join(f"{kind:>{cell_width(kind)}}" for kind in args.algorithms))
    for scene in args.only:
        for backend in args.backends:
            cells = [results.get(f"{scene} {kind} {backend}") for kind in args.algorithms]
            if not any(cells):
                continue
            print(f"{scene + ' ' + backend:{width}}" + "".join(
                f"{cell_words(cell):>{cell_width(kind)}}"
                for kind, cell in zip(args.algorithms, cells)))
    refused = {}
    for name in known:
        if words := results[name].get("refused"):
            refused.setdefault(words, []).append(name)
        for found in results[name]["different"]:
            print(f"{name}: {words_of(found)}")
    for words, names in refused.items():
        print(f"refused by both, {len(names)} cases: {words}")
    return totals(cases, results)


def cell_width(kind):
    return max(len(kind), len("4/4")) + 2


def cell_words(cell):
    if cell is None or "refused" in cell:
        return "-"
    return f"{cell['same']}/{cell['pictures']}"


def totals(cases, results):
    found = [results[name_of(case)] for case in cases]
    return {"cases": len(cases), "pictures": sum(cell["pictures"] for cell in found),
            "same": sum(cell["same"] for cell in found),
            "different": sum(cell["pictures"] - cell["same"] for cell in found),
            "refused_by_both": sum("refused" in cell for cell in found)}


def compare_images(args):
    report = new_report(args, "identity")
    cases = cases_of(args)
    results = earlier_results(args.json, report, args.resume)
    results = report["results"] = {name: cell for name, cell in results.items()
                                   if "failed" not in cell}
    missing = [case for case in cases if name_of(case) not in results]
    ready = len(cases) - len(missing)

    def done(case, cell):
        nonlocal ready
        ready += 1
        results[name_of(case)] = cell
        write_json(args.json, report)
        words = "refused by both" if "refused" in cell else f"{cell_words(cell)} the same"
        print(f"[{ready}/{len(cases)}] {name_of(case)}: {words}", flush=True)

    on_all(args, missing, Images(args).compared, done)
    report["summary"] = found = show(args, cases, results)
    write_json(args.json, report)
    print(f"\n{found['same']} of {found['pictures']} images are the same, "
          f"{found['different']} differ, {found['refused_by_both']} cases are refused by both")
    return DIFFERENT if found["different"] or not found["pictures"] else 0


def compare_times(args):
    report = new_report(args, "identity-time", frames=args.frames, cpu=args.cpu)
    results = report["results"] = earlier_results(args.json, report, args.resume)
    summaries = frame_speed.measure(args, results, lambda: write_json(args.json, report))
    report["summary"] = summaries
    write_json(args.json, report)
    slow = frame_speed.show(summaries)
    print(f"\n{slow} of {len(summaries)} ratios are below {frame_speed.LEAST_RATIO}")
    return DIFFERENT if slow else 0


def main():
    args = parse()
    try:
        args.before_digest = program_digest(args.before)
        if args.fill_cache:
            return fill_cache(args)
        return compare_times(args) if args.time else compare_images(args)
    except Failure as failure:
        print(f"bench identity: {failure}", file=sys.stderr)
        return failure.code if failure.code > 0 else 3
    except OSError as error:
        print(f"bench identity: {error}", file=sys.stderr)
        return EXIT_OUTPUT
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
