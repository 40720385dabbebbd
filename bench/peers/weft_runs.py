# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Weft as one of the renderers: its pictures, its references, and what it measures of pictures."""

import hashlib
import json
import os
import subprocess
import time

from equal_time import Peer

PATIENCE_SECONDS = 24 * 3600
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


class Weft(Peer):
    """Pictures are files here; they are overwritten by the next of the same name."""

    def __init__(self, args, name, options, scene, folder):
        self.args, self.name, self.options = args, name, options
        self.scene, self.folder = scene, folder

    def render(self, samples, seed):
        file = self.folder / f"{self.name}-{samples}-{seed}.exr".lower().replace(" ", "-")
        stats = self.folder / "stats.json"
        run(render_command(self.args, self.scene, file) + self.options
            + ["--spp", samples, "--seed", seed, "--stats", stats])
        frames = json.loads(stats.read_text(encoding="utf-8"))["frames"]
        # What is read and built before, and writing the file after, is left out for all alike.
        return file, sum(frame["ms"] for frame in frames) / 1000.0


def render_command(args, scene, output):
    command = [args.weft, "render", scene, "-o", output, "--progress", "none", "--size",
               f"{args.size}x{args.size}"]
    if args.threads:
        command += ["--threads", args.threads]
    if args.backend:
        command += ["--backend", args.backend]
    return command


def folder_digest(folder):
    """Of all files of an exported scene: pictures of it depend on nothing else."""
    digest = hashlib.sha256()
    for file in sorted(folder.iterdir()):
        digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()[:12]


def reference(args, scene, export):
    """The path-traced picture to compare with; kept in --references under a name that holds
    everything it depends on."""
    if args.reference:
        return args.reference
    args.references.mkdir(parents=True, exist_ok=True)
    name = f"{scene.stem}-{args.size}x{args.size}-{args.reference_spp}-{folder_digest(export)}"
    file = args.references / f"{name}.exr"
    if not file.is_file():
        begin = time.monotonic()
        part = args.references / f"{name}.part.exr"
        run(render_command(args, scene, part) + ["--algorithm", "path", "--spp",
                                                 args.reference_spp, "--seed", 4242])
        os.replace(part, file)
        print(f"reference of {scene.name}: {args.reference_spp} samples in "
              f"{time.monotonic() - begin:.0f} s", flush=True)
    return file


def compare(args, picture, against):
    """HDR-FLIP and the ratio of the means, of a picture and the reference."""
    found = json.loads(run([args.weft, "compare", against, picture, "--json", "--metric",
                            "hdrflip", "--metric", "relmse", "--metric", "mean_ratio"]))
    return {"hdrflip": found["hdrflip"]["mean"], "mean_ratio": found["mean_ratio"],
            "relmse": found["relmse"]}
