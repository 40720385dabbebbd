#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes two Markdown pages of what `./weft bench tables --json FILE` wrote.

tables.md holds frames per second, speed-ups and HDR-VDP, with the published figures alongside, and
where the time goes; errors.md all errors, and what limits them. Needs only Python's standard
library:
    python3 bench/report/tables_report.py FILE
"""

import pathlib
import sys

import frame_shares
import markdown_table
import report_file

SETS = (("shipped", "Scenes that come with Weft"), ("real", "Other scenes"))
NAMES = {"FULL_A_vs_IGI": "FULL, A / IGI", "FULL_A_vs_IC": "FULL, A / IC",
         "TIC_vs_IC": "TIC / IC", "ID_alone": "ID alone", "SS_alone": "SS alone",
         "FULL_cpu": "FULL, processor"}
FPS = ("ID_A", "ID_AMAX", "SS_A", "SS_AMAX", "PM_A", "PM_AMAX", "FULL_A", "FULL_AMAX",
       "FULL_IGI", "FULL_IC", "FULL_TIC")
SPEEDUPS = ("ID", "SS", "PM", "FULL", "FULL_A_vs_IGI", "FULL_A_vs_IC", "TIC_vs_IC", "ID_alone",
            "SS_alone", "FULL_cpu")
SHARES = tuple(f"{method}_{share}" for method in ("A", "AMAX", "IGI", "IC")
               for share in ("75", "95"))
FLOORS = ("floor_75", "floor_95")
METHODS = ("A", "AMAX", "IGI", "IC")
ALL_METHODS = ("igi", "amax", "ais", "ic", "tic")
SCENES_OF = {"shipped": 11, "real": 8}  # how many a set has
BENCHMARK = "tables"
HIGH = "tables-high.json"
# Table, column, what it is called, floor, goal, whether more is better.
TARGETS = (("speedup", "ID", "speed-up ID", 2.7, None, True),
           ("speedup", "SS", "speed-up SS", 2.3, None, True),
           ("speedup", "PM", "speed-up PM", 2.9, None, True),
           ("speedup", "FULL", "speed-up FULL", 2.8, frame_shares.GOAL_FULL, True),
           ("speedup", "FULL_A_vs_IGI", "A over IGI", 3.5, frame_shares.GOAL_IGI, True),
           ("hdrvdp_percent_of_pixels", "A_75", "HDR-VDP 75 %, A", 1.3,
            frame_shares.GOAL_P75, False),
           ("hdrvdp_percent_of_pixels", "A_95", "HDR-VDP 95 %, A", 0.7,
            frame_shares.GOAL_P95, False))


def at(value, *path):
    """What lies at a path of keys, or None."""
    for key in path:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def label(column):
    return NAMES.get(column) or column.replace("AMAX", "A-MAX").replace("_", " ")


def scenes_of(report, name):
    return [scene for scene in report["scenes"] if scene["set"] == name]


def published_row(report, table, scene):
    return at(report, "published", table, "rows", scene["published"]) or {}


def published_means(report, table):
    """Plain means over the published rows, column by column."""
    columns = {}
    for row in (at(report, "published", table, "rows") or {}).values():
        for column, value in row.items():
            if value is not None:
                columns.setdefault(column, []).append(value)
    return {column: sum(values) / len(values) for column, values in columns.items()}


def set_table(report, name, table, columns, decimals):
    """The rows of a table for a set of scenes, each above the published one; then means. A floor
    and the noise of references are columns where any scene has them."""
    rows = []
    columns = [column for column in columns if not column.startswith(("floor", "noise"))
               or any(at(scene, "rows", table, column) is not None
                      for scene in scenes_of(report, name))]

    def add(title, row):
        rows.append([title, *(markdown_table.number(row.get(column), decimals)
                              for column in columns)])

    summary = report["summary"].get(name, {})
    for scene in scenes_of(report, name):
        add(scene["scene"], scene["rows"].get(table, {}))
        published = published_row(report, table, scene)
        if published:
            add(f'*published: {scene["published"]}*', published)
    add("**mean**", summary.get(table) or {})
    if published_means(report, table):
        add("*published mean, all scenes*", published_means(report, table))
        add("**mean where both have a figure**", at(summary, "common", table) or {})
        add("*published mean of these*", at(summary, "published", table) or {})
    return markdown_table.table(["scene", *map(label, columns)], rows)


def unbiased_table(report, name):
    """Unbiased relMSE, each with half the width of its interval; then means."""
    rows = []
    for scene in scenes_of(report, name):
        value, high = (scene["rows"].get(table, {}) for table in
                       ("unbiased_relmse", "unbiased_relmse_high"))
        cells = [None if value.get(column) is None or high.get(column) is None
                 else f"{value[column]:.4f} ± {high[column] - value[column]:.4f}"
                 for column in METHODS]
        rows.append([scene["scene"], *(cell or "" for cell in cells)])
    means = at(report, "summary", name, "unbiased_relmse") or {}
    rows.append(["**mean**", *(markdown_table.number(means.get(column), 4)
                               for column in METHODS)])
    return markdown_table.table(["scene", *map(label, METHODS)], rows)


def unbiased_section(report):
    """None where the references of no scene had halves."""
    if not any("unbiased_relmse" in scene["rows"] for scene in report["scenes"]):
        return []
    return ["", "## Unbiased relMSE", "",
            "Without the noise of the reference, from its two halves, with the interval of a "
            "confidence of 95 % that this noise leaves. Where the noise adds more than 0.005 to relMSE, "
            "intervals are too narrow.", "",
            "\n\n".join(f"### {title}\n\n" + unbiased_table(report, name)
                        for name, title in SETS if scenes_of(report, name))]


def tables_by_set(report, table, columns, decimals):
    return "\n\n".join(f"### {title}\n\n"
                       + set_table(report, name, table, columns, decimals)
                       for name, title in SETS if scenes_of(report, name))


def verdict(value, target, more):
    """How a mean stands to what it was to be."""
    if value is None or target is None:
        return ""
    if value >= target if more else value <= target:
        return "reached"
    off = target / value - 1.0 if more else value / target - 1.0
    return f"{100.0 * off:.0f} % off"


def target_table(report):
    rows = []
    for table, column, name, floor, goal, more in TARGETS:
        row = [name]
        for key, _ in SETS:
            value = at(report, "summary", key, table, column)
            row.append(markdown_table.number(value, 2))
            if key == "shipped":
                row += [f"{floor:g}", verdict(value, floor, more),
                        "" if goal is None else f"{goal:g}", verdict(value, goal, more)]
        row.append(markdown_table.number(published_means(report, table).get(column), 2))
        rows.append(row)
    return markdown_table.table(["mean", "here", "floor", "", "goal", "", "other scenes",
                                 "published"], rows)


def command(report, to):
    """What makes a report anew; `to`: the options that say where it goes."""
    words = ["./weft bench tables"]
    if report["quick"]:
        words.append("--quick")
    if report["quality"] != "preview":
        words.append(f'--quality {report["quality"]}')
    words += [f'--backend {report["device"]["backend"]}', f'--size {report["size"]}',
              f'--repetitions {report["repetitions"]}',
              f'--reference-spp {report["reference_spp"]}']
    if len(report["methods"]) < len(ALL_METHODS):
        words.append("--methods " + " ".join(report["methods"]))
    if report["machine"].get("threads"):
        words.append(f'--threads {report["machine"]["threads"]}')
    if not report.get("errors", True):
        words.append("--no-errors")
    if not report["quick"]:
        names = [scene["scene"] for scene in report["scenes"]]
        sets = sorted({scene["set"] for scene in report["scenes"]})
        words.append("--sets " + " ".join(sets))
        if len(names) < sum(SCENES_OF[name] for name in sets):
            words.append("--only " + " ".join(sorted(names)))
    return " ".join([*words, "--resume", to])


def about(report):
    """Machine, versions and the command, alike on both pages."""
    machine, device, versions = report["machine"], report["device"], report["versions"]
    samples = sorted({at(scene, "reference", "samples") for scene in report["scenes"]} - {None})
    # Reports of earlier versions do not name it.
    made_by = sorted({at(scene, "reference", "algorithm") or "path" for scene in report["scenes"]
                      if at(scene, "reference")})
    rows = [["image", f'{report["size"]} × {report["size"]} pixels, quality '
             f'`{report["quality"]}`, {report["repetitions"]} repetitions'],
            ["rendered by", f'{device["backend"]}, {device["name"]}, {device["driver"]} '
             f'{device["version"]}, {device["lanes"]} lanes'],
            ["processor", f'{machine["processor"]}, {machine["hardware_threads"]} threads'],
            ["versions", f'Weft {versions["weft"]}, compiler {versions["compiler"]}, Embree '
             f'{versions["embree"]}'],
            ["references", (" or ".join(f"`{name}`" for name in made_by)
                            if "reference" in made_by else "path tracing") + ", box filter, "
             + (" or ".join(map(str, samples)) or "no") + " samples per pixel"]]
    source = at(report, "published", "source")
    if source:
        rows.append(["published", source])
    return "\n".join([markdown_table.table(["", ""], rows, "---"), "", "Both pages are made by", "",
                      "```sh", command(report, "--pages docs/results"), "```", "",
                      "and from the figures of that run alone, with all raw times, by", "",
                      "```sh", "python3 bench/report/tables_report.py docs/results/tables.json",
                      "```"])


def tables_page(report):
    return "\n".join([
        "# The published tables", "",
        "Frames per second, speed-ups and visible errors of adaptive interleaved sampling (A, "
        "`ais`), of the same with every level at its maximum (A-MAX, `amax`), of instant global "
        "illumination (IGI, `igi`) and of records (IC, `ic`; TIC, `tic`). The published figures, "
        "on other scenes of the same names and on hardware of 2009 to 2011, stand below each row.",
        "", about(report), "", "## Means", "", target_table(report), "",
        "## Frames per second", "",
        "ID, SS and PM are component times: 1000 over the median of the milliseconds that the "
        "stages of indirect light, of direct light, and of light that media scatter to the camera "
        "take on the device within a full frame. Primary rays, composition and edge samples belong "
        "to none of them. The published times of components add up to more than those of whole "
        "frames, so they hold what components share; the columns \"alone\" of the next table "
        "compare frames with one light alone, all included, which do so as well. FULL is the wall "
        "time of whole frames; TIC that of frames in which a small box moves, without media and "
        "without bringing the scene up to date.", "", tables_by_set(report, "fps", FPS, 2), "",
        "## Speed-ups", "",
        "Of A over A-MAX unless the column says otherwise: medians over the repetitions of the "
        "ratios within each. \"processor\": by processor time.", "",
        tables_by_set(report, "speedup", SPEEDUPS, 2), "",
        "## HDR-VDP", "",
        "Percent of the pixels that an observer sees to differ from the reference with a "
        "probability of at least 75 or 95 %, in the published protocol (1 cd/m² at value 1, 30 "
        "pixels per degree).", "",
        tables_by_set(report, "hdrvdp_percent_of_pixels", SHARES + FLOORS, 2), "",
        "## Where the time goes", "",
        "Of full frames of A, percent of the wall time. *Gathering*: shadow rays to virtual lights "
        "and area lights; *first hits*: primary rays and what media do to them; *light*: making "
        "virtual lights and samples; *deciding*: probes, heuristics and the scheduler; "
        "*reconstruction*: from samples to pixels, and composition; *edges*: further samples of "
        "edge pixels; *between*: what no stage accounts for. *Bound*: the speed-up over A-MAX if "
        "gathering took no time at all.", "",
        "\n\n".join(f"### {title}\n\n" + frame_shares.time_table(scenes_of(report, name))
                    for name, title in SETS if scenes_of(report, name)), ""])


def errors_page(report, high):
    parts = [
        "# Errors of the published tables", "",
        "How far the images of the [tables](tables.md) are from path tracing, by several "
        "measures.", "", about(report)]
    for heading, table, columns, decimals, meaning in (
            ("HDR-VDP, published protocol", "hdrvdp_percent_of_pixels", SHARES + FLOORS, 2,
             "1 cd/m² at value 1, 30 pixels per degree; percent of the pixels."),
            ("HDR-VDP on a display", "hdrvdp_display", SHARES + FLOORS, 2,
             "100 cd/m² at value 1, no exposure; percent of the pixels."),
            ("HDR-FLIP", "hdrflip", (*METHODS, "floor"), 4, "Mean over the pixels, from 0 to 1."),
            ("relMSE", "relmse", (*METHODS, "noise"), 4, "Squared error over the squared reference; "
             "noise: what that of the reference adds to it, where it has halves."),
            ("Bias", "bias", METHODS, 4, "Of the mean of the image, relative to the "
             "reference's.")):
        parts += ["", f"## {heading}", "", meaning, "",
                  tables_by_set(report, table, columns, decimals)]
    parts += unbiased_section(report)
    if any(at(scene, "rows", "hdrflip", "floor") is not None for scene in report["scenes"]):
        parts += ["", "Columns called floor compare one half of the reference's samples with the "
                  "other: an error that is no larger says nothing."]
    parts += ["", "## What limits them", "",
              "How many times the goal of 0.3 % of the pixels (75 %) the error of A is, and "
              "whether it is the samples that A leaves out or what A-MAX, with samples everywhere, "
              "has as well: the number of virtual lights, their bounds, and interleaving."]
    for name, title in SETS:
        if scenes_of(report, name):
            parts += ["", f"### {title}", "", frame_shares.error_table(scenes_of(report, name))]
    if high:
        parts += ["", "## At a higher quality", "",
                  f'Errors of A at `--quality {high["quality"]}`, percent of the pixels. The '
                  f"goal is {frame_shares.GOAL_DISPLAY:g} % on a display (75 %).", "",
                  "```sh",
                  command(high, f"--json docs/results/{HIGH}"), "```"]
        for name, title in SETS:
            if scenes_of(high, name):
                parts += ["", f"### {title}", "", frame_shares.high_table(scenes_of(high, name))]
    return "\n".join([*parts, ""])


def main():
    parser = report_file.Parser(prog="tables_report.py", description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path, help="of --json")
    parser.add_argument("--high", type=pathlib.Path,
                        help=f"that of a run with --quality high, by default {HIGH} beside the "
                        "other where it is there")
    parser.add_argument("--output", type=pathlib.Path, help="folder, by default that of the file")
    args = parser.parse_args()
    output = args.output or args.file.parent
    try:
        report = report_file.read_report(args.file, BENCHMARK)
        beside = args.file.parent / HIGH
        high_file = args.high or (beside if beside.is_file() else None)
        high = report_file.read_report(high_file, BENCHMARK) if high_file else None
        pages = {"tables.md": tables_page(report), "errors.md": errors_page(report, high)}
    except report_file.BadInput as error:
        print(f"tables_report.py: {error}", file=sys.stderr)
        return report_file.EXIT_INPUT
    except (KeyError, TypeError, AttributeError, ValueError, ZeroDivisionError) as error:
        print(f"tables_report.py: {args.file}: lacks {error}, expected what this version of bench "
              "tables writes", file=sys.stderr)
        return report_file.EXIT_INPUT
    try:
        for name, text in pages.items():
            report_file.write_whole(output / name, text)
            print(output / name, flush=True)
    except OSError as error:
        print(f"tables_report.py: {output}: {error.strerror}", file=sys.stderr)
        return report_file.EXIT_OUTPUT
    return 0


if __name__ == "__main__":
    sys.exit(main())
