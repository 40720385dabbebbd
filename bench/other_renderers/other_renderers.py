#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Weft next to other renderers at equal time, on the same triangles, lights and camera.

Every scene is exported once and handed to each renderer that is installed; all render for each
budget of seconds, set-up left out, until an image fills it, and all images are compared with a
path-traced reference.
docs/benchmarks.md says how to read the table and what is left out.

Other renderers are Python packages: mitsuba, bpy (Cycles) and pyluxcore, and Debian's embree-tools.
"""

import argparse
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))

import mitsuba_variant  # noqa: E402
from equal_time import Costs, warm_up, within  # noqa: E402
from processor import processor  # noqa: E402
from verdicts import DENOISED, handed_over, judge, summary, verdict  # noqa: E402
from weft_runs import (OWN_SETTINGS, Failure, Reference, Weft, compare, floor,  # noqa: E402
                       reference, run)

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
EXIT_USAGE, EXIT_INPUT = 1, 2
EXIT_MISSING = 69  # as ./weft says where a package is missing
EXIT_OUTPUT = 5
MITSUBA = "mitsuba"  # its variant is found
RENDERERS = {MITSUBA: ("mitsuba_renderer.py", mitsuba_variant.VECTORISED),
             "cycles": ("cycles_renderer.py", "plain"),
             "cycles-denoised": ("cycles_renderer.py", "denoised"),
             "luxcore": ("luxcore_renderer.py", "plain"),
             "embree": ("embree_renderer.py", "plain")}
BUDGETS = (0.3, 1.0, 3.0, 10.0)
QUICK_BUDGETS = (0.3, 1.0)
PROBE_PATIENCE = 120.0
VARIANT_PATIENCE = 1200.0  # a library that does not work takes a while to say so
SET_UP_PATIENCE = 900.0  # beside the budgets
TRIES = 10.0  # that many times the budgets at most


class Parser(argparse.ArgumentParser):
    """Fails as Weft's other programs do."""

    def error(self, message):
        self.exit(1, f"{self.prog}: {message}\n")


def parse():
    parser = Parser(prog="bench other_renderers", description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="+", type=pathlib.Path, metavar="SCENE")
    parser.add_argument("--only", nargs="+", choices=RENDERERS, metavar="NAME",
                        help="only these other renderers: " + " ".join(RENDERERS))
    parser.add_argument("--budgets", nargs="+", type=float, metavar="SECONDS",
                        help="default: 0.3 1 3 10; --quick: 0.3 1")
    parser.add_argument("--check", type=float, default=3.0, metavar="SECONDS",
                        help="of an image of each renderer for its mean alone, where no budget is "
                             "that long; default 3, 0: none")
    parser.add_argument("--own-reference", type=float, default=120.0, metavar="SECONDS",
                        help="of the image that each other renderer is compared with in scenes of "
                             "metals, plastics or glass, which it makes itself; default 120, 0: "
                             "with Weft's")
    parser.add_argument("--environment", type=pathlib.Path, metavar="FILE",
                        help="an image of the light from all around, of every scene")
    parser.add_argument("--size", type=int, help="width and height, default 512; --quick: 128")
    parser.add_argument("--threads", type=int, default=0, help="of every renderer; 0: all")
    parser.add_argument("--backend", help="of Weft")
    parser.add_argument("--variant", default="", help="of Mitsuba; default: llvm_ad_rgb where it "
                        "works, else scalar_rgb")
    parser.add_argument("--preset", nargs="+", default=[], type=pathlib.Path, metavar="FILE",
                        help="settings of Weft to measure beside its defaults")
    parser.add_argument("--peer-python", dest="renderer_python", nargs="+", default=[],
                        metavar="NAME=PROGRAM",
                        help="another Python for one of the renderers, such as "
                             "cycles=blender-env/bin/python")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("peers"),
                        metavar="DIR", help="folder of images, DIR/SCENE/peers.json")
    parser.add_argument("--reference", type=pathlib.Path, metavar="FILE",
                        help="of the only scene; default: the one in --references with the most "
                             "samples, which is rendered where there is none")
    parser.add_argument("--references", type=pathlib.Path, metavar="DIR",
                        default=ROOT / "build" / "references")
    parser.add_argument("--reference-spp", type=int, help="default 4096; --quick: 256")
    parser.add_argument("--quick", action="store_true", help="a small image, two budgets")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE",
                        help="machine, versions, all figures and a summary; grows by the scene")
    parser.add_argument("--resume", action="store_true",
                        help="leave out the scenes that --json holds, of a run like this one")
    parser.add_argument("--weft", default=str(ROOT / "build" / "release" / "weft"))
    parser.add_argument("--export", help="the program export_scene; default: built when needed")
    parser.add_argument("--half-errors", help="the program half_errors; default: built when needed")
    args = parser.parse_args()
    args.size = args.size or (128 if args.quick else 512)
    args.reference_spp = args.reference_spp or (256 if args.quick else 4096)
    args.budgets = args.budgets or list(QUICK_BUDGETS if args.quick else BUDGETS)
    program = [args.half_errors] if args.half_errors else [ROOT / "weft", "bench", "half_errors"]
    args.half_errors = program
    args.mitsuba = {"variant": RENDERERS[MITSUBA][1], "library": ""}
    check(parser, args)
    return args


def check(parser, args):
    if not 1 <= args.size <= 8192:
        parser.error("--size is out of range, expected 1 to 8192")
    if not all(0.01 <= budget <= 3600.0 for budget in args.budgets):
        parser.error("--budgets are out of range, expected 0.01 to 3600")
    if not (args.check == 0.0 or 0.01 <= args.check <= 3600.0):
        parser.error("--check is out of range, expected 0 or 0.01 to 3600")
    if not (args.own_reference == 0.0 or 0.01 <= args.own_reference <= 36000.0):
        parser.error("--own-reference is out of range, expected 0 or 0.01 to 36000")
    if args.resume and not args.json:
        parser.error("--resume: expected --json with it")
    if args.reference and len(args.scenes) > 1:
        parser.error("--reference is for a single scene")
    pythons = dict(word.partition("=")[::2] for word in args.renderer_python)
    for name in pythons:
        if name not in RENDERERS:
            parser.error(f"--peer-python: no renderer '{name}', expected one of: "
                         + " ".join(RENDERERS))
    args.renderer_python = pythons


def child(args, name, *arguments, patience):
    """The JSON lines of another renderer's program, and what went wrong, if anything."""
    program, variant = RENDERERS[name]
    library = ""
    if name == MITSUBA:
        variant, library = args.mitsuba["variant"], args.mitsuba["library"]
    command = [args.renderer_python.get(name, sys.executable), "-B", HERE / program,
               "--variant", variant, *arguments]
    return json_lines(command, patience, mitsuba_variant.environment(library))


def json_lines(command, patience, environment=None):
    """The JSON lines of a program, and what went wrong, if anything."""
    problem = None
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True,
                              env=environment, timeout=patience, check=False)
        output = done.stdout
        if done.returncode != 0:
            problem = f"ended with exit code {done.returncode}"
    except subprocess.TimeoutExpired as error:
        output, problem = error.stdout or b"", f"was ended after {patience:.0f} s"
    except OSError as error:
        output, problem = b"", f"{command[0]}: {error.strerror}"
    lines = []
    for line in output.decode(errors="replace").splitlines():
        try:
            lines.append(json.loads(line))
        except ValueError:
            continue
    problem = next((line["problem"] for line in lines if "problem" in line), problem)
    return [line for line in lines if "problem" not in line], problem


def choose_mitsuba(args):
    """Finds the variant of Mitsuba that renders, and the LLVM library that it does so with, in the
    Python that is used for it. Returns its version and None, or None and a problem."""
    python = args.renderer_python.get(MITSUBA, sys.executable)
    program = pathlib.Path(mitsuba_variant.__file__)
    words = ["--variant", args.variant] if args.variant else []
    lines, problem = json_lines([python, "-B", program, *words], VARIANT_PATIENCE)
    if problem or not lines:
        return None, problem
    for failed in lines[0]["failed"]:
        print(f"{MITSUBA}: does not work: {failed['variant']}, {failed['library']}: "
              f"{failed['problem']}", file=sys.stderr)
    args.mitsuba = lines[0]
    with_llvm = f" with LLVM {args.mitsuba['llvm']}" if args.mitsuba["llvm"] else ""
    print(f"Mitsuba {args.mitsuba['version']}, {args.mitsuba['variant']}{with_llvm} "
          f"({args.mitsuba['library'] or 'no library needed'})", flush=True)
    return f"Mitsuba {args.mitsuba['version']}, {args.mitsuba['variant']}{with_llvm}", None


def installed(args):
    """Names of the other renderers that start, with their versions; says why others do not."""
    versions = {}
    for name in args.only or RENDERERS:
        if name == MITSUBA:
            version, problem = choose_mitsuba(args)
            lines = [{"version": version}] if version else []
        else:
            lines, problem = child(args, name, "--probe", patience=PROBE_PATIENCE)
        if problem or not lines:
            print(f"{name}: not available, {problem or 'says nothing'}", file=sys.stderr)
        else:
            versions[name] = lines[0]["version"]
    return versions


def export(args, scene, folder):
    """Writes the scene for the others, from nothing: what an older run left must not mix in."""
    shutil.rmtree(folder, ignore_errors=True)
    program = [args.export] if args.export else [ROOT / "weft", "bench", "export_scene"]
    environment = ["--environment", args.environment] if args.environment else []
    run([*program, scene, "-o", folder, "--size", args.size, args.size, *environment])


def has_materials(folder):
    """Whether an exported scene has surfaces beyond Lambert's law."""
    fields = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    return any(material.get("surface") for material in fields["materials"])


def own_images(args, scene, folder):
    """Weft's images, every setting at every budget, and notes on those that are left out."""
    settings = dict(OWN_SETTINGS)
    for preset in args.preset:
        settings[f"Weft {preset.stem}"] = ["--preset", preset]
    images, notes = [], []
    for name, options in settings.items():
        weft = Weft(args, name, options, scene, folder)
        costs = Costs()
        warm_up(weft, costs)
        for number, budget in enumerate(args.budgets):
            found = within(weft, costs, budget, 100 * (number + 1))
            file, samples, seconds = found
            if not found.filled:
                notes.append(f"{name}: {found.unfilled(budget)}")
                continue
            kept = folder / f"{name}-{budget:g}.exr".lower().replace(" ", "-")
            os.replace(file, kept)
            images.append({"name": name, "budget_s": budget, "seconds": seconds,
                             "samples": samples, "denoised": False, "picture": kept.name})
    for file in folder.glob("weft-*-*-*.exr"):
        if file.name not in {image["picture"] for image in images}:
            file.unlink()
    return images, notes


def other_renderers(args, names, folder):
    """The other renderers' images of an exported scene, notes on what they did, and why some are
    left out."""
    images, notes, left_out = [], [], {}
    check = args.check if args.check > max(args.budgets) else 0.0
    own = args.own_reference if has_materials(folder / "export") else 0.0
    patience = SET_UP_PATIENCE + TRIES * (sum(args.budgets) + check) + 2.0 * own
    for name in names:
        reference = 0.0 if RENDERERS[name][1] == "denoised" else own
        lines, problem = child(args, name, "--scene", folder / "export", "--threads", args.threads,
                               "-o", folder, "--check", check, "--reference", reference,
                               "--budgets", *args.budgets, patience=patience)
        if problem:
            left_out[name] = f"left out or cut short, {problem}"
        for line in lines:
            if "picture" in line:
                images.append(line)
            elif "unfilled" in line:
                notes.append(line["unfilled"])
            elif "not_expressible" in line:
                left_out[name] = f"not expressible: {line['not_expressible']}"
            else:
                notes += line["notes"]
        if name in left_out:
            notes.append(f"{name}: {left_out[name]}")
            print(notes[-1], file=sys.stderr)
    return images, notes, left_out


def own_references(args, images, folder, against):
    """The references that other renderers have made for themselves, by name, and a note for each on
    how its mean compares with that of Weft's."""
    found, notes = {}, []
    for image in images:
        if not image.get("reference"):
            continue
        file = folder / image["picture"]
        found[image["name"]] = Reference(file)
        mean = compare(args, file, against, [])["mean_ratio"]
        notes.append(f"{image['name']}: compared with an image of its own, {image['samples']:g} "
                     f"samples in {image['seconds']:.0f} s, whose mean is {mean or 0.0:.3f} of "
                     "that of Weft's reference")
    return found, notes


def compared(args, images, folder, against):
    """The images with their errors, and notes. Those that are there for the mean or as references
    alone go, once all have been judged by them."""
    own, notes = own_references(args, images, folder, against)
    images = [image for image in images if not image.get("reference")]
    for image in images:
        errors = [] if image.get("check") else ["hdrflip", "relmse"]
        # A denoiser is judged by what its renderer shows without one.
        reference = own.get(image["name"].removesuffix(DENOISED), against)
        image.update(compare(args, folder / image["picture"], reference, errors))
    judge(images)
    return [image for image in images if not image.get("check")], notes


def measure(args, scene, versions):
    """One scene: writes DIR/SCENE/peers.json and returns what it holds."""
    folder = args.output / scene.stem
    folder.mkdir(parents=True, exist_ok=True)
    export(args, scene, folder / "export")
    against = reference(args, scene, folder / "export")
    images, notes, left_out = other_renderers(args, versions, folder)
    own, own_notes = own_images(args, scene, folder)
    notes += own_notes
    for note in notes:
        if "left out at" in note:
            print(note, file=sys.stderr)
    images, more_notes = compared(args, own + images, folder, against)
    notes += more_notes
    notes = ["Left out of all times: reading the scene, building the acceleration structure and "
             "kernels, a warm-up image, writing files.", *notes]
    notes += [f"{name}: version {version}" for name, version in versions.items()]
    result = {"scene": scene.name, "size": [args.size, args.size],
              "threads": args.threads, "reference": against.file.name,
              "reference_floor": floor(args, against),
              "pictures": images, "left_out": left_out, "notes": notes,
              "verdicts": [verdict(images, budget) for budget in args.budgets]}
    write_json(folder / "peers.json", handed_over(images, notes))
    return result


def write_json(path, value):
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(json.dumps(value, indent=2) + "\n", encoding="utf-8")
        os.replace(part, path)
    except OSError as error:
        raise Failure(f"{path}: {error.strerror}, expected a file that can be written",
                      EXIT_OUTPUT) from error


def flip_cell(image):
    marks = ("" if image["comparable"] else "*") + ("+" if image["late"] else "")
    return f"{image['hdrflip']:.4f}{marks}"


def relmse_cell(image):
    if image["relmse_unbiased"] is None:  # its reference has no halves
        return f"{image['relmse']:.4f}"
    return f"{image['relmse_unbiased']:.4f}±{image['relmse_interval']:.4f}"


def show_errors(result, budgets, width, cell):
    """A table of a scene: errors by renderer and budget."""
    print(f"{'':26}" + "".join(f"{f'{budget:g} s':>{width}}" for budget in budgets)
          + f"{'mean':>9}")
    for name in dict.fromkeys(image["name"] for image in result["pictures"]):
        row, mean = f"{name:26}", None
        for budget in budgets:
            found = [p for p in result["pictures"] if (p["name"], p["budget_s"]) == (name, budget)]
            mean = found[0]["judged_mean"] if found else mean
            row += f"{cell(found[0]) if found else '-':>{width}}"
        print(row + (f"{'-':>9}" if mean is None else f"{mean:>9.3f}"))


def show(result, budgets):
    """The tables of a scene, and who wins."""
    floor_text = "" if result["reference_floor"] is None else \
        f", {result['reference_floor']:.4f} between the halves of the reference"
    print(f"\n{result['scene']}: HDR-FLIP{floor_text}; * not comparable, + late")
    show_errors(result, budgets, 11, flip_cell)
    if result["reference_floor"] is not None:
        print("relMSE without the noise of the reference, ± half of its 95 % interval")
        show_errors(result, budgets, 16, relmse_cell)
    for found in result["verdicts"]:
        if found["peer"]:
            winner = found["weft"] if found["wins"] else found["peer"]
            print(f"{found['budget_s']:g} s: {winner['name']} ({winner['hdrflip']:.4f})")
    sys.stdout.flush()


def run_all(args):
    versions = installed(args)
    if not versions:
        python = sys.executable or "this Python"
        print(f"bench other_renderers: {python} has none of the packages mitsuba, "
              "bpy and pyluxcore, and there is no program pathtracer of embree-tools; expected at "
              "least one (--python PROGRAM or WEFT_BENCH_PYTHON; pip install mitsuba numpy)",
              file=sys.stderr)
        return EXIT_MISSING
    report = new_report(args, versions)
    results = report["scenes"] = earlier_scenes(args, report)
    for scene in args.scenes:
        if any(result["scene"] == scene.name for result in results):
            continue
        results.append(measure(args, scene, versions))
        show(results[-1], args.budgets)
        report["summary"] = summary(results, args.budgets)
        if args.json:
            write_json(args.json, report)
    print("\n" + json.dumps(summary(results, args.budgets)))
    return 0


def new_report(args, versions):
    """What --json gets, as yet without scenes."""
    machine = {"processor": processor(), "hardware_threads": os.cpu_count(),
               "threads": args.threads}
    settings = {"check_s": args.check, "backend": args.backend,
                "own_reference_s": args.own_reference,
                "environment": args.environment and args.environment.name,
                "reference_spp": args.reference_spp,
                "presets": [preset.name for preset in args.preset]}
    return {"benchmark": "peers", "quick": args.quick, "size": args.size, "budgets": args.budgets,
            "settings": settings, "machine": machine,
            "versions": {**versions, "weft": run([args.weft, "--version"]).strip(),
                         "python": platform.python_version()},
            "scenes": [], "summary": summary([], args.budgets)}


def earlier_scenes(args, report):
    """Scenes of the run that --json holds. Raises Failure where it was another one."""
    if not args.resume or not args.json.exists():
        return []
    try:
        earlier = json.loads(args.json.read_text(encoding="utf-8"))
    except ValueError as error:
        raise Failure(f"{args.json}: is no JSON ({error})", EXIT_INPUT) from error
    if not isinstance(earlier, dict) or not isinstance(earlier.get("scenes"), list):
        raise Failure(f"{args.json}: is no report of bench other_renderers, expected one",
                      EXIT_INPUT)
    for key in ("benchmark", "size", "budgets", "settings", "machine", "versions"):
        if earlier.get(key) != report[key]:
            raise Failure(f"{args.json}: is of a run with another {key}, expected the same as now",
                          EXIT_USAGE)
    return earlier["scenes"]


def main():
    args = parse()
    try:
        return run_all(args)
    except Failure as failure:
        print(f"bench other_renderers: {failure}", file=sys.stderr)
        return failure.code
    except OSError as error:
        print(f"bench other_renderers: {error}", file=sys.stderr)
        return EXIT_OUTPUT


if __name__ == "__main__":
    sys.exit(main())
