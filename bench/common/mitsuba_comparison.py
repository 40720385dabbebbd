# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Images of one scene by Weft and by Mitsuba 3, with their variances, and tests of whether they agree.

Importing this needs Python packages mitsuba and numpy; where they are missing it ends the program.
"""

import json
import math
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile

from mitsuba_scene import import_or_exit, load_scene
from processor import processor

PROGRAM = f"bench {pathlib.Path(sys.argv[0]).stem}"

mi, np, dr = import_or_exit(PROGRAM, "mitsuba", "numpy", "drjit")

ALPHA = 0.01  # of the whole image; Sidak-corrected over its pixels
ACCEPTED_SHARE = 0.9975
EXIT_OUTPUT = 5  # as Weft's other programs say


def normal_quantile(p):
    return statistics.NormalDist().inv_cdf(p)


def layers(path):
    """The layers of an image by name, the image itself as ''."""
    threads = dr.thread_count()
    dr.set_thread_count(max(threads, 2))  # Mitsuba's EXR reader waits forever with one
    bitmap = mi.Bitmap(str(path))
    dr.set_thread_count(threads)
    values = np.array(bitmap, dtype=np.float64)
    found = {}
    for index, field in enumerate(bitmap.struct_()):
        name, _, _ = field.name.rpartition(".")
        found.setdefault(name, []).append(values[..., index])
    found = {name: np.stack(planes, axis=-1) for name, planes in found.items()}
    found[""] = found[""][..., :3]  # without alpha
    return found


def render_weft(program, scene, samples, size, seed=0, algorithm="path", backend="native",
                threads=0, options=()):
    """The layers of an image by Weft. Where it fails, so does this program."""
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "ours.exr")
        command = [program, "render", scene, "-o", output, "--algorithm", algorithm,
                   "--seed", seed, "--spp", samples, "--size", f"{size}x{size}",
                   "--backend", backend, "--progress", "none", *options]
        if threads:
            command += ["--threads", threads]
        done = subprocess.run([str(word) for word in command], stderr=subprocess.PIPE, check=False)
        if done.returncode != 0:
            sys.stderr.buffer.write(done.stderr)
            sys.exit(done.returncode)
        return layers(output)


class Mitsuba:
    """A scene in Mitsuba."""

    def __init__(self, path, size, max_depth=-1, **parameters):
        self.scene = load_scene(mi, path, size, max_depth, **parameters)
        self.seed = 1

    def render(self, samples):
        image = np.array(mi.render(self.scene, spp=samples, seed=self.seed), dtype=np.float64)
        self.seed += 1
        return image[..., :3]

    def estimate(self, samples, passes):
        """Mean of `passes` images of `samples` samples each, and its variance."""
        total = squares = 0.0
        for _ in range(passes):
            image = self.render(samples)
            total = total + image
            squares = squares + image * image
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


def mean_test(ours, our_variance, theirs, their_variance, parts=()):
    """Bias of our mean against theirs, and its standard error, both relative. `parts` are the
    independent images that ours is the mean of, where its pixels share noise."""
    scale = theirs.mean()
    bias = ours.mean() / scale - 1.0
    # Channels of a pixel come from the same paths: their errors add up, not their variances.
    variance = their_variance if len(parts) else our_variance + their_variance
    deviation = np.sqrt(variance).sum(axis=-1)
    square = (deviation * deviation).sum() / (ours.size * ours.size)
    if len(parts):
        square += np.var([part.mean() for part in parts], ddof=1) / len(parts)
    return float(bias), float(math.sqrt(square) / scale)


def choose_variant(variant, threads):
    """Whether Mitsuba has it; sets it and the number of threads, 0 for all."""
    if variant not in mi.variants():
        print(f"{PROGRAM}: Mitsuba has no variant '{variant}', expected one of: "
              + " ".join(mi.variants()), file=sys.stderr)
        return False
    if threads > 0:
        dr.set_thread_count(threads)
    mi.set_variant(variant)
    return True


def weft_version(program):
    shown = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    return shown.stdout.strip()


def write_report(args, results, summary):
    """Writes args.json: machine, versions, results and summary; whether that worked."""
    machine = {"processor": processor(), "hardware_threads": os.cpu_count(),
               "threads": args.threads}
    versions = {"mitsuba": mi.__version__, "variant": mi.variant(), "numpy": np.__version__,
                "python": platform.python_version(), "weft": weft_version(args.weft)}
    report = {"benchmark": PROGRAM.removeprefix("bench "), "quick": args.quick, "machine": machine,
              "versions": versions, "results": results, "summary": summary}
    try:
        pathlib.Path(args.json).write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        print(f"{PROGRAM}: {args.json}: {error.strerror}", file=sys.stderr)
        return False
    return True
