# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Things turned on a lathe whose outlines are smooth curves: bottles, glasses, bowls, fruit."""

import math

from .lofts import curve
from .solids import revolve


def smooth(points, steps=5):
    """An outline of (r, y) through `points`; those given as lists are corners, where the curve
    does not go on smoothly."""
    outline, run = [], []
    for k, point in enumerate(points):
        run.append((float(point[0]), float(point[1]), 0.0))
        if k == len(points) - 1 or (isinstance(point, list) and len(run) > 1):
            drawn = curve(run, steps)
            outline += drawn[1:] if outline else drawn
            run = [run[-1]]
    return _thinned([(max(x, 0.0), y) for x, y, _ in outline])


def _thinned(outline):
    """Without points at which it hardly turns, by less than about 4 degrees since the last."""
    kept = outline[:2]
    for k in range(2, len(outline)):
        (r0, y0), (r1, y1), (r2, y2) = kept[-2], kept[-1], outline[k]
        ar, ay, br, by = r1 - r0, y1 - y0, r2 - r1, y2 - y1
        along, aside = ar * br + ay * by, ar * by - ay * br
        if along > 0.0 and aside * aside < 0.005 * along * along:
            kept.pop()
        kept.append(outline[k])
    return kept


def offset(outline, distance):
    """An outline moved by `distance` to its left (inwards, where it goes up)."""
    moved = []
    for k, (r, y) in enumerate(outline):
        (r0, y0), (r1, y1) = outline[max(k - 1, 0)], outline[min(k + 1, len(outline) - 1)]
        dr, dy = r1 - r0, y1 - y0
        length = math.sqrt(dr * dr + dy * dy)
        moved.append((max(r - distance * dy / length, 0.0), y + distance * dr / length))
    return moved


def lip(outer, inner, steps=5):
    """A half circle from the last point of `outer` to the first of `inner`, over the rim."""
    (r0, y0), (r1, y1) = outer, inner
    r, y = 0.5 * (r0 + r1), 0.5 * (y0 + y1)
    dr, dy = r0 - r, y0 - y
    points = []
    for k in range(1, steps):
        c, s = math.cos(math.pi * k / steps), math.sin(math.pi * k / steps)
        points.append((r + c * dr - s * dy, y + c * dy + s * dr))
    return points


def vessel(outside, inside, segments=64):
    """A hollow solid: outlines of the outside, from the foot's middle to the rim, and of the
    inside, from the middle of its floor to the rim. The rim is rounded."""
    ring = outside + lip(outside[-1], inside[-1]) + inside[::-1]
    ring = [p for p in ring if p[0] > 1e-5]
    return revolve([(ring[0][0], ring[0][1])] + ring[1:], segments)


def level(inside, height, overlap, segments=64):
    """What fills a vessel up to a height: its outline is that of the vessel's inside, moved into
    the wall by `overlap`, and its top is flat."""
    wall = offset(inside, -overlap)
    below = []
    for (r0, y0), (r1, y1) in zip(wall, wall[1:]):
        below.append((r0, y0))
        if y0 < height <= y1:
            share = (height - y0) / (y1 - y0)
            below.append((r0 + share * (r1 - r0), height))
            break
    below = [p for p in below if p[0] > 1e-5]
    top = below[-1][0]
    return revolve(below + [(0.8 * top, height), (0.4 * top, height)], segments)
