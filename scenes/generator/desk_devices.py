# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A monitor, a keyboard and a mouse, in metres, +y up, looking along +z."""

import math

from .forms import bevelled, cushion, lofted, rod, rounded
from .solids import moved, plate

SCREEN = (0.56, 0.335)  # of the monitor: what is inside of its frame
SCREEN_Y, SCREEN_Z = 0.33, 0.012
PITCH = 0.019
# Widths of the keys of each row in units of the pitch, the row at the back first.
ROWS = ((1.0,) * 15, (1.0,) * 13 + (2.0,), (1.5,) + (1.0,) * 12 + (1.5,),
        (1.75,) + (1.0,) * 11 + (2.25,), (2.25,) + (1.0,) * 10 + (2.75,),
        (1.25, 1.25, 1.25, 6.25, 1.25, 1.25, 1.25, 1.25))
KEYBOARD = (15.0 * PITCH + 0.02, 6.0 * PITCH + 0.02)


def monitor():
    """Case, frame, neck and foot; the foot stands on the origin."""
    x, y, rim = 0.5 * SCREEN[0], 0.5 * SCREEN[1], 0.012
    xs, ys = (-x - rim, -x, x, x + rim), (-y - rim, -y, y, y + rim)
    frame = plate(xs, ys, lambda u, v: (u, v + SCREEN_Y, 0.018),
                  lambda u, v: (u, v + SCREEN_Y, -0.004), lambda i, j: (i, j) != (1, 1))
    foot = lofted([rounded(0.25 - i, 0.18 - i, 0.03, 5, h) for i, h in (
        (0.004, -0.001), (0.0, 0.003), (0.0, 0.009), (0.006, 0.012))])
    return [bevelled((-x - rim - 0.001, SCREEN_Y - y - rim - 0.001, -0.016),
                     (x + rim + 0.001, SCREEN_Y + y + rim + 0.001, 0.007), 0.004),
            bevelled((-0.14, SCREEN_Y - 0.1, -0.045), (0.14, SCREEN_Y + 0.1, -0.012), 0.012),
            bevelled((-0.028, 0.005, -0.062), (0.028, SCREEN_Y + 0.05, -0.04), 0.004),
            frame, moved(foot, (0.0, 0.0, -0.03))]


def keyboard():
    """The body, which rises to the back; its front edge is at +z."""
    w, d = KEYBOARD

    def sloped(y):
        return lambda p: (p[0], p[1] + (y if p[1] > 0.004 else 0.0) * (0.5 - p[2] / d), p[2])
    return [cushion(w, d, 0.016, 0.008, 0.003, 3, sloped(0.012))]


def key():
    """A key of one pitch; nodes stretch it along x."""
    rings = []
    for width, y in ((0.0172, -0.004), (0.0172, 0.003), (0.0146, 0.0078), (0.0128, 0.0085)):
        rings.append(rounded(width, width, 0.0022, 1, y))
    return [lofted(rings)]


def keys():
    """Where the keys are: (x, y, z, width in pitches, row, number in the row)."""
    w, d = KEYBOARD
    found = []
    for row, widths in enumerate(ROWS):
        x = -0.5 * sum(widths)
        z = (row - 2.5) * PITCH
        for number, width in enumerate(widths):
            y = 0.0155 + 0.012 * (0.5 - z / d)
            found.append(((x + 0.5 * width) * PITCH, y, z, width, row, number))
            x += width
    return found


def mouse():
    def arched(p):
        return p[0], p[1] * (1.0 - 60.0 * (p[2] - 0.01) ** 2) if p[1] > 0.004 else p[1], p[2]
    return [cushion(0.062, 0.108, 0.034, 0.029, 0.014, 6, arched),
            rod((-0.003, 0.029, -0.028), (0.003, 0.029, -0.028), 0.009, 14)]


def mouse_cable(first, middle, last):
    """Points of a curve on the table through three places."""
    points = []
    for k in range(17):
        t = k / 16
        a, b, c = (1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t
        wave = 0.006 * math.sin(9.0 * t)
        points.append((a * first[0] + b * middle[0] + c * last[0] + wave, first[1],
                       a * first[2] + b * middle[2] + c * last[2]))
    return points
