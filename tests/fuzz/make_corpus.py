#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the seeds of every fuzz target: small files that use every feature of a format.

    tests/fuzz/make_corpus.py [FOLDER]

FOLDER is tests/fuzz/corpus unless given. The same files come out every time. A name that begins
with `bad` is one that a reader refuses.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # the source folder is no place for it

import corpus_gltf
import corpus_grids
import corpus_json
import corpus_mitsuba
import corpus_images
import corpus_text


def main():
    here = pathlib.Path(__file__).resolve().parent
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "corpus"
    makers = {
        "gltf": corpus_gltf.files,
        "mitsuba": corpus_mitsuba.files,
        "vol": corpus_grids.vol_files,
        "nanovdb": corpus_grids.nanovdb_files,
        "ply": corpus_text.ply_files,
        "obj": corpus_text.obj_files,
        "options": corpus_text.option_files,
        "preset": corpus_json.preset_files,
        "view": corpus_json.view_files,
        "peers": corpus_json.peer_files,
        "image": corpus_images.image_files,
        "exr": corpus_images.exr_files,
        "hdr": corpus_images.hdr_files,
        "png": corpus_images.png_files,
    }
    total = 0
    for name, make in makers.items():
        target = folder / name
        target.mkdir(parents=True, exist_ok=True)
        files = make()
        for old in target.iterdir():
            if old.name not in files:
                old.unlink()
        for file_name, content in files.items():
            data = content.encode() if isinstance(content, str) else content
            (target / file_name).write_bytes(data)
            total += len(data)
    print(f"{total} bytes")


if __name__ == "__main__":
    main()
