# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Plots of figures over frames as SVG, which browsers show without any library."""

import html
import math

WIDTH, HEIGHT = 430, 230
LEFT, RIGHT, TOP, BOTTOM = 62, 8, 24, 24


def number(value):
    """A figure as short as a label of an axis has to be."""
    if value == 0.0:
        return "0"
    for unit, suffix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= unit:
            return f"{value / unit:.4g} {suffix}"
    return f"{value:.3g}"


def linear_ticks(low, high):
    """About four round numbers between two others."""
    if not high > low:
        return [low]
    step = 10.0 ** math.floor(math.log10((high - low) / 4.0))
    for factor in (1.0, 2.0, 5.0, 10.0):
        if (high - low) / (factor * step) <= 5.0:
            step *= factor
            break
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [i * step for i in range(first, last + 1)]


def logarithmic_ticks(low, high):
    """Powers of ten, and what lies between them where these are few."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    factors = (1, 2, 5) if len(powers) < 4 else (1,)
    every = math.ceil(len(powers) / 6)
    found = [f * 10.0 ** p for i, p in enumerate(powers) if i % every == 0 for f in factors]
    return [tick for tick in found if low * 0.999 <= tick <= high * 1.001]


class Axis:
    """Maps figures to heights."""

    def __init__(self, values, logarithmic):
        self.logarithmic = logarithmic
        low, high = min(values), max(values)
        if not logarithmic:
            low = min(low, 0.0)
            high = high + 0.05 * (high - low)
        if not high > low:
            low, high = (0.5 * low, 2.0 * high) if logarithmic else (low, low + 1.0)
        self.low, self.high = low, high
        self.ticks = logarithmic_ticks(low, high) if logarithmic else linear_ticks(low, high)

    def y(self, value):
        low, high = self.low, self.high
        if self.logarithmic:
            value, low, high = math.log(value), math.log(low), math.log(high)
        share = (value - low) / (high - low)
        return HEIGHT - BOTTOM - share * (HEIGHT - BOTTOM - TOP)


def runs(values, axis, x):
    """Points of a line, apart where a figure is missing."""
    run = []
    for frame, value in enumerate(values):
        if value is None:
            if run:
                yield run
            run = []
            continue
        run.append((x(frame), axis.y(value)))
    if run:
        yield run


def line_plot(title, series, colours, logarithmic=False):
    """An SVG of `series`, lists of figures by frame (None: there is none) by name; empty where
    there is nothing to show. A logarithmic one leaves out what is not above 0."""
    if logarithmic:
        series = {name: [v if v is not None and v > 0.0 else None for v in values]
                  for name, values in series.items()}
    known = [v for values in series.values() for v in values if v is not None]
    if not known:
        return ""
    axis = Axis(known, logarithmic)
    last = max(1, max(len(values) for values in series.values()) - 1)

    def x(frame):
        return LEFT + frame / last * (WIDTH - LEFT - RIGHT)

    parts = [f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" role="img">',
             f'<title>{html.escape(title)}</title>',
             f'<text x="{LEFT}" y="14" class="title">{html.escape(title)}</text>']
    for tick in axis.ticks:
        y = axis.y(tick)
        parts.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" '
                     f'y2="{y:.1f}"/><text class="tick" x="{LEFT - 4}" y="{y + 3.5:.1f}" '
                     f'text-anchor="end">{number(tick)}</text>')
    for frame in linear_ticks(0, last):
        if frame == int(frame):
            parts.append(f'<text class="tick" x="{x(frame):.1f}" y="{HEIGHT - 8}" '
                         f'text-anchor="middle">{int(frame)}</text>')
    for name, values in series.items():
        for run in runs(values, axis, x):
            points = " ".join(f"{px:.1f},{py:.1f}" for px, py in run)
            parts.append(f'<polyline points="{points}" stroke="{colours[name]}">'
                         f'<title>{html.escape(name)}</title></polyline>')
            parts += [f'<circle cx="{px:.1f}" cy="{py:.1f}" r="2" fill="{colours[name]}"/>'
                      for px, py in run]
    return "\n".join(parts + ["</svg>"])
