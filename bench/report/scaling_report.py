#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a page of what `./weft bench scaling --json FILE` wrote, with plots beside it.

Needs Matplotlib (Debian package python3-matplotlib):
    python3 bench/report/scaling_report.py docs/results/scaling.json
"""

import itertools
import sys

from markdown_table import number
import plots
import report_file

STYLES, BUILD = plots.STYLES[:6], plots.STYLES[6]
TITLES = {"triangles": "Triangles", "resolution": "Resolution", "vpls": "Virtual lights",
          "lights": "Lights", "threads": "Threads", "depth": "Optical depth"}
EXPECTED = {
    "triangles": "Rays go down a tree, so that a frame is expected to grow with the logarithm of "
                 "the number of triangles, as long as memory keeps up; building the tree with the "
                 "number itself.",
    "resolution": "A frame is expected to be linear in the number of pixels, with an offset for "
                  "what is made once a frame.",
    "vpls": "Each pixel gathers the virtual lights of its set, so that a frame is expected to be "
            "linear in their number, with an offset for all else.",
    "lights": "Each light has samples of its own up to a number of samples per set, beyond which "
              "lights are chosen by power: linear, then flat.",
    "threads": "Amdahl's law, with the share of the work that stays serial as its parameter.",
    "depth": "Even fog has a transmittance in closed form and a fixed number of places on a view "
             "ray, so that a frame is expected not to depend on its depth.",
}


def law_text(name, law):
    if law is None:
        return f"- {name}: too few points, or a time of 0, to fit anything."
    parameters = ", ".join(f"{key} {value:.4g}" for key, value in law["parameters"].items())
    return (f'- {name}: {law["text"]} with {parameters}; off by '
            f'{100.0 * law["relative_rms"]:.1f} % (root mean square). As a power of x the '
            f'exponent is {law["exponent"]:.2f}.')


def error_text(method):
    exponents = [f"{label} {method[key]:.2f}"
                 for key, label in (("relmse_exponent", "relMSE"), ("hdrflip_exponent", "HDR-FLIP"))
                 if method[key] is not None]
    if not exponents:
        return None
    return f'- Errors of {method["method"]} as a power of x: {", ".join(exponents)}.'


def expected_of(law, count):
    return [None] * count if law is None else law["expected"]


def error_of(point, name):
    return None if point["errors"] is None else point["errors"][name]


def axis_table(axis):
    headings, columns = [axis["unit"]], []
    with_errors = any(point["errors"] is not None
                      for method in axis["methods"] for point in method["points"])
    for method in axis["methods"]:
        points = method["points"]
        expected = expected_of(method["law"], len(points))
        name = method["method"]
        headings += [f"{name}, ms", "expected"]
        columns += [[number(point["ms"], 2) for point in points],
                    [number(value, 2) for value in expected]]
        if with_errors:
            headings += ["relMSE", "HDR-FLIP"]
            columns += [[number(error_of(point, "relmse"), 5) for point in points],
                        [number(error_of(point, "hdrflip"), 4) for point in points]]
    if axis["build"] is not None:
        points = axis["build"]["points"]
        headings += ["build, ms", "expected"]
        columns += [[number(point["ms"], 2) for point in points],
                    [number(value, 2)
                     for value in expected_of(axis["build"]["law"], len(points))]]
    x = [f'{point["x"]:g}' if point["x"] < 1.0 else number(point["x"], 0)
         for point in axis["methods"][0]["points"]]
    return report_file.table(headings, zip(x, *columns))


def line(axes, name, points, **style):
    """Points (x, y) joined by a line, without those that logarithmic axes cannot show."""
    shown = [(x, y) for x, y in points
             if x is not None and y is not None and x > 0.0 and y > 0.0]
    if shown:
        axes.plot(*zip(*shown), label=name, gid=plots.identifier(name), **style)


def line_with_law(axes, name, points, law, style):
    """What was measured, and the law beside it."""
    line(axes, name, [(point["x"], point["ms"]) for point in points], **style)
    line(axes, f"{name}, expected",
         zip((point["x"] for point in points), expected_of(law, len(points))),
         color=style["color"], linestyle="--")


def plot(title, x_label, y_label, draw):
    """An SVG of what `draw` draws on logarithmic axes; empty where that is nothing."""
    figure = plots.figure(7.2, 3.4)
    axes = figure.add_subplot(title=title, xlabel=x_label, ylabel=y_label)
    draw(axes)
    if not axes.lines:
        return ""
    axes.set(xscale="log", yscale="log")
    for axis in (axes.xaxis, axes.yaxis):
        plots.label_ticks(axis)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))  # beside the lines, never over them
    return plots.svg(figure, title)


def time_plot(title, axis):
    def draw(axes):
        for method, style in zip(axis["methods"], itertools.cycle(STYLES)):
            line_with_law(axes, method["method"], method["points"], method["law"], style)
        if axis["build"] is not None:
            line_with_law(axes, "build", axis["build"]["points"], axis["build"]["law"], BUILD)
    return plot(title, axis["unit"], "milliseconds", draw)


def error_plot(title, axis):
    def draw(axes):
        for method, style in zip(axis["methods"], itertools.cycle(STYLES)):
            for name, label, variant in (("relmse", "relMSE", {}),
                                       ("hdrflip", "HDR-FLIP",
                                        {"linestyle": ":", "markerfacecolor": "white"})):
                line(axes, f'{method["method"]}, {label}',
                     [(point["x"], error_of(point, name)) for point in method["points"]],
                     **style, **variant)
    return plot(title, axis["unit"], "error", draw)


def axis_part(axis, output, files):
    """The axis as Markdown; its plots are added to `files`, texts by path."""
    name = axis["axis"]
    title = TITLES.get(name, name)
    parts = [f"## {title}", "", f'Setting: {axis["setting"]}. {EXPECTED.get(name, "")}', ""]
    for suffix, what, draw in (("", "time", time_plot), ("-error", "error", error_plot)):
        drawn = draw(f"{title}: {what}", axis)
        if drawn:
            file = output.with_name(f"{output.stem}-{name}{suffix}.svg")
            files[file] = drawn
            parts.append(f"![{title}: {what}]({file.name})")
    parts += ["", axis_table(axis)]
    parts += [law_text(method["method"], method["law"]) for method in axis["methods"]]
    if axis["build"] is not None:
        parts.append(law_text("build of the acceleration structure", axis["build"]["law"]))
    parts += [text for text in map(error_text, axis["methods"]) if text]
    parts += [f"- Left out: {line}." for line in axis["left_out"]]
    return "\n".join([*parts, ""])


def make(report, output):
    """Writes the page and its plots."""
    files = {}
    device = report["device"]
    parts = ["# How time and error grow", "",
             "Made by `bench/report/scaling_report.py` from what `./weft bench scaling` measured; "
             "[benchmarks](../benchmarks.md#scaling) says how.", "",
             f'{report_file.about(report)} Frames on the backend {device["backend"]} '
             f'({device["name"]}), {report["size"]} × {report["size"]} pixels where these are not '
             f'what is varied, medians of {report["repetitions"]} frames'
             + (f'; references of {report["reference_spp"]} samples per pixel.'
                if report["reference_spp"] else "."), ""]
    parts += [axis_part(axis, output, files) for axis in report["axes"]]
    files[output] = "\n".join(parts)
    for file, text in files.items():
        report_file.write_whole(file, text)
    return sorted(files)


if __name__ == "__main__":
    sys.exit(report_file.run("scaling_report.py", "scaling", make))
