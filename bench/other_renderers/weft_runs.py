# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Weft as one of the renderers: its images, its references, and what it measures of images."""

import hashlib
import json
import os
import pathlib
import re
import subprocess
import tempfile
import time

from equal_time import Renderer

PATIENCE_SECONDS = 24 * 3600
REFERENCE_SEED = 77  # of the references that Weft's other benchmarks keep
HALF_SEEDS = (4242, 4243)  # of those that are made here
IDENTITY = re.compile(rb"weft\.picture\0string\0\x10\0\0\0([0-9a-f]{16})")
HEADER_BYTES = 1 << 16
OWN_SETTINGS = {"Weft path": ["--algorithm", "path"],
                "Weft ais draft": ["--algorithm", "ais", "--quality", "draft"],
                "Weft ais preview": ["--algorithm", "ais", "--quality", "preview"],
                "Weft ais high": ["--algorithm", "ais", "--quality", "high"]}


class Failure(Exception):
    """What a program says when it fails, and the exit code of the benchmark then."""

    def __init__(self, text, code):
        super().__init__(text)
        self.code = code


def run(command):
    """Runs a program of Weft's; its standard output. Raises Failure with what it says."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                              check=False, timeout=PATIENCE_SECONDS)
    except OSError as error:
        raise Failure(f"{command[0]}: {error.strerror}, expected a program", 1) from error
    if done.returncode != 0:
        said = (done.stderr.strip().splitlines() or ["ended without a word"])[-1]
        raise Failure(said, done.returncode if done.returncode > 0 else 3)
    return done.stdout


class Weft(Renderer):
    """Images are files here; they are overwritten by the next of the same name."""

    def __init__(self, args, name, options, scene, folder):
        self.args, self.name, self.options = args, name, options
        self.scene, self.folder = scene, folder

    def render(self, samples, seed):
        file = self.folder / f"{self.name}-{samples}-{seed}.exr".lower().replace(" ", "-")
        stats = self.folder / "stats.json"
        run(render_command(self.args, self.scene, file) + self.options
            + ["--spp", samples, "--seed", seed, "--stats", stats])
        told = json.loads(stats.read_text(encoding="utf-8"))
        # What is read and built before, and writing the file after, is left out for all alike.
        ms = sum(frame["ms"] for frame in told["frames"]) + told["times"]["correct_ms"]
        return file, ms / 1000.0


def render_command(args, scene, output):
    command = [args.weft, "render", scene, "-o", output, "--progress", "none", "--size",
               f"{args.size}x{args.size}"]
    if args.threads:
        command += ["--threads", args.threads]
    if args.backend:
        command += ["--backend", args.backend]
    if args.environment:
        command += ["--environment", args.environment]
    return command


def folder_digest(folder):
    """Of all files of an exported scene: images of it depend on nothing else."""
    digest = hashlib.sha256()
    for file in sorted(folder.iterdir()):
        digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()[:12]


def image_identity(args, scene):
    """What Weft calls the image that references of a scene show; it is told by the sums of a
    single sample."""
    with tempfile.TemporaryDirectory() as folder:
        sums = os.path.join(folder, "sums.exr")
        run(render_command(args, scene, os.path.join(folder, "picture.exr"))
            + ["--algorithm", "path", "--spp", 1, "--seed", REFERENCE_SEED, "--resume", sums])
        with open(sums, "rb") as file:
            found = IDENTITY.search(file.read(HEADER_BYTES))
    return found and found[1].decode("ascii")


def kept_reference(args, scene):
    """The reference with the most samples, at least as many as wished, of exactly this image
    among those that Weft's other benchmarks keep, or None."""
    names = re.compile(re.escape(f"{scene.name}-{args.size}x{args.size}-box-")
                       + r"([0-9]+)-([0-9a-f]{16})\.exr")
    found = [(int(match[1]), match[2], file) for file in args.references.iterdir()
             if (match := names.fullmatch(file.name)) and int(match[1]) >= args.reference_spp]
    if not found:
        return None
    identity = image_identity(args, scene)
    return max((entry for entry in found if entry[1] == identity), default=(0, "", None))[2]


class Reference:
    """The image to compare with, and the independent halves that it is the mean of, if it is."""

    def __init__(self, file, halves=()):
        self.file, self.halves = pathlib.Path(file), tuple(halves)


def reference(args, scene, export):
    """The path-traced image to compare with; those that are made are kept in --references, as two
    halves and their mean, under names that hold everything they depend on."""
    if args.reference:
        return Reference(args.reference)
    args.references.mkdir(parents=True, exist_ok=True)
    if kept := kept_reference(args, scene):
        print(f"{scene.name}: {kept.name} is kept, without halves: no unbiased relMSE", flush=True)
        return Reference(kept)
    name = f"{scene.stem}-{args.size}x{args.size}-{args.reference_spp}-{folder_digest(export)}"
    halves = [args.references / f"{name}-half{number}.exr" for number in (1, 2)]
    mean = args.references / f"{name}-halves.exr"
    begin = time.monotonic()
    for file, seed in zip(halves, HALF_SEEDS):
        if not file.is_file():
            part = args.references / f"{file.stem}.part.exr"
            run(render_command(args, scene, part) + ["--algorithm", "path", "--spp",
                                                     (args.reference_spp + 1) // 2, "--seed", seed])
            os.replace(part, file)
    if not mean.is_file():
        part = args.references / f"{mean.stem}.part.exr"
        run([*args.half_errors, *halves, "--mean", part])
        os.replace(part, mean)
        print(f"reference of {scene.name}: two halves of {(args.reference_spp + 1) // 2} samples "
              f"in {time.monotonic() - begin:.0f} s", flush=True)
    return Reference(mean, halves)


def measured(args, image, against, errors):
    metrics = [word for metric in ("mean_ratio", *errors) for word in ("--metric", metric)]
    found = json.loads(run([args.weft, "compare", against, image, "--json", *metrics]))
    if "hdrflip" in errors:
        found["hdrflip"] = found["hdrflip"]["mean"]
    return {metric: found[metric] for metric in ("mean_ratio", *errors)}


def compare(args, image, against, errors):
    """The ratio of the means of an image and the reference, and errors: of "hdrflip", "relmse".
    With the latter also `relmse_unbiased` and the 95 % `relmse_interval` on either side of it, where
    the reference has halves."""
    found = measured(args, image, against.file, errors)
    if "relmse" in errors:
        found |= {"relmse_unbiased": None, "relmse_interval": None}
    if "relmse" in errors and against.halves:
        error, = json.loads(run([*args.half_errors, *against.halves, image]))
        found |= {"relmse_unbiased": error["relmse"], "relmse_interval": error["interval"]}
    return found


def floor(args, against):
    """HDR-FLIP between the halves: errors about as small are those of the reference. None without
    halves."""
    if not against.halves:
        return None
    return measured(args, against.halves[1], against.halves[0], ["hdrflip"])["hdrflip"]
