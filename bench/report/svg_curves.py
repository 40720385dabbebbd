# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Figures over a quantity as SVG files of their own, both axes logarithmic."""

import html

import svg_plot

LINE = 16  # height of a line of text
STYLE = ("svg{background:#fff} text{font-family:sans-serif;fill:#222} .title{font-weight:bold;"
         "font-size:12px} .tick{font-size:10px;fill:#555} .key{font-size:11px} "
         ".grid{stroke:#ddd} polyline{fill:none;stroke-width:1.6}")


class Curve:
    """Points (x, y) that a line joins; a dashed one has no dots."""

    def __init__(self, name, colour, points, dashed=False):
        self.name, self.colour, self.dashed = name, colour, dashed
        self.points = [(x, y) for x, y in points
                       if x is not None and y is not None and x > 0.0 and y > 0.0]


def across(axis, value):
    """Where a figure lies on an axis that runs to the right."""
    height = svg_plot.HEIGHT - svg_plot.BOTTOM - svg_plot.TOP
    share = (svg_plot.HEIGHT - svg_plot.BOTTOM - axis.y(value)) / height
    return svg_plot.LEFT + share * (svg_plot.WIDTH - svg_plot.LEFT - svg_plot.RIGHT)


def grid(x_axis, y_axis):
    right, bottom = svg_plot.WIDTH - svg_plot.RIGHT, svg_plot.HEIGHT - svg_plot.BOTTOM
    for tick in y_axis.ticks:
        y = y_axis.y(tick)
        yield (f'<line class="grid" x1="{svg_plot.LEFT}" x2="{right}" y1="{y:.1f}" y2="{y:.1f}"/>'
               f'<text class="tick" x="{svg_plot.LEFT - 4}" y="{y + 3.5:.1f}" '
               f'text-anchor="end">{svg_plot.number(tick)}</text>')
    for tick in x_axis.ticks:
        x = across(x_axis, tick)
        yield (f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{svg_plot.TOP}" y2="{bottom}"/>'
               f'<text class="tick" x="{x:.1f}" y="{svg_plot.HEIGHT - 8}" '
               f'text-anchor="middle">{svg_plot.number(tick)}</text>')


def drawn(curve, x_axis, y_axis):
    places = [(across(x_axis, x), y_axis.y(y)) for x, y in curve.points]
    dashes = ' stroke-dasharray="5 4"' if curve.dashed else ""
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    yield f'<polyline points="{line}" stroke="{curve.colour}"{dashes}/>'
    if not curve.dashed:
        yield from (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.5" fill="{curve.colour}"/>'
                    for x, y in places)


def key(curves):
    for i, curve in enumerate(curves):
        y = svg_plot.HEIGHT + LINE * (i + 1)
        dashes = ' stroke-dasharray="5 4"' if curve.dashed else ""
        yield (f'<polyline points="{svg_plot.LEFT},{y} {svg_plot.LEFT + 24},{y}" '
               f'stroke="{curve.colour}"{dashes}/><text class="key" x="{svg_plot.LEFT + 30}" '
               f'y="{y + 4}">{html.escape(curve.name)}</text>')


def curve_plot(title, x_label, curves):
    """The text of an SVG file; empty where no curve has a point."""
    curves = [curve for curve in curves if curve.points]
    if not curves:
        return ""
    x_axis = svg_plot.Axis([x for curve in curves for x, _ in curve.points], True)
    y_axis = svg_plot.Axis([y for curve in curves for _, y in curve.points], True)
    height = svg_plot.HEIGHT + LINE * (len(curves) + 1)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {svg_plot.WIDTH} {height}" '
             f'width="{svg_plot.WIDTH}" height="{height}" role="img">',
             f"<title>{html.escape(title)}</title><style>{STYLE}</style>",
             f'<text class="title" x="{svg_plot.LEFT}" y="14">{html.escape(title)}</text>',
             f'<text class="tick" x="{svg_plot.WIDTH - svg_plot.RIGHT}" '
             f'y="{svg_plot.HEIGHT + 4}" text-anchor="end">{html.escape(x_label)}</text>',
             *grid(x_axis, y_axis)]
    for curve in curves:
        parts += drawn(curve, x_axis, y_axis)
    return "\n".join([*parts, *key(curves), "</svg>", ""])
