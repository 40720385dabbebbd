#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes one HTML page of what `./weft bench dynamic --report FOLDER` left in a folder.

The page holds everything, plots and images included, and needs nothing else to be seen. Needs
only Python's standard library:
    python3 bench/report/dynamic_report.py FOLDER
"""

import argparse
import base64
import html
import json
import pathlib
import sys

import svg_plot

EXIT_INPUT, EXIT_OUTPUT = 2, 5  # as Weft's other programs say
PALETTE = {"igi": "#e69f00", "irradiance-cache": "#888888", "ic": "#56b4e9", "tic": "#009e73",
           "tic, no masks": "#cc79a7", "ais": "#d55e00", "ais, tic": "#0072b2"}
SPARE = ("#6a3d9a", "#b15928", "#33a02c", "#e31a1c")
STYLE = """
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 1340px; padding: 0 1em;
       color: #222; background: #fff; }
h2 { border-top: 1px solid #ccc; margin-top: 2em; padding-top: 1em; }
table { border-collapse: collapse; margin: 1em 0; }
th, td { padding: .15em .7em; text-align: right; border-bottom: 1px solid #e4e4e4; }
th:first-child, td:first-child { text-align: left; }
svg { margin: .3em .5em .3em 0; }
svg .title { font: bold 12px sans-serif; } svg .tick { font: 10px sans-serif; fill: #555; }
svg .grid { stroke: #ddd; } svg polyline { fill: none; stroke-width: 1.6; }
.key span { margin-right: 1.4em; white-space: nowrap; }
.key i { display: inline-block; width: 1.6em; height: .25em; margin-right: .4em;
         vertical-align: middle; }
.sheet img { width: 192px; display: block; } .sheet td { border: 0; padding: 2px 4px; }
"""
# Title, path within a frame, whether the axis is logarithmic.
PLOTS = (("milliseconds per frame", ("ms",), True),
         ("rays per frame, without primary rays", ("rays",), True),
         ("relMSE against converged frames", ("errors", "converged", "relmse"), True),
         ("relMSE against ir with the same VPLs", ("errors", "same_vpls", "relmse"), True),
         ("HDR-VDP, published protocol: % seen",
          ("errors", "converged", "hdrvdp_published", "p75"), False),
         ("HDR-VDP on a display: % seen", ("errors", "converged", "hdrvdp_display", "p75"), False),
         ("flicker: excess change, PU21 units", ("errors", "flicker", "change"), False),
         ("flicker: % of pixels more than one unit", ("errors", "flicker", "unsteady"), False),
         ("flicker: % of pixels seen to change", ("errors", "flicker", "seen"), False),
         ("records kept", ("records", "kept"), False),
         ("records updated", ("records", "updated"), False),
         ("records made", ("records", "made"), False))
# Heading, path within a method, decimals.
COLUMNS = (("ms", ("ms",), 1), ("update, ms", ("update_ms",), 1), ("rays", ("rays",), 0),
           ("kept", ("records", "kept"), 0), ("updated", ("records", "updated"), 0),
           ("dropped", ("records", "dropped"), 0), ("made", ("records", "made"), 0),
           ("relMSE", ("errors", "relmse"), 5),
           ("same VPLs", ("errors", "relmse_same_vpls"), 5), ("VDP 75 %", ("errors", "vdp75"), 2),
           ("display", ("errors", "vdp75_display"), 2), ("flicker", ("flicker", "change"), 4),
           ("unsteady %", ("flicker", "unsteady"), 2), ("seen %", ("flicker", "seen"), 2))


class BadInput(Exception):
    """The folder does not hold what a page is made of."""


def at(value, path):
    """What lies at a path of keys, or None."""
    for key in path:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def cell(value, decimals):
    return "" if value is None else f"{value:,.{decimals}f}".replace(",", "\u202f")


def table(headings, rows):
    def line(tag, cells):
        return "<tr>" + "".join(f"<{tag}>{html.escape(str(c))}</{tag}>" for c in cells) + "</tr>"
    return "\n".join(["<table>", line("th", headings), *(line("td", row) for row in rows),
                      "</table>"])


def colours_of(names):
    spare = iter(SPARE * len(names))
    return {name: PALETTE.get(name) or next(spare) for name in names}


def key(colours):
    return ('<p class="key">' + "".join(f'<span><i style="background:{colour}"></i>'
                                        f"{html.escape(name)}</span>"
                                        for name, colour in colours.items()) + "</p>")


def method_table(methods):
    shown = [column for column in COLUMNS
             if any(at(method, column[1]) is not None for method in methods)]
    return table(["method", "light", *(column[0] for column in shown)],
                 [[method["method"], method["light"],
                   *(cell(at(method, path), decimals) for _, path, decimals in shown)]
                  for method in methods])


def class_table(methods):
    """Rays of every class, a frame."""
    classes = sorted({name for method in methods for name in method["rays_by_class"]})
    return table(["rays by class", *classes],
                 [[method["method"],
                   *(cell(method["rays_by_class"].get(name), 0) for name in classes)]
                  for method in methods])


def plots(methods, colours):
    drawn = []
    for title, path, logarithmic in PLOTS:
        series = {method["method"]: [at(frame, path) for frame in method["frames"]]
                  for method in methods}
        drawn.append(svg_plot.line_plot(title, series, colours, logarithmic))
    return "\n".join(plot for plot in drawn if plot)


def image(folder, entry):
    file = folder / "pictures" / pathlib.Path(entry["file"]).name
    try:
        data = base64.b64encode(file.read_bytes()).decode("ascii")
    except OSError as error:
        raise BadInput(f"{file}: {error.strerror}, expected an image of the report") from error
    return (f'<td><img alt="frame {entry["frame"]}" src="data:image/png;base64,{data}">'
            f'frame {entry["frame"]}</td>')


def contact_sheet(folder, sequence):
    """A row for the converged frames, and one for every method."""
    rows = [("converged", sequence.get("pictures", ()))]
    rows += [(method["method"], method.get("pictures", ())) for method in sequence["methods"]]
    lines = [f"<tr><td>{html.escape(name)}</td>"
             + "".join(image(folder, entry) for entry in entries) + "</tr>"
             for name, entries in rows if entries]
    if not lines:
        return ""
    return "\n".join(["<h3>Indirect light</h3>", '<table class="sheet">', *lines, "</table>"])


def sequence_part(folder, sequence):
    methods = sequence["methods"]
    colours = colours_of([method["method"] for method in methods])
    heading = f'{sequence["scene"]}: {sequence["happening"]}'
    return "\n".join([f"<h2>{html.escape(heading)}</h2>",
                      f'<p>{sequence["triangles"]} triangles, {sequence["moving_triangles"]} of '
                      "which may move.</p>",
                      method_table(methods), class_table(methods), key(colours),
                      plots(methods, colours), contact_sheet(folder, sequence)])


def validation_part(sequences):
    headings = ("frames", "compared", "differing", "connections_traced", "connections_affected")
    rows = [[f'{sequence["scene"]}: {sequence["happening"]}', method["method"],
             *(method[heading] for heading in headings)]
            for sequence in sequences for method in sequence["methods"]]
    return "<h2>Validation</h2>" + table(["sequence", "method",
                                     *(h.replace("_", " ") for h in headings)], rows)


def static_part(scenes):
    rows = []
    for scene in scenes:
        for method in scene["methods"]:
            rows.append([scene["scene"], method["method"], cell(method["ms"], 1),
                         cell(method["rays"], 0),
                         *(cell(at(method, (name, figure)), 5)
                           for name in ("relmse_path", "relmse_trimmed_path", "relmse_ir")
                           for figure in ("mean", "uncertainty"))])
    return "<h2>Scenes that hold still</h2>" + table(
        ["scene", "method", "ms", "rays", "relMSE", "±", "trimmed", "±", "to ir", "±"], rows)


def summary_part(summary):
    rows = [[name.replace("_", " "), f"{value:.4g}"] for name, value in summary.items()
            if isinstance(value, (int, float))]
    parts = [table(["summary", ""], rows)]
    events = summary.get("by_happening") or {}
    if events:
        figures = sorted({name for row in events.values() for name in row})
        parts.append(table(["by what happens", *(name.replace("_", " ") for name in figures)],
                           [[event, *(cell(row.get(name), 2) for name in figures)]
                            for event, row in events.items()]))
    return "\n".join(parts)


def page(folder, report):
    """The whole page."""
    machine, device = report["machine"], report["device"]
    about = (f'{report["size"]} × {report["size"]} pixels, {device["backend"]} on {device["name"]} '
             f'({machine["hardware_threads"]} hardware threads), Weft '
             f'{report["versions"]["weft"]}')
    parts = ["<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8">',
             "<title>Weft: bench dynamic</title>", f"<style>{STYLE}</style></head><body>",
             "<h1>Scenes that move</h1>", f"<p>{html.escape(about)}. The page docs/benchmarks.md "
             "says what the figures mean.</p>", summary_part(report["summary"])]
    if report["mode"] == "audit":
        parts.append(validation_part(report["sequences"]))
    elif report["mode"] == "static":
        parts.append(static_part(report["scenes"]))
    else:
        parts += [sequence_part(folder, sequence) for sequence in report["sequences"]]
    return "\n".join([*parts, "</body></html>", ""])


def read_report(file):
    try:
        report = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise BadInput(f"{file}: {error.strerror}, expected what bench dynamic --report "
                       "writes") from error
    except ValueError as error:
        raise BadInput(f"{file}: is no JSON ({error})") from error
    if not isinstance(report, dict) or report.get("benchmark") != "dynamic":
        raise BadInput(f"{file}: is no report of bench dynamic")
    return report


class Parser(argparse.ArgumentParser):
    """Fails as Weft's other programs do."""

    def error(self, message):
        self.exit(1, f"{self.prog}: {message}\n")


def main():
    parser = Parser(prog="dynamic_report.py", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="of --report")
    parser.add_argument("--output", type=pathlib.Path,
                        help="the page, by default dynamic.html in the folder")
    args = parser.parse_args()
    output = args.output or args.folder / "dynamic.html"
    try:
        text = page(args.folder, read_report(args.folder / "dynamic.json"))
    except BadInput as error:
        print(f"dynamic_report.py: {error}", file=sys.stderr)
        return EXIT_INPUT
    except (KeyError, TypeError) as error:
        print(f"dynamic_report.py: {args.folder / 'dynamic.json'}: lacks {error}, expected what "
              "this version of bench dynamic writes", file=sys.stderr)
        return EXIT_INPUT
    try:
        output.write_text(text, encoding="utf-8")
    except OSError as error:
        print(f"dynamic_report.py: {output}: {error.strerror}", file=sys.stderr)
        return EXIT_OUTPUT
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
