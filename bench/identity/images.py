# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The images that two builds are compared by, and where those of the build before are kept."""

import collections
import json
import os
import pathlib
import shutil
import tempfile

from builds import EDITS, EXIT_INPUT, Failure, digest, run, scene_options, scene_path
from exr_pixels import NotReadable, compare

FRAMES = ["--frames", "0:4"]
MANY = ["--spp", "2"]
# What is compared, by name. `tic` and whatever else has frames is for scenes that move.
KINDS = {
    "ais": ["--algorithm", "ais", *MANY],
    "amax": ["--algorithm", "amax", *MANY],
    "igi": ["--algorithm", "igi", *MANY],
    "ir": ["--algorithm", "ir", *MANY],
    "ic": ["--algorithm", "ic", *MANY],
    "path": ["--algorithm", "path", "--spp", "4"],
    "tic": ["--algorithm", "tic", *FRAMES],
}
# Whatever else has kernels or a path of its own.
MORE_KINDS = {
    "irradiance-cache": ["--algorithm", "irradiance-cache", *MANY],
    "residual": ["--algorithm", "ais", "--vpl-compensation", *MANY],
    "occlusion": ["--components", "direct,indirect,media,occlusion", *MANY],
    "high": ["--quality", "high", "--spp", "1"],
    "ais-ic": ["--indirect", "ic", *MANY],
    "ais-tic": ["--indirect", "tic", *FRAMES],
    "ais-moving": ["--algorithm", "ais", *FRAMES],
    "path-centre": ["--algorithm", "path", "--pixel-filter", "centre", "--spp", "4"],
}
SCENE_FILES = (".gltf", ".bin", ".png", ".vol", ".json")
BACKENDS = ("opencl", "native", "embree")
REFUSALS = (1, 2)  # exit codes of what a scene or an algorithm does not go with

Case = collections.namedtuple("Case", "scene kind backend")


def name_of(case):
    return " ".join(case)


def moves(folder, scene):
    """Whether a scene has frames that differ."""
    if scene.endswith(EDITS):
        return True
    try:
        return bool(json.loads(scene_path(folder, scene).read_text(encoding="utf-8"))
                    .get("animations"))
    except ValueError as error:
        raise Failure(f"{scene_path(folder, scene)}: is no JSON ({error})", EXIT_INPUT) from error


def all_cases(folder, scenes, kinds, backends):
    """Scene by scene, and in each backend by backend. Edits are for images with frames."""
    known = {**KINDS, **MORE_KINDS}
    return [Case(scene, kind, backend) for scene in scenes for backend in backends
            for kind in kinds
            if (moves(folder, scene) if "--frames" in known[kind] else not scene.endswith(EDITS))]


def scenes_digest(folder):
    """Of all files that scenes are made of."""
    return digest(part for file in sorted(folder.iterdir()) if file.suffix in SCENE_FILES
                  for part in (file.name, file.read_bytes()))


class Images:
    """Renders the images of cases, in the settings of a run."""

    def __init__(self, args):
        self.args = args
        self.scenes_digest = scenes_digest(args.scenes)

    def options(self, case):
        """All that decides what an image shows, but for the scene."""
        return [*{**KINDS, **MORE_KINDS}[case.kind], "--backend", case.backend, "--size",
                f"{self.args.size}x{self.args.size}", *self.args.options]

    def render(self, program, case, folder):
        command = [program, "render", *scene_options(self.args.scenes, case.scene),
                   "-o", folder / "picture.exr", "--progress", "none", *self.options(case)]
        run(command + (["--threads", self.args.threads] if self.args.threads else []))

    def kept_folder(self, case):
        """Of the images of the build before: they depend on nothing else than its name says."""
        key = digest([self.scenes_digest, case.scene, *self.options(case)])
        return self.args.cache / self.args.before_digest / f"{'-'.join(case)}-{key}"

    def before(self, case):
        """The folder of the images of the build before, made where it is missing. Raises
        Failure."""
        kept = self.kept_folder(case)
        if kept.is_dir():
            return kept
        kept.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=kept.parent) as folder:
            made = pathlib.Path(folder) / kept.name
            made.mkdir()
            self.render(self.args.before, case, made)
            if not kept.is_dir():  # another run may have been faster
                os.rename(made, kept)
        return kept

    def compared(self, case):
        """What a report holds of a case: `pictures`, how many are the `same`, and what is
        `different`. Images after that differ are kept in the output folder."""
        before, said_before = attempt(lambda: self.before(case))
        with tempfile.TemporaryDirectory() as name:
            after = pathlib.Path(name)
            _, said_after = attempt(lambda: self.render(self.args.weft, case, after))
            if said_before or said_after:
                return refused(said_before, said_after)
            result = compared_folders(before, after)
            if result["different"]:
                kept = self.args.output / "-".join(case)
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(after, kept)
        return result


def attempt(action):
    """What an action returns and nothing, or nothing and how it failed."""
    try:
        return action(), None
    except Failure as failure:
        return None, failure


def refused(before, after):
    """Of a case that at least one build does not render. It is the same only where both say that
    this is not for the scene; any other failure counts as a difference, and is tried again."""
    if before and after and before.code in REFUSALS and str(before) == str(after):
        return {"pictures": 0, "same": 0, "refused": str(before), "different": []}
    words = {key: f"{failure} (exit code {failure.code})" if failure else "renders it"
             for key, failure in (("before", before), ("after", after))}
    return {"pictures": 1, "same": 0, "failed": True, "different": [words]}


def compared_folders(before, after):
    names = sorted({file.name for folder in (before, after) for file in folder.iterdir()})
    different = []
    for name in names:
        try:
            found = compare(before / name, after / name)
        except (NotReadable, OSError) as error:
            found = {"shape": str(error)}
        if found:
            different.append({"picture": name, **found})
    return {"pictures": len(names), "same": len(names) - len(different), "different": different}
