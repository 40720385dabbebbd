# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Things in an office, as lists of closed solids by material, in metres, +y up."""

import math

from .lofts import curve, hoop, pillow, rim, rod, rounded_box, sweep, turned
from .noise import Choices
from .solids import box, moved, revolve

DESK_TOP = 0.735


def _handle(x, y, z, width):
    """A bow handle before a front in the plane z."""
    half = 0.5 * width
    path = curve([(x - half, y, z - 0.006), (x - half, y, z + 0.02), (x + half, y, z + 0.02),
                  (x + half, y, z - 0.006)], 4)
    return sweep(path, (0.0, 1.0, 0.0), (0.005, 0.004), 8)


def desk(length, depth):
    """A desk with drawers on its left; who sits at it looks towards -z. Origin on the floor."""
    x, z = 0.5 * length, 0.5 * depth
    top = rounded_box(x, z, DESK_TOP - 0.03, DESK_TOP, 0.02, 0.004)
    body = [box((-x + 0.04, 0.05, -z + 0.04), (-x + 0.46, DESK_TOP - 0.02, z - 0.06)),
            box((x - 0.07, -0.01, -z + 0.05), (x - 0.045, DESK_TOP - 0.025, z - 0.07)),
            box((-x + 0.44, 0.32, -z + 0.07), (x - 0.06, DESK_TOP - 0.022, -z + 0.09))]
    plinth = [box((-x + 0.06, -0.01, -z + 0.06), (-x + 0.44, 0.06, z - 0.09))]
    fronts, metal = [], []
    for y0, y1 in ((0.055, 0.335), (0.34, 0.52), (0.525, 0.698)):
        fronts.append(box((-x + 0.042, y0, z - 0.07), (-x + 0.458, y1, z - 0.042)))
        metal.append(_handle(-x + 0.25, 0.5 * (y0 + y1) + 0.03, z - 0.042, 0.13))
    metal.append(rod((x - 0.3, DESK_TOP - 0.002, -z + 0.1), (x - 0.3, DESK_TOP + 0.003, -z + 0.1),
                     0.03, 24))
    return {"beech": [top], "grey laminate": body, "white laminate": fronts, "dark metal": plinth,
            "steel": metal}


def monitor():
    """A flat monitor that faces +z; origin at its foot."""
    shell = turned(rounded_box(0.29, 0.185, -0.024, 0.022, 0.012, 0.004, 3), 0, 90.0)
    back = turned(rounded_box(0.2, 0.12, 0.02, 0.045, 0.03, 0.008, 3), 0, -90.0)
    lift = 0.36
    dark = [moved(shell, (0.0, lift, 0.0)), moved(back, (0.0, lift, 0.0)),
            moved(rim(0.286, 0.181, 0.014, 0.02, 0.0285), (0.0, lift, 0.0)),
            rounded_box(0.12, 0.085, -0.001, 0.011, 0.02, 0.003),
            sweep(curve([(0.0, 0.004, -0.045), (0.0, 0.12, -0.05), (0.0, 0.36, -0.03)], 4),
                  (1.0, 0.0, 0.0), (0.032, 0.01), 12)]
    y = lift - 0.172
    screen = [box((-0.278, y, 0.01), (0.278, lift + 0.172, 0.025))]
    windows = [box((-0.24, y + 0.06, 0.02), (0.06, lift + 0.13, 0.0256)),
               box((0.09, y + 0.11, 0.02), (0.25, lift + 0.15, 0.0257))]
    lines, choices = [], Choices(21)
    for k in range(11):
        row = lift + 0.1 - 0.021 * k
        indent = 0.02 * int(choices.between(0.0, 4.0))
        lines.append(box((-0.225 + indent, row, 0.021),
                         (-0.16 + indent + choices.between(0.0, 0.13), row + 0.008, 0.0262)))
    bars = [box((0.105 + 0.028 * k, y + 0.13, 0.021),
                (0.125 + 0.028 * k, y + 0.15 + choices.between(0.02, 0.16), 0.0263))
            for k in range(5)]
    return {"dark plastic": dark, "screen": screen, "paper": windows, "blue glaze": lines,
            "orange": bars}


def keyboard():
    """A keyboard and, on its right, a mouse; origin at its middle, on the desk."""
    keys, rows = [], 5
    for row in range(rows):
        z, x, slot = -0.052 + 0.0215 * row, -0.205, 0
        while x < 0.2:
            width = {(4, 3): 0.12, (2, 12): 0.04, (3, 0): 0.04}.get((row, slot), 0.0195)
            right = min(x + width, 0.206)
            height = 0.0215 - 0.0015 * row + 0.0004 * (slot % 2)
            keys.append(box((x + 0.0012, 0.006, z), (right - 0.0012, height, z + 0.019)))
            x, slot = x + width, slot + 1
    base = rounded_box(0.22, 0.068, -0.001, 0.0125, 0.01, 0.003, 3)
    mouse = pillow(0.03, 0.05, 0.022, 0.028, lambda x, y, z: (x, y * (1.0 - 60.0 * x * x), z),
                   crown=0.012)
    return {"dark plastic": [base, moved(mouse, (0.3, -0.001, 0.01))], "grey laminate": keys}


def desk_lamp():
    """The foot and the two arms of a lamp; its head hangs at (0.34, 0.42, 0)."""
    steel = [rod((0.0, 0.01, 0.0), (-0.1, 0.34, 0.0), 0.007, 10),
             rod((-0.1, 0.34, 0.0), (0.31, 0.5, 0.0), 0.006, 10),
             rod((-0.1, 0.34, -0.016), (-0.1, 0.34, 0.016), 0.014, 14),
             rod((0.31, 0.5, -0.014), (0.31, 0.5, 0.014), 0.012, 14),
             rod((0.31, 0.5, 0.0), (0.34, 0.465, 0.0), 0.008, 10)]
    foot = revolve([(0.085, -0.002), (0.088, 0.006), (0.08, 0.016), (0.03, 0.024),
                    (0.014, 0.034)], 36)
    return {"red enamel": [foot], "steel": steel}


def lamp_head(half):
    """A conical shade about the origin that opens downwards, and in it the square mounting of a
    light of 2 * `half`, at y = -0.03."""
    shade = revolve([(0.006, -0.012), (0.045, -0.012), (0.062, -0.015), (0.105, -0.085),
                     (0.108, -0.085), (0.066, -0.008), (0.034, 0.035), (0.03, 0.07),
                     (0.02, 0.075)], 40)
    mount = turned(rim(half + 0.006, half + 0.006, 0.01, 0.0, 0.034), 0, 90.0)
    return {"red enamel": [shade], "white laminate": [mount]}


def mug():
    """A mug with its handle towards +x; origin at its foot."""
    cup = revolve([(0.034, -0.001), (0.038, 0.004), (0.04, 0.09), (0.038, 0.092), (0.036, 0.088),
                   (0.035, 0.012)], 32)
    handle = sweep(curve([(0.037, 0.075, 0.0), (0.062, 0.074, 0.0), (0.066, 0.045, 0.0),
                          (0.037, 0.022, 0.0)], 4), (0.0, 0.0, 1.0), (0.006, 0.004), 8)
    return [cup, handle]


def pencil_cup():
    """A cup of pencils; origin at its foot."""
    cup = revolve([(0.037, -0.001), (0.037, 0.1), (0.034, 0.1), (0.033, 0.01)], 28)
    pencils, choices = [], Choices(5)
    for k in range(6):
        a = math.radians(60.0 * k + choices.between(-15.0, 15.0))
        c, s, lean = math.cos(a), math.sin(a), choices.between(0.022, 0.03)
        pencils.append(rod((-0.4 * lean * c, 0.009, -0.4 * lean * s),
                           (1.25 * lean * c, choices.between(0.14, 0.175), 1.25 * lean * s),
                           0.0036, 6))
    return {"dark plastic": [cup], "orange": pencils[:3], "blue glaze": pencils[3:]}


def letter_tray():
    """Two trays of papers above each other; origin at their foot."""
    trays, sheets, choices = [], [], Choices(9)
    for y in (0.0, 0.075):
        trays.append(box((-0.13, y - 0.001, -0.17), (0.13, y + 0.006, 0.17)))
        trays += [box((side * 0.13 - 0.003, y - 0.0015, -0.168), (side * 0.13 + 0.003, y + 0.05,
                                                                 0.168)) for side in (-1.0, 1.0)]
        trays.append(box((-0.131, y - 0.0012, -0.173), (0.131, y + 0.049, -0.167)))
        level = y + 0.005
        for _ in range(5):
            sheet = box((-0.105, level, -0.148), (0.105, level + choices.between(0.003, 0.006),
                                                  0.148))
            sheets.append(moved(turned(sheet, 1, choices.between(-2.5, 2.5)),
                                (choices.between(-0.012, 0.012), 0.0, choices.between(0.0, 0.02))))
            level += 0.003
    trays += [box((x - 0.004, 0.03, -0.16), (x + 0.004, 0.09, -0.15)) for x in (-0.128, 0.128)]
    return {"dark metal": trays, "paper": sheets}


def papers(seed, count):
    """Sheets that lie about on a desk."""
    choices, sheets = Choices(seed), []
    for k in range(count):
        sheet = box((-0.105, -0.001, -0.148), (0.105, 0.0008 + 0.0005 * k, 0.148))
        sheets.append(moved(turned(sheet, 1, choices.between(-24.0, 24.0)),
                            (choices.between(-0.09, 0.09), 0.0, choices.between(-0.05, 0.05))))
    return sheets


def cabinet(drawers):
    """A filing cabinet 0.46 m wide and 0.58 m deep that opens towards +z; origin on the floor."""
    pitch = 0.32
    height = 0.05 + drawers * pitch
    body = [box((-0.23, 0.03, -0.29), (0.23, height, 0.28)),
            box((-0.235, height - 0.012, -0.295), (0.235, height + 0.012, 0.295))]
    foot = [box((-0.215, -0.01, -0.28), (0.215, 0.04, 0.26))]
    fronts, metal, cards = [], [], []
    for k in range(drawers):
        y = 0.042 + k * pitch
        fronts.append(turned(moved(rounded_box(0.216, 0.5 * pitch - 0.008, 0.0, 0.03, 0.012, 0.004,
                                               3), (0.0, 0.265, -y - 0.5 * pitch)), 0, 90.0))
        metal.append(_handle(0.0, y + 0.17, 0.294, 0.12))
        metal.append(moved(rim(0.036, 0.02, 0.004, 0.29, 0.298), (0.0, y + 0.24, 0.0)))
        cards.append(box((-0.034, y + 0.222, 0.285), (0.034, y + 0.258, 0.2965)))
    metal.append(rod((0.17, height - 0.035, 0.29), (0.17, height - 0.035, 0.301), 0.009, 14))
    return {"green metal": body, "green fronts": fronts, "dark metal": foot, "steel": metal,
            "paper": cards}


def basket():
    """A waste basket of wire; origin on the floor."""
    low, high, height, count = 0.105, 0.15, 0.31, 40
    wires = [revolve([(low + 0.002, -0.002), (low + 0.004, 0.006)], 40)]
    for k in range(count):
        for twist in (-0.35, 0.35):
            a, b = 2.0 * math.pi * k / count, 2.0 * math.pi * k / count + twist
            wires.append(rod((low * math.cos(a), 0.002, low * math.sin(a)),
                             (high * math.cos(b), height, high * math.sin(b)), 0.0016, 4))
    for r, y, wire in ((high, height, 0.005), (low + 0.003, 0.008, 0.004)):
        ring = [(r + wire * math.cos(2.0 * math.pi * k / 6), y + wire * math.sin(
            2.0 * math.pi * k / 6)) for k in range(6)]
        wires.append(hoop(ring, 40))
    return wires


def rug_stripes(length, width, count):
    """Stripes across a rug that lies along x, a little proud of it."""
    solids = []
    for k in range(count):
        at = -0.5 * length + length * (k + 0.5) / count
        solids.append(box((at - 0.022, 0.002, -0.5 * width + 0.05),
                          (at + 0.022, 0.0155, 0.5 * width - 0.05)))
    return solids
