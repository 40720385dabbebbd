# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What plots of reports share: Matplotlib's settings, axes and colours, and SVG as text."""

import io
import logging
import pathlib
import re
import sys

import report_file

# What it warns of, such as a home folder that cannot be written, does not concern a report.
logging.getLogger("matplotlib").setLevel(logging.ERROR)
try:
    import matplotlib
    from matplotlib import ticker
    from matplotlib.figure import Figure
except ImportError as error:
    print(f"{pathlib.Path(sys.argv[0]).name}: {error}, expected Matplotlib in "
          f"{sys.executable or 'this Python'} (Debian package python3-matplotlib)",
          file=sys.stderr)
    sys.exit(report_file.EXIT_MISSING)

# Colours have a contrast of 3 or more with white; markers serve those who see few colours.
STYLES = tuple({"color": colour, "marker": marker} for colour, marker in (
    ("#0072b2", "o"), ("#d55e00", "s"), ("#009e73", "^"), ("#b8598f", "D"), ("#b97f00", "v"),
    ("#3a9bd4", "P"), ("#5a5a5a", "X"), ("#6a3d9a", "<"), ("#857500", "p"), ("#e31a1c", ">")))

# Not those of whoever runs the program, so that the same report gives the same plots.
matplotlib.rcdefaults()
matplotlib.rcParams.update({
    "axes.axisbelow": True, "axes.edgecolor": "#555555", "axes.grid": True,
    "axes.spines.right": False, "axes.spines.top": False, "axes.titlelocation": "left",
    "axes.titlesize": "medium", "axes.titleweight": "bold", "font.size": 9.0,
    "grid.color": "#dddddd", "legend.frameon": False, "legend.handlelength": 2.6,
    "lines.linewidth": 1.4, "lines.markersize": 4.0,
    "svg.fonttype": "none",     # text, which can be searched
    "svg.hashsalt": "weft",     # else ids are random
    "text.parse_math": False})  # a name may hold $


def number(value, _position=None):
    """A figure as short as a label of an axis has to be."""
    if abs(value) >= 1000.0:
        return ticker.EngFormatter(sep="\N{THIN SPACE}")(value)
    return f"{value:g}"


def figure(width, height):
    """Sizes in inches, 72 points of SVG each."""
    # Not "constrained": its solver differs in the last bits from run to run, and so do ids then.
    return Figure(figsize=(width, height), layout="tight")


def label_ticks(axis):
    """Short figures. Call it once all is drawn: logarithmic axes that are short have ticks between
    powers of ten, too."""
    axis.set_major_formatter(number)
    if axis.get_scale() == "log":
        low, high = axis.get_view_interval()
        if high < 1000.0 * low:
            factors = (1.0, 2.0, 3.0, 4.0, 6.0, 8.0) if high < 10.0 * low else (1.0, 2.0, 5.0)
            axis.set_major_locator(ticker.LogLocator(subs=factors))
        axis.set_minor_formatter(ticker.NullFormatter())


def identifier(*names):
    """What a line is called in SVG; see set_gid of Matplotlib's artists."""
    return re.sub(r"\W+", "-", " ".join(names))


def svg(drawing, title):
    """The text of an SVG file, the same whenever it is made."""
    text = io.StringIO()
    drawing.savefig(text, format="svg", metadata={"Date": None, "Title": title})
    return text.getvalue()
