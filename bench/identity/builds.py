# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Two builds of Weft: how they are run, and the files that a benchmark of both keeps."""

import hashlib
import json
import os
import pathlib
import resource
import subprocess

EXIT_USAGE, EXIT_INPUT, EXIT_OUTPUT = 1, 2, 5  # as Weft's other programs say
EDITS = "+edits"  # ends the name of a scene to which things happen over its frames
HOURS = 3600


class Failure(Exception):
    """What a program says when it fails, and its exit code."""

    def __init__(self, text, code):
        super().__init__(text)
        self.code = code


def run(command, environment=None):
    """Runs a program; its standard output. Raises Failure with the last line that it says."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                              check=False, timeout=HOURS, errors="replace",
                              env={**os.environ, **(environment or {})})
    except OSError as error:
        raise Failure(f"{command[0]}: {error.strerror}, expected a program", EXIT_USAGE) from error
    except subprocess.TimeoutExpired as error:
        raise Failure(f"{command[0]}: took longer than an hour", 3) from error
    if done.returncode != 0:
        said = (done.stderr.strip().splitlines() or ["ended without a word"])[-1]
        raise Failure(said, done.returncode)
    return done.stdout


def processor_ms():
    """Of all programs that have been run and have ended, and theirs."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1000.0 * (used.ru_utime + used.ru_stime)


def digest(parts):
    """Of texts and bytes, in hexadecimal."""
    hashed = hashlib.sha256()
    for part in parts:
        data = part if isinstance(part, bytes) else str(part).encode()
        hashed.update(len(data).to_bytes(8, "little") + data)
    return hashed.hexdigest()[:20]


def program_digest(path):
    """Of the program itself: kernels are part of it, so that it says what it computes."""
    try:
        return digest([pathlib.Path(path).read_bytes()])
    except OSError as error:
        raise Failure(f"{path}: {error.strerror}, expected a program", EXIT_USAGE) from error


def scene_path(folder, name):
    return folder / f"{name.removesuffix(EDITS)}.gltf"


def scene_options(folder, name):
    """What of the command line says which scene it is."""
    if name.endswith(EDITS):
        return [scene_path(folder, name), "--edits", folder / "cornell-box-edits.json"]
    return [scene_path(folder, name)]


def write_json(path, value):
    part = path.with_name(path.name + ".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")
        os.replace(part, path)
    except OSError as error:
        raise Failure(f"{path}: {error.strerror}, expected a file that can be written",
                      EXIT_OUTPUT) from error


def earlier_results(path, report, resume):
    """The results of the run that the file holds; none where that was of other programs. Raises
    Failure where its scenes or settings were others."""
    if not resume or not path.exists():
        return {}
    try:
        earlier = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise Failure(f"{path}: is no JSON ({error})", EXIT_INPUT) from error
    if not isinstance(earlier, dict) or not isinstance(earlier.get("results"), dict):
        raise Failure(f"{path}: is no report of bench identity, expected one", EXIT_INPUT)
    for key in ("benchmark", "settings"):
        if earlier.get(key) != report[key]:
            raise Failure(f"{path}: is of a run with another {key}, expected the same as now",
                          EXIT_USAGE)
    # A program that was built anew makes all results old.
    same = earlier.get("programs") == report["programs"]
    return earlier["results"] if same else {}
