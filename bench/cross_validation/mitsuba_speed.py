#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Mitsuba 3 as a candidate of `bench path`, which starts this program and talks to it.

    mitsuba_speed.py VARIANT SCENE.xml SIZE SAMPLES THREADS

Loads the scene and writes `READY version`. Then, for every line it reads, it renders once and
writes `seconds processor-seconds mean-of-the-image`. Ends with its input. Where something fails
it writes `ERROR text`.
"""

import os
import sys
import time


def serve(answers):
    import mitsuba as mi
    import drjit as dr
    import numpy as np
    from mitsuba_scene import load_scene

    variant, path, size, samples, threads = sys.argv[1:]
    if int(threads) > 0:
        dr.set_thread_count(int(threads))
    mi.set_variant(variant)
    scene = load_scene(mi, path, int(size))
    print("READY", mi.__version__, file=answers)
    for seed, _ in enumerate(sys.stdin, 1):
        begin, processor = time.perf_counter(), time.process_time()
        # Copying waits for variants that only record what is to be done.
        image = np.array(mi.render(scene, spp=int(samples), seed=seed))
        seconds, processor = time.perf_counter() - begin, time.process_time() - processor
        mean = image[..., :3].astype(np.float64).mean()
        print(f"{seconds:.9g} {processor:.9g} {mean:.9g}", file=answers)


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
