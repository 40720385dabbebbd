#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the variant of Mitsuba 3 to compare with, and the LLVM library that it works with.

    mitsuba_variant.py [--variant NAME]
    mitsuba_variant.py --prove NAME

The first writes one line of JSON: `variant`, the LLVM `library` ("" for none, or the one that
Dr.Jit finds), `version` of Mitsuba and `llvm`, and in `failed` what did not work, or `problem` where
nothing does. llvm_ad_rgb compiles each scene's kernels with a library that is loaded from where
DRJIT_LIBLLVM_PATH says; where that is set, no other is tried, else all that are installed, the newest
first. scalar_rgb is taken where none works: it is slower, but needs no compiler.

The second proves a variant by a small image, in a process of its own because a library that is too
old for the processor ends the process.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

VECTORISED, SCALAR = "llvm_ad_rgb", "scalar_rgb"
LIBRARY = "DRJIT_LIBLLVM_PATH"
FOLDERS = ("/usr/local/lib", "/usr/lib", "/usr/lib64", "/usr/lib/*-linux-gnu", "/usr/lib/llvm-*/lib",
           "/usr/lib/llvm/*/lib*", "/usr/local/lib/llvm-*/lib")
# Debian's names: libLLVM-15.so.1, libLLVM-14.0.6.so.1, and from LLVM 18 on libLLVM.so.19.1.
NAME = re.compile(r"libLLVM(?:-([0-9.]+[0-9]|[0-9]+))?\.so(?:\.([0-9.]+))?")
PATIENCE_SECONDS = 180.0
EDGE, SAMPLES = 16, 4  # of the image that proves a variant


def library_version(path):
    """The version in a library's name, as numbers to sort by; None where it is no such name."""
    match = NAME.fullmatch(path.name)
    if match is None:
        return None
    digits = match[1] or match[2] or ""
    return tuple(int(part) for part in digits.split(".") if part)


def libraries(folders=FOLDERS):
    """The LLVM libraries that are installed, each once, the newest first."""
    found = {}
    for pattern in folders:
        for folder in sorted(pathlib.Path("/").glob(pattern.lstrip("/"))):
            for file in sorted(folder.glob("libLLVM*.so*")):
                whole = file.resolve()  # other names are links to it
                version = library_version(whole)
                if version is not None and whole.is_file():
                    status = whole.stat()
                    found.setdefault((status.st_dev, status.st_ino), (version, str(whole)))
    return [path for _, path in sorted(found.values(), reverse=True)]


def environment(library):
    """Of a process whose vectorised variants use that library; "" leaves it to Dr.Jit."""
    return {**os.environ, LIBRARY: library} if library else dict(os.environ)


def proved(variant, library):
    """What a process of its own that proves a variant says, as a dictionary with a `problem` where
    it fails."""
    command = [sys.executable, "-B", str(pathlib.Path(__file__).resolve()), "--prove", variant]
    try:
        done = subprocess.run(command, env=environment(library), capture_output=True, text=True,
                              timeout=PATIENCE_SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return {"problem": f"it does not answer within {PATIENCE_SECONDS:.0f} s"}
    for line in done.stdout.splitlines():
        if line.startswith("{"):
            return json.loads(line)
    if done.returncode < 0:
        return {"problem": f"it ended by signal {-done.returncode}"}
    return {"problem": f"it ended with exit code {done.returncode}"}


def choose(variant="", installed=libraries, prove=proved):
    """The first of what there is to try that proves to work; `variant`: that one or none."""
    failed = []
    wished = os.environ.get(LIBRARY, "")
    tries = []
    if variant in ("", VECTORISED):
        # Where no library is found here, Dr.Jit may still find one.
        tries += [(VECTORISED, library) for library in ([wished] if wished else installed() or [""])]
    if variant != VECTORISED:
        tries.append((variant or SCALAR, ""))
    for name, library in tries:
        answer = prove(name, library)
        if "problem" not in answer:
            return {"variant": name, "library": library, "failed": failed, **answer}
        failed.append({"variant": name, "library": library, "problem": answer["problem"]})
        if answer.get("missing"):  # no library helps where there is no Mitsuba
            return {"problem": answer["problem"], "failed": failed}
    reasons = [f"{one['variant']}{', ' if one['library'] else ''}{one['library']}: {one['problem']}"
               for one in failed]
    return {"problem": "; ".join(reasons), "failed": failed}


def prove_here(variant):
    """Renders a small image of Mitsuba's own Cornell box."""
    try:
        import mitsuba as mi
        import numpy as np
    except ImportError as error:
        return {"problem": f"{sys.executable or 'this Python'} has no module {error.name}",
                "missing": True}
    try:
        mi.set_variant(variant)
        scene = mi.cornell_box()
        scene["sensor"]["film"].update({"width": EDGE, "height": EDGE})
        image = np.array(mi.render(mi.load_dict(scene), spp=SAMPLES))
        if not np.isfinite(image).all() or not image.mean() > 0.0:
            return {"problem": "its image is black, or no image"}
        return {"version": mi.__version__, "llvm": llvm_version(variant)}
    except Exception as error:  # whatever it is, another one may work
        return {"problem": f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"}


def llvm_version(variant):
    """Of the library in use; "" where there is none or Dr.Jit does not tell."""
    if not variant.startswith("llvm"):
        return ""
    import drjit as dr
    try:
        return ".".join(str(part) for part in dr.detail.llvm_version())
    except AttributeError:
        return ""


def main():
    parser = argparse.ArgumentParser(prog="mitsuba_variant.py", description=__doc__.splitlines()[0])
    parser.add_argument("--variant", default="", help="this one, or none")
    parser.add_argument("--prove", metavar="NAME", help="render a small image here")
    args = parser.parse_args()
    # Whatever libraries print goes elsewhere: standard output belongs to the other program.
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    answer = prove_here(args.prove) if args.prove else choose(args.variant)
    print(json.dumps(answer), file=answers, flush=True)
    os._exit(0)  # some libraries crash where their threads end after them


if __name__ == "__main__":
    main()
