# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Things in a conference room, as lists of closed solids by material, in metres, +y up."""

import math

from .lofts import curve, loft, rim, rod, rounded_box, sweep, turned
from .noise import Choices
from .solids import box, extrude, moved, plate, revolve, sphere

TABLE_TOP, TABLE_HALF_LENGTH = 0.745, 3.1


def table_half_width(z):
    """Half the width of the table at z: it narrows towards its ends."""
    share = z / TABLE_HALF_LENGTH
    return 0.84 - 0.2 * share * share


def _table_outline(inset):
    """The table's outline, with rounded corners, drawn in by `inset`."""
    end, corner, points = TABLE_HALF_LENGTH - inset, 0.16, []
    side = [(table_half_width(z) - inset, z) for z in
            ((end - corner) * k / 10 for k in range(-10, 11))]
    for k in range(1, 7):
        a = 0.5 * math.pi * k / 6
        side.append((side[20][0] - corner * (1.0 - math.cos(a)),
                     end - corner + corner * math.sin(a)))
    side = [(x, -z) for x, z in side[:20:-1]] + side
    return points + side + [(-x, z) for x, z in side[::-1]]


def table():
    """A long table on three pedestals, its length along z; origin on the floor."""
    def ring(inset, y):
        return [(x, y, z) for x, z in _table_outline(inset)]
    top = loft([ring(0.006, TABLE_TOP - 0.028), ring(0.0, TABLE_TOP - 0.02),
                ring(0.0, TABLE_TOP - 0.006), ring(0.006, TABLE_TOP)])
    under = loft([ring(0.05, TABLE_TOP - 0.06), ring(0.03, TABLE_TOP - 0.02)])
    legs, inlay = [], []
    for z in (-2.2, 0.0, 2.2):
        legs += [moved(rounded_box(0.2, 0.3, 0.03, TABLE_TOP - 0.04, 0.06, 0.01), (0.0, 0.0, z)),
                 moved(rounded_box(0.46, 0.36, -0.004, 0.045, 0.06, 0.012), (0.0, 0.0, z))]
    for z in (-1.9, -0.65, 0.65, 1.9):
        inlay.append(moved(rounded_box(0.11, 0.2, TABLE_TOP - 0.01, TABLE_TOP + 0.003, 0.015,
                                       0.002), (0.0, 0.0, z)))
        inlay += [box((x - 0.012, TABLE_TOP, z - 0.16), (x + 0.012, TABLE_TOP + 0.006, z + 0.16))
                  for x in (-0.05, 0.05)]
    return {"cherry": [top], "dark wood": [under] + legs, "dark metal": inlay}


def glass(radius, height):
    """A drinking glass; origin at its foot."""
    return revolve([(0.82 * radius, -0.001), (0.86 * radius, 0.004), (radius, height),
                    (radius - 0.002, height + 0.0015), (radius - 0.004, height - 0.001),
                    (0.8 * radius, 0.012)], 28)


def carafe():
    """A carafe with a stopper; origin at its foot."""
    outside = [(0.05, -0.001), (0.056, 0.006), (0.058, 0.03), (0.057, 0.1), (0.05, 0.14),
               (0.034, 0.175), (0.024, 0.2), (0.022, 0.23), (0.028, 0.25)]
    stopper = moved(sphere(2, lambda d: 0.02), (0.0, 0.268, 0.0))
    return [revolve(outside + [(0.025, 0.252), (0.018, 0.235)], 32), stopper]


def place_setting():
    """What lies before a seat, at the edge z = 0 of the table towards +z: a pad with a pen, a
    glass, a name plate, a microphone. Origin on the table."""
    y0, choices = -0.001, Choices(31)
    pad = [turned(box((-0.105, y0, -0.36), (0.105, 0.006, -0.07)), 1, 4.0)]
    lines = [turned(box((-0.085, 0.004, z), (choices.between(-0.02, 0.085), 0.0064, z + 0.004)), 1,
                    4.0) for z in (-0.32 + 0.022 * k for k in range(7))]
    pen = [rod((0.02, 0.0105, -0.12), (0.09, 0.0105, -0.24), 0.0045, 8),
           rod((0.09, 0.0105, -0.24), (0.096, 0.009, -0.251), 0.0045, 8, 0.001)]
    plate_profile = [(-0.04, y0), (0.04, y0), (0.003, 0.085), (-0.003, 0.085)]
    name = [moved(extrude(plate_profile, lambda z, y, x: (x, y, z), -0.11, 0.11),
                  (0.0, 0.0, -0.46))]
    name_lines = [moved(turned(box((-0.075, 0.03, -0.0007), (0.075, 0.05, 0.002)), 0, 23.5),
                        (0.0, -0.001, -0.5))]
    stem = curve([(-0.19, 0.01, -0.42), (-0.19, 0.16, -0.415), (-0.19, 0.27, -0.37),
                  (-0.19, 0.31, -0.3)], 5)
    microphone = [moved(rounded_box(0.05, 0.06, y0, 0.022, 0.02, 0.006), (-0.19, 0.0, -0.42)),
                  sweep(stem, (1.0, 0.0, 0.0), (0.004, 0.004), 8),
                  rod((-0.19, 0.305, -0.309), (-0.19, 0.335, -0.25), 0.0085, 14)]
    return {"paper": pad + name, "ink": lines + name_lines, "steel": pen,
            "dark plastic": microphone,
            "pale glass": [moved(glass(0.034, 0.11), (0.19, 0.0, -0.3))]}


def water_tray():
    """A round tray with a carafe and glasses, some of them upside down."""
    tray = revolve([(0.15, -0.001), (0.17, 0.012), (0.173, 0.012), (0.155, 0.004)], 44)
    glasses = []
    for k in range(5):
        a = math.radians(62.0 * k + 20.0)
        one = glass(0.032, 0.1)
        glasses.append(moved(turned(one, 0, 180.0), (0.105 * math.cos(a), 0.106,
                                                     0.105 * math.sin(a))))
    return {"steel": [tray], "pale glass": glasses,
            "carafe": [moved(s, (0.0, 0.005, 0.0)) for s in carafe()]}


def laptop():
    """An open laptop that faces +z; origin on the table."""
    base = rounded_box(0.165, 0.115, -0.001, 0.015, 0.012, 0.003, 3)
    lid = turned(rounded_box(0.165, 0.108, -0.004, 0.004, 0.012, 0.002, 3), 0, 72.0)
    lid = moved(lid, (0.0, 0.116, -0.147))
    screen = moved(turned(box((-0.152, 0.0, -0.093), (0.152, 0.0046, 0.095)), 0, 72.0),
                   (0.0, 0.116, -0.147))
    keys = [box((-0.14 + 0.0202 * i, 0.01, -0.075 + 0.0202 * j),
                (-0.122 + 0.0202 * i, 0.0165, -0.057 + 0.0202 * j))
            for j in range(5) for i in range(14)]
    return {"grey metal": [base, lid], "display": [screen], "dark plastic": keys}


def screen(half_x, half_y):
    """A projection screen with a slide on it, in the plane z = 0 and before it."""
    frame = [rim(half_x, half_y, 0.05, -0.01, 0.04)]
    sheet = [box((0.03 - half_x, 0.03 - half_y, -0.008), (half_x - 0.03, half_y - 0.03, 0.02))]
    ink, bars, accents, choices = [], [], [], Choices(41)
    left, top = 0.14 - half_x, half_y - 0.16
    ink.append(box((left, top - 0.11, 0.0), (left + 1.15, top, 0.0208)))
    for k in range(7):
        y = top - 0.32 - 0.14 * k
        accents.append(box((left, y - 0.04, 0.0), (left + 0.04, y, 0.0209)))
        ink.append(box((left + 0.08, y - 0.035, 0.0),
                       (left + 0.08 + choices.between(0.45, 0.95), y - 0.003, 0.0208)))
    low, right = 0.16 - half_y, half_x - 0.14
    ink += [box((right - 1.1, low, 0.0), (right, low + 0.015, 0.0207)),
            box((right - 1.098, low + 0.002, 0.0), (right - 1.084, low + 0.95, 0.0206))]
    for k in range(6):
        x = right - 1.03 + 0.17 * k
        height = 0.2 + 0.1 * k + choices.between(0.0, 0.14)
        (accents if k == 4 else bars).append(box((x, low + 0.004, 0.0),
                                                 (x + 0.11, low + height, 0.0208)))
    return {"dark plastic": frame, "sheet": sheet, "ink": ink, "blue": bars, "orange": accents}


def lectern():
    """A lectern whose speaker looks towards +z; origin on the floor."""
    foot = rounded_box(0.32, 0.26, -0.005, 0.035, 0.03, 0.008)
    front = turned(rounded_box(0.29, 0.5, -0.022, 0.022, 0.02, 0.005), 0, 90.0)
    column = rounded_box(0.13, 0.09, 0.02, 1.05, 0.03, 0.006)
    desk = turned(rounded_box(0.33, 0.24, -0.015, 0.02, 0.02, 0.005), 0, -14.0)
    ledge = turned(box((-0.31, 0.0, -0.235), (0.31, 0.045, -0.215)), 0, -14.0)
    page = turned(box((-0.105, 0.01, -0.15), (0.105, 0.0225, 0.147)), 0, -14.0)
    stem = curve([(0.2, 1.08, 0.14), (0.2, 1.25, 0.14), (0.19, 1.34, 0.09), (0.17, 1.37, 0.02)], 5)
    return {"cherry": [moved(front, (0.0, 0.56, 0.12))] + [moved(s, (0.0, 1.1, 0.0))
                                                            for s in (desk, ledge)],
            "dark wood": [foot, column],
            "dark plastic": [sweep(stem, (0.0, 0.0, 1.0), (0.005, 0.005), 8),
                             rod((0.175, 1.366, 0.03), (0.162, 1.375, -0.03), 0.01, 12)],
            "paper": [moved(page, (0.0, 1.1, 0.0))]}


def batten(height):
    """An upright batten of a panelled wall, proud of the plane x = 0."""
    return [moved(rounded_box(0.026, 0.02, 0.085, height, 0.012, 0.004, 2), (0.012, 0.0, 0.0))]


def curtain(length, top):
    """A curtain in folds, along z from 0; it hangs at x = 0 and does not reach the floor."""
    count = round(length / 0.016)

    def face(offset):
        def at(u, v):
            z = length * u
            spread = 1.0 - 0.35 * v
            wave = math.sin(2.0 * math.pi * z / 0.17 + 0.9 * math.sin(2.3 * z))
            return (offset + 0.045 * spread * wave, 0.015 + (top - 0.015) * v,
                    z + 0.012 * math.sin(7.0 * z + 2.0 * v))
        return at
    us = [k / count for k in range(count + 1)]
    return [plate(us, (0.0, 0.5, 1.0), face(-0.0015), face(0.0015))]


def credenza(length):
    """A low cupboard along z whose doors face +x; origin on the floor, at its middle."""
    half = 0.5 * length
    body = [box((-0.22, 0.08, -half), (0.2, 0.78, half))]
    top = [rounded_box(0.24, half + 0.02, 0.77, 0.805, 0.01, 0.004)]
    foot = [box((-0.2, -0.01, -half + 0.03), (0.16, 0.09, half - 0.03))]
    count = round(length / 0.55)
    fronts, metal = [], []
    for k in range(count):
        z0, z1 = -half + length * k / count, -half + length * (k + 1) / count
        fronts.append(box((0.19, 0.09, z0 + 0.004), (0.219, 0.765, z1 - 0.004)))
        z = z1 - 0.06 if k % 2 == 0 else z0 + 0.06
        metal.append(rod((0.236, 0.5, z), (0.236, 0.66, z), 0.006, 10))
        metal += [rod((0.21, y, z), (0.237, y, z), 0.004, 8) for y in (0.52, 0.64)]
    return {"dark wood": body + foot, "cherry": top + fronts, "steel": metal}


def pendant(half_length):
    """The housing of a long luminaire, along z about the origin, open below, and its wires."""
    profile = [(-0.075, -0.03), (-0.062, -0.03), (-0.062, 0.0), (0.062, 0.0), (0.062, -0.03),
               (0.075, -0.03), (0.075, 0.03), (0.06, 0.05), (-0.06, 0.05), (-0.075, 0.03)]
    housing = [extrude(profile, lambda x, y, z: (x, y, z), -half_length, half_length)]
    ends = [box((-0.077, -0.032, side * half_length - 0.012),
                (0.077, 0.052, side * half_length + 0.012)) for side in (-1.0, 1.0)]
    return {"grey metal": housing + ends}


def projector(drop):
    """A projector on a rod from the ceiling, looking along -z; origin at its middle."""
    body = rounded_box(0.17, 0.13, -0.05, 0.05, 0.03, 0.012)
    return {"white paint": [body],
            "dark plastic": [rod((0.07, 0.005, -0.11), (0.07, 0.005, -0.15), 0.034, 20),
                             rod((0.0, 0.04, 0.0), (0.0, drop, 0.0), 0.018, 14)]}
