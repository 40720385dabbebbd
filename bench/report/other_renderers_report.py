#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a page of what `./weft bench other_renderers --json FILE` wrote.

Needs only Python's standard library:
    python3 bench/report/other_renderers_report.py docs/results/peers.json
"""

import sys

from markdown_table import number
import report_file

OWN = "Weft"  # begins the names of Weft's settings
UNFILLED = ": left out at "  # in notes on images that took too little or too much of a budget


def names_of(scenes):
    """Renderers with an image, Weft's settings first, each in the order it first comes."""
    found = dict.fromkeys(image["name"] for scene in scenes for image in scene["pictures"])
    return sorted(found, key=lambda name: not name.startswith(OWN))


def denoised_names(scenes):
    return {image["name"] for scene in scenes for image in scene["pictures"]
            if image["denoised"]}


def image_of(scene, name, budget):
    for image in scene["pictures"]:
        if image["name"] == name and image["budget_s"] == budget:
            return image
    return None


def verdict_of(scene, budget):
    return next(verdict for verdict in scene["verdicts"] if verdict["budget_s"] == budget)


def wins(scenes, budget, key):
    """How many of the scenes with such another renderer Weft wins, and how many these are."""
    judged = [verdict_of(scene, budget)[key] for scene in scenes]
    judged = [won for won in judged if won is not None]
    return sum(judged), len(judged)


def counted(scenes, budgets, key):
    return ", ".join("at {:g} s on {} of {}".format(budget, *wins(scenes, budget, key))
                     for budget in budgets)


def summary(scenes, budgets):
    lines = [f"Weft has the lowest HDR-FLIP of all undenoised {counted(scenes, budgets, 'wins')}."]
    if any(wins(scenes, budget, "wins_denoised")[1] for budget in budgets):
        lines.append("Against denoised images of others it has the lower one "
                     f"{counted(scenes, budgets, 'wins_denoised')}.")
    return " ".join(lines)


def error_cell(scene, name, budget, lowest):
    image = image_of(scene, name, budget)
    if image is None:
        return ""
    marks = ("" if image["comparable"] else "\\*") + ("+" if image["late"] else "")
    text = number(image["hdrflip"], 4)
    return f"**{text}**{marks}" if name == lowest else text + marks


def relmse_cell(scene, name, budget):
    """The unbiased relMSE and its interval, where the reference has halves."""
    image = image_of(scene, name, budget)
    if image is None or image.get("relmse_unbiased") is None:
        return ""
    return f'{number(image["relmse_unbiased"], 4)} ± {number(image["relmse_interval"], 4)}'


def has_halves(scenes):
    return any(scene.get("reference_floor") is not None for scene in scenes)


def floor_cell(scene):
    return number(scene.get("reference_floor"), 4)


def lowest_of(verdict):
    """The undenoised renderer that wins."""
    found = [verdict[key] for key in ("weft", "peer") if verdict[key]]
    return min(found, key=lambda entry: entry["hdrflip"])["name"] if found else None


def error_table(scenes, budget):
    names = names_of(scenes)
    rows = []
    for scene in scenes:
        lowest = lowest_of(verdict_of(scene, budget))
        row = [scene["scene"], *(error_cell(scene, name, budget, lowest) for name in names)]
        rows.append(row + ([floor_cell(scene)] if has_halves(scenes) else []))
    floor = ["between halves of the reference"] if has_halves(scenes) else []
    return report_file.table(["scene", *names, *floor], rows)


def relmse_part(scenes, budget):
    """A paragraph and a table, or nothing where no reference has halves."""
    if not has_halves(scenes):
        return []
    names = names_of(scenes)
    rows = [[scene["scene"], *(relmse_cell(scene, name, budget) for name in names)]
            for scene in scenes]
    return ["relMSE without the noise of the reference, ± half of its 95 % interval:", "",
            report_file.table(["scene", *names], rows)]


def best_table(scenes, budget):
    rows = []
    for scene in scenes:
        verdict = verdict_of(scene, budget)
        cells = [scene["scene"]]
        for key in ("weft", "peer", "denoised"):
            entry = verdict[key]
            cells += [entry["name"], number(entry["hdrflip"], 4)] if entry else ["", ""]
        ours, theirs = verdict["weft"], verdict["peer"]
        ratio = ours["hdrflip"] / theirs["hdrflip"] if ours and theirs else None
        rows.append([*cells, number(ratio, 2)])
    return report_file.table(["scene", "best of Weft", "", "best undenoised other", "",
                              "best denoised other", "", "Weft's over the other's"], rows)


def time_table(scenes, budget):
    names = names_of(scenes)
    rows = []
    for scene in scenes:
        cells = [scene["scene"]]
        for name in names:
            image = image_of(scene, name, budget)
            cells.append("" if image is None else
                         f'{number(image["seconds"], 2)} s, {number(image["samples"], 0)}')
        rows.append(cells)
    return report_file.table(["scene", *names], rows)


def mean_table(scenes):
    names = names_of(scenes)
    rows = []
    for scene in scenes:
        cells = [scene["scene"]]
        for name in names:
            means = [image["judged_mean"] for image in scene["pictures"]
                     if image["name"] == name]
            cells.append(number(means[-1], 3) if means else "")
        rows.append(cells)
    return report_file.table(["scene", *names], rows)


def left_out_part(scenes):
    """Which renderers lack in which scenes, and why."""
    reasons = {}
    for scene in scenes:
        for name, reason in scene["left_out"].items():
            reasons.setdefault((name, reason), []).append(scene["scene"])
    if not reasons:
        return "Every renderer took part in every scene.\n"
    return report_file.table(["renderer", "why", "scenes"],
                             [[f"`{name}`", reason, ", ".join(found)]
                              for (name, reason), found in reasons.items()])


def notes_part(scenes):
    """What the renderers say about themselves; times of set-up differ from scene to scene."""
    notes = dict.fromkeys(note for note in scenes[0]["notes"] if UNFILLED not in note)
    return "\n".join(f"- {note}" for note in notes) + "\n"


def unfilled_part(scenes):
    """Images that are left out because they did not fill their budget; nothing where none are."""
    lines = [f'- {scene["scene"]}, {note}' for scene in scenes for note in scene["notes"]
             if UNFILLED in note]
    return ["## Budgets that were not filled", "", "\n".join(lines) + "\n"] if lines else []


def about(report):
    machine, versions = report["machine"], report["versions"]
    threads = machine["threads"] or machine["hardware_threads"]
    others = ", ".join(dict.fromkeys(versions[name] for name in versions
                                     if name not in ("weft", "python")))
    return (f'Measured on {machine["processor"]} with {threads} of {machine["hardware_threads"]} '
            f'hardware threads; {versions["weft"]}; {others}; Python {versions["python"]}.')


def budget_part(scenes, budget):
    return "\n".join([f"## {budget:g} s", "", error_table(scenes, budget),
                      best_table(scenes, budget), *relmse_part(scenes, budget),
                      "Seconds taken, and samples per pixel:", "", time_table(scenes, budget)])


def make(report, output):
    """Writes the page."""
    scenes, budgets = report["scenes"], report["budgets"]
    denoised = ", ".join(sorted(denoised_names(scenes)))
    text = "\n".join([
        "# Other renderers at equal time", "",
        "Made by `bench/report/other_renderers_report.py` from what "
        "`./weft bench other_renderers` measured; "
        "[benchmarks](../benchmarks.md#other-renderers) says how.", "", summary(scenes, budgets), "",
        f'{about(report)} Images of {report["size"]} × {report["size"]} pixels against '
        "path-traced references; HDR-FLIP, lower is better. Bold: the lowest of those that compete "
        "and are not denoised. + took more than 10 % longer than it should, which counts against "
        "Weft alone; \\* shows another mean and does not compete, but for Weft, whose means are as "
        "far off as its settings make them: that is part of their error."
        + (f" Denoised: {denoised}." if denoised else ""), "",
        *(budget_part(scenes, budget) for budget in budgets),
        "## Who shows the same", "",
        "The mean over that of the reference, in the longest image of each renderer; of denoised "
        "ones that of the same renderer without a denoiser.", "", mean_table(scenes),
        "## Who is left out", "", left_out_part(scenes), *unfilled_part(scenes),
        f'## Notes, from {scenes[0]["scene"]}', "", notes_part(scenes)])
    report_file.write_whole(output, text.rstrip("\n") + "\n")
    return [output]


if __name__ == "__main__":
    sys.exit(report_file.run("other_renderers_report.py", "other_renderers", make, "peers"))
