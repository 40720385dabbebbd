#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Runs small commands again and again, each time with another call that fails, and checks that every
run ends as promised: with exit code 0 and the right result, or with the code of its kind of failure
and one line that says what is wrong; with nothing half written, and caches that later runs can use.
Rendering that is resumed is also killed and terminated at each call; however it ended, it has to end
in the same bits when it goes on.

The calls are those of the OpenCL driver (tests/device/opencl/faulty_driver.cpp) and those on files
(faulty_files.cpp). Exit code 0: all runs end as promised, 1: some do not."""

import argparse
import concurrent.futures
import errno
import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

OUT_OF_RESOURCES, ALLOCATION_FAILURE = -5, -4
DEVICE, OUT_OF_MEMORY, BAD_INPUT, OUTPUT, INTERRUPTED = 3, 4, 2, 5, 130
LONGEST = 120  # seconds of a run


class Command:
    """A command to try: `arguments` may hold {out}, the folder that it writes to; `prepare` fills
    that folder before each run."""

    def __init__(self, name, arguments, prepare=None, results=()):
        self.name = name
        self.arguments = arguments
        self.prepare = prepare
        self.results = results  # files whose content is known beforehand


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def contents(folder):
    """What lies in a folder: digests by relative name."""
    return {str(path.relative_to(folder)): digest(path)
            for path in sorted(folder.rglob("*")) if path.is_file()}


def shapes(names):
    """Names without what depends on times that were measured: their numbers, and which presets."""
    return {re.sub(r"[0-9]+(\.[0-9]+)?", "#", name) for name in names if "/preset-" not in name}


class Sweep:
    def __init__(self, options, command, worker):
        self.options = options
        self.command = command
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix=f"{command.name}-{worker}-",
                                                    dir=options.work))
        self.cache = self.folder / "cache"
        self.out = self.folder / "out"
        self.log = self.folder / "log"
        # Kernels are compiled, and the driver tried, once for all.
        if options.caches.exists():
            shutil.copytree(options.caches, self.cache)
        self.environment = {**os.environ, "WEFT_CACHE_DIR": str(self.cache),
                            "OCL_ICD_VENDORS": str(options.vendors),
                            # Without a fault, too: drivers are tried anew where this changes.
                            "LD_PRELOAD": options.files,
                            "WEFT_FAULT_LOG": str(self.log)}
        for name in ("WEFT_FAULT", "WEFT_FAULTY_DEVICE", "WEFT_FILE_FAULT", "WEFT_FAULT_SIGNAL"):
            self.environment.pop(name, None)

    def run(self, goes_on=False, **variables):
        """One run, with what an earlier one has left where it goes on: its exit code, standard
        error, the failed calls, and what was and is there."""
        self.log.unlink(missing_ok=True)
        if not goes_on:
            shutil.rmtree(self.out, ignore_errors=True)
            self.out.mkdir()
            if self.command.prepare:
                self.command.prepare(self)
        before = contents(self.out)
        arguments = [text.replace("{out}", str(self.out)) for text in self.command.arguments]
        process = subprocess.Popen([self.options.weft, *arguments], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, start_new_session=True,
                                   env={**self.environment, **variables}, cwd=self.folder)
        try:
            out, err = process.communicate(timeout=LONGEST)
            code = process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            out, err = process.communicate()
            code = "no end"
        failed = self.log.read_text().split() if self.log.exists() else []
        return code, err.decode(errors="replace"), failed, before, contents(self.out)

    def judge_rest(self, good):
        """What is not as promised where rendering goes on from what an ended run has left."""
        code, err, _, _, after = self.run(goes_on=True)
        if code != 0 or err:
            return f"going on ends with {code}: {err.strip()[-300:]}"
        for name in self.command.results:
            if after.get(name) != good.get(name):
                return f"{name} is another one after going on"
        return None

    def judge(self, result, good, kind):
        """What is not as promised in a run; None where all is."""
        code, err, failed, before, after = result
        lines = err.splitlines()
        errors = [line for line in lines if not line.startswith("weft: warning")]
        if code == 0:
            for name in self.command.results:
                if after.get(name) != good.get(name):
                    return f"exit code 0, but {name} is not what it should be"
            if shapes(after) != shapes(good):
                return f"exit code 0, but these files: {sorted(after)}"
            if errors:
                return f"exit code 0, but it says: {errors[0]}"
            return None
        # A call that fails is no crash.
        if code not in kind.codes or "crashed" in err:
            return f"exit code {code}: {err.strip()[-300:]}"
        if kind.ends:
            return None
        if len(errors) != 1 or not errors[0].startswith("weft: "):
            return f"exit code {code} with {len(errors)} lines: {err.strip()[-300:]}"
        for name, content in after.items():
            # Whole files of this run may stay; others must be as they were.
            if before.get(name) != content and good.get(name) != content and \
                    name in self.command.results:
                return f"exit code {code}, but {name} is neither the old nor the new one"
            if not shapes([name]) <= shapes([*good, *before]):
                return f"exit code {code}, but it leaves {name}"
        for name in before:
            if name not in after:
                return f"exit code {code}, but {name} is gone"
        return None


def sweep(options, command, kind, worker, workers, report):
    """Fails calls worker, worker + workers ...; returns their number."""
    run = Sweep(options, command, worker)
    result = run.run()
    if result[0] != 0:
        raise RuntimeError(f"{command.name} fails without a fault: {result[1]}")
    good = result[4]
    points = 0
    number = 1 + worker * options.stride
    while True:
        result = run.run(**kind.variables(number, run))
        if not result[2]:
            break  # there are no more calls
        points += 1
        wrong = run.judge(result, good, kind)
        if not wrong and result[0] != 0 and command.prepare:
            wrong = run.judge_rest(good)
        if wrong:
            report(f"{command.name}, call {number} ({', '.join(result[2][:3])}): {wrong}")
        if result[0] != 0 and points % 50 == 0:
            again = run.run()
            if again[0] != 0 or any(again[4].get(n) != good.get(n) for n in command.results):
                report(f"{command.name}, after call {number}: the next run fails: {again[1]}")
        number += workers * options.stride
    again = run.run()
    if again[0] != 0:
        report(f"{command.name}: what faults have left makes the next run fail: {again[1]}")
    shutil.rmtree(run.folder, ignore_errors=True)
    return points


class Kind:
    """A kind of fault: `variables` of the environment make call `number` of a run fail, which then
    ends with one of `codes`. Where `ends`, a signal ends it."""

    def __init__(self, variables, codes, ends=False):
        self.variables = variables
        self.codes = codes
        self.ends = ends


def driver_call(**given):
    return lambda number, _: {"WEFT_FAULT": f"fail={number}", **given}


def file_call(for_good=False, **given):
    return lambda number, run: {"WEFT_FILE_FAULT": f"{number}{'+' if for_good else ''}",
                                "WEFT_FAULT_FOLDER": str(run.folder), **given}


def kinds_of_faults():
    """Those of every command, and those of commands that are resumed, by name."""
    driver_codes = (DEVICE, OUT_OF_MEMORY)
    file_codes = (BAD_INPUT, DEVICE, OUTPUT, OUT_OF_MEMORY)
    full, broken = ({"WEFT_FAULT_ERROR": str(code)} for code in (errno.ENOSPC, errno.EIO))
    all_kinds = {
        "driver": Kind(driver_call(WEFT_FAULT_CODE=str(OUT_OF_RESOURCES)), driver_codes),
        "driver memory": Kind(driver_call(WEFT_FAULT_CODE=str(ALLOCATION_FAILURE)), driver_codes),
        "files, disk full": Kind(file_call(**full), file_codes),
        "files, disk full for good": Kind(file_call(for_good=True, **full), file_codes),
        "files, broken disk": Kind(file_call(**broken), file_codes)}
    ends = {}
    # Before there is anything to keep, the signal itself ends the program.
    for name, number, codes in (("killed", signal.SIGKILL, (-signal.SIGKILL,)),
                                ("terminated", signal.SIGTERM, (INTERRUPTED, -signal.SIGTERM))):
        given = {"WEFT_FAULT_SIGNAL": str(int(number))}
        ends[f"driver, {name}"] = Kind(driver_call(**given), codes, ends=True)
        ends[f"files, {name}"] = Kind(file_call(**given), codes, ends=True)
    return all_kinds, ends


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--weft", required=True, help="the program")
    parser.add_argument("--driver", required=True, help="the library of faulty_driver.cpp")
    parser.add_argument("--files", required=True, help="the library of faulty_files.cpp")
    parser.add_argument("--scene", required=True)
    parser.add_argument("--stride", type=int, default=1, help="fails only every so many calls")
    parser.add_argument("--workers", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", default="", help="commands and kinds whose name contains this")
    return parser.parse_args(arguments)


def main():
    options = parse(sys.argv[1:])
    for name in ("weft", "driver", "files", "scene"):
        setattr(options, name, os.path.abspath(getattr(options, name)))
    options.work = tempfile.mkdtemp(prefix="weft-faults-")
    options.vendors = pathlib.Path(options.work) / "vendors"
    options.vendors.mkdir()
    (options.vendors / "faulty.icd").write_text(options.driver + "\n")
    options.caches = pathlib.Path(options.work) / "caches"
    place = ["--backend", "opencl", "--progress", "none"]
    size = ["--size", "16x16"]
    first = pathlib.Path(options.work) / "first.exr"
    made = subprocess.run([options.weft, "render", options.scene, *size, *place, "--algorithm",
                           "path", "--spp", "2", "--resume", str(first), "-o",
                           str(first.with_name("image.exr"))], check=False)
    if made.returncode != 0:
        return 1
    commands = [
        Command("render", ["render", options.scene, *size, *place, "--spp", "1", "--algorithm",
                           "ais", "-o", "{out}/image.exr"], results=("image.exr",)),
        Command("resume", ["render", options.scene, *size, *place, "--spp", "4", "--algorithm",
                           "path", "--resume", "{out}/sums.exr", "-o", "{out}/image.exr"],
                prepare=lambda run: shutil.copy(first, run.out / "sums.exr"),
                results=("image.exr", "sums.exr")),
        Command("tradeoff", ["tradeoff", options.scene, *size, *place, "--quick", "--algorithms",
                             "path", "--repetitions", "2", "--reference-spp", "2", "--references",
                             "{out}/references", "-o", "{out}/tradeoff"]),
    ]
    kinds, ends = kinds_of_faults()
    failures = []
    lock = threading.Lock()

    def report(text):
        with lock:
            failures.append(text)
            print("NOT AS PROMISED", text, flush=True)

    total = 0
    for command in commands:
        first_run = Sweep(options, command, "first")
        result = first_run.run()
        if result[0] != 0:
            print(f"{command.name} fails without a fault: {result[1]}")
            return 1
        shutil.rmtree(options.caches, ignore_errors=True)
        shutil.copytree(first_run.cache, options.caches)
        for name, kind in {**kinds, **(ends if command.prepare else {})}.items():
            if options.only not in f"{command.name}: {name}":
                continue
            with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
                points = sum(pool.map(
                    lambda worker: sweep(options, command, kind, worker, options.workers,
                                         lambda text: report(f"{name}: {text}")),
                    range(options.workers)))
            total += points
            if points == 0:
                report(f"{command.name}: {name}: no call has been failed, so nothing was tested")
            print(f"{command.name}: {name}: {points} points", flush=True)
    shutil.rmtree(options.work, ignore_errors=True)
    if total == 0:
        report(f"there is no kind of fault that contains {options.only!r}")
    print(f"{total} points, {len(failures)} not as promised")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
