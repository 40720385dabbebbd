#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Renders a reference in parts on the workers of a Dask cluster, which runs again what fails, and
joins them. The workers and this program share the folder of the parts.

    python3 farm/dask_reference.py scene.gltf --spp 4096 --parts 32 -o reference.exr \
        --scheduler tcp://host:8786 -- --size 1280x720

Without --scheduler it starts a worker with one thread on this machine."""

import argparse
import contextlib
import os
import pathlib
import shutil
import subprocess
import sys

from dask.distributed import Client, LocalCluster

FARM = pathlib.Path(__file__).resolve().parent


def render(part, parts, spp, scene, folder, options, weft):
    """Part `part`, on a worker. A failure is an error, which Dask answers by another try."""
    environment = dict(os.environ, **({"WEFT": weft} if weft else {}))
    command = ["bash", str(FARM / "part.sh"), *map(str, (part, parts, spp, scene, folder)),
               *options]
    done = subprocess.run(command, check=False, stderr=subprocess.PIPE, text=True,
                          env=environment)
    if done.returncode != 0:
        raise RuntimeError(f"part {part} ended with {done.returncode}: {done.stderr.strip()}")
    return part


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--spp", type=int, required=True)
    parser.add_argument("--parts", type=int, required=True)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("parts"))
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--scheduler", help="address of a scheduler")
    # What this program does not know is for weft render.
    given, options = parser.parse_known_args()
    options = [option for option in options if option != "--"]
    scene, folder = given.scene.resolve(), given.folder.resolve()
    # Workers on other machines have an environment of their own.
    weft = os.environ.get("WEFT")
    weft = weft and str(pathlib.Path(shutil.which(weft) or weft).resolve())
    with contextlib.ExitStack() as open_until_done:
        cluster = given.scheduler or open_until_done.enter_context(
            LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None))
        client = open_until_done.enter_context(Client(cluster))
        parts = client.map(render, range(1, given.parts + 1), parts=given.parts, spp=given.spp,
                           scene=scene, folder=folder, options=options, weft=weft,
                           retries=3, pure=False)
        client.gather(parts)
    return subprocess.run(["bash", str(FARM / "merge.sh"), str(given.parts), str(given.spp),
                           str(folder), str(given.output)], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
