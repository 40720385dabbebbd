#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes one HTML page of what `./weft bench dynamic --report FOLDER` left in a folder.

The page holds everything, plots and images included, and needs nothing else to be seen. Needs
Matplotlib (Debian package python3-matplotlib):
    python3 bench/report/dynamic_report.py FOLDER
"""

import base64
import html
import itertools
import math
import pathlib
import sys

import plots
from report_file import EXIT_INPUT, EXIT_OUTPUT, BadInput, Parser, read_report, write_whole

# A method has the same style in every sequence.
METHODS = ("ais, tic", "ais", "tic", "tic, no masks", "igi", "ic", "irradiance-cache")
COLUMNS_OF_PLOTS = 3
STYLE = """
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 1340px; padding: 0 1em;
       color: #222; background: #fff; }
h2 { border-top: 1px solid #ccc; margin-top: 2em; padding-top: 1em; }
table { border-collapse: collapse; margin: 1em 0; }
th, td { padding: .15em .7em; text-align: right; border-bottom: 1px solid #e4e4e4; }
th:first-child, td:first-child { text-align: left; }
.plots { max-width: 100%; }
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


def styles_of(names):
    """A colour and a marker for every method."""
    styles = dict(zip(METHODS, plots.STYLES))
    spare = itertools.cycle(plots.STYLES[len(METHODS):])
    return {name: styles.get(name) or next(spare) for name in names}


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


def shown(value, logarithmic):
    """Not a number where there is none that the axis can show; lines are apart there."""
    return value if value is not None and (value > 0.0 or not logarithmic) else math.nan


def draw(axes, title, series, styles, logarithmic):
    """Lines over frames, by method."""
    for name, values in series.items():
        # Dots on an axis stay whole; the layout would give a line without any dot a place.
        axes.plot(values, label=name, gid=plots.identifier(title, name), clip_on=False,
                  in_layout=False, **styles[name])
    axes.set(title=title, xlabel="frame", xlim=(0, max(1, max(map(len, series.values())) - 1)))
    axes.xaxis.get_major_locator().set_params(integer=True)
    if logarithmic:
        axes.set_yscale("log")
    else:
        known = [v for values in series.values() for v in values if not math.isnan(v)]
        if min(known) >= 0.0:
            axes.set_ylim(0.0, 1.05 * max(known) or 1.0)
    plots.label_ticks(axes.yaxis)


def plots_part(heading, methods):
    """All plots of a sequence as one SVG within an HTML element, with one key for all."""
    styles = styles_of([method["method"] for method in methods])
    drawn = []
    for title, path, logarithmic in PLOTS:
        series = {method["method"]: [shown(at(frame, path), logarithmic)
                                     for frame in method["frames"]] for method in methods}
        if not all(math.isnan(value) for values in series.values() for value in values):
            drawn.append((title, series, styles, logarithmic))
    if not drawn:
        return ""
    rows = math.ceil(len(drawn) / COLUMNS_OF_PLOTS)
    figure = plots.figure(4.4 * COLUMNS_OF_PLOTS, 2.5 * rows + 0.5)
    # The key has a row of its own, which the layout makes as high as it needs.
    grid = figure.add_gridspec(rows + 1, COLUMNS_OF_PLOTS, height_ratios=[0.01] + [1.0] * rows)
    for i, plot in enumerate(drawn):
        row, column = divmod(i, COLUMNS_OF_PLOTS)
        draw(figure.add_subplot(grid[1 + row, column]), *plot)
    key = figure.add_subplot(grid[0, :])
    key.axis("off")
    key.legend(handles=figure.axes[0].lines, loc="upper left", ncols=len(METHODS),
               borderaxespad=0.0)
    title = f"{heading}, over frames"
    data = base64.b64encode(plots.svg(figure, title).encode("utf-8")).decode("ascii")
    return (f'<p><img class="plots" alt="{html.escape(title)}" '
            f'src="data:image/svg+xml;base64,{data}"></p>')


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
    heading = f'{sequence["scene"]}: {sequence["happening"]}'
    return "\n".join([f"<h2>{html.escape(heading)}</h2>",
                      f'<p>{sequence["triangles"]} triangles, {sequence["moving_triangles"]} of '
                      "which may move.</p>",
                      method_table(methods), class_table(methods),
                      plots_part(heading, methods), contact_sheet(folder, sequence)])


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


def main():
    parser = Parser(prog="dynamic_report.py", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="of --report")
    parser.add_argument("--output", type=pathlib.Path,
                        help="the page, by default dynamic.html in the folder")
    args = parser.parse_args()
    output = args.output or args.folder / "dynamic.html"
    try:
        report = read_report(args.folder / "dynamic.json", "dynamic", option="--report")
        text = page(args.folder, report)
    except BadInput as error:
        print(f"dynamic_report.py: {error}", file=sys.stderr)
        return EXIT_INPUT
    except (KeyError, TypeError) as error:
        print(f"dynamic_report.py: {args.folder / 'dynamic.json'}: lacks {error}, expected what "
              "this version of bench dynamic writes", file=sys.stderr)
        return EXIT_INPUT
    try:
        write_whole(output, text)
    except OSError as error:
        print(f"dynamic_report.py: {output}: {error.strerror}", file=sys.stderr)
        return EXIT_OUTPUT
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
