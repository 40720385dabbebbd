#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Mitsuba 3 as a candidate of `bench path`, which starts this program and talks to it.

    mitsuba_speed.py VARIANT LIBRARY SCENE.xml SIZE SAMPLES THREADS IMAGE

LIBRARY is the LLVM library of vectorised variants, or empty. Loads the scene and writes `READY
version`. Then, for every seed it reads, one a line, it renders once, in one launch, writes the image
to the file IMAGE, as 32-bit floats of all red values, then all green and all blue ones, the top row
first, and answers `seconds processor-seconds`. Ends with its input. Where something fails it writes
`ERROR text`.
"""

import os
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))


def serve(answers):
    variant, library, path, size, samples, threads, output = sys.argv[1:]
    if library:
        os.environ["DRJIT_LIBLLVM_PATH"] = library  # read when Dr.Jit is loaded
    import mitsuba as mi
    import drjit as dr
    import numpy as np
    from mitsuba_scene import load_scene

    if int(threads) > 0:
        dr.set_thread_count(int(threads))
    mi.set_variant(variant)
    scene = load_scene(mi, path, int(size))
    print("READY", mi.__version__, file=answers)
    for line in sys.stdin:
        begin, processor = time.perf_counter(), time.process_time()
        # Copying waits for variants that only record what is to be done.
        image = np.array(mi.render(scene, spp=int(samples), seed=int(line)))
        seconds, processor = time.perf_counter() - begin, time.process_time() - processor
        planes = np.moveaxis(image[..., :3], -1, 0)
        np.ascontiguousarray(planes, dtype="<f4").tofile(output)
        print(f"{seconds:.9g} {processor:.9g}", file=answers)


def main():
    # Whatever libraries print goes elsewhere: standard output belongs to the other program.
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    try:
        serve(answers)
    except Exception as error:  # whatever it is, the other program goes on without this one
        text = " ".join(str(error).split())[:200]
        print(f"ERROR {type(error).__name__}: {text}", file=answers)
        sys.exit(1)


if __name__ == "__main__":
    main()
