# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What rooms have in common: ceilings with luminaires, doors, blinds, pictures, plants."""

from .lofts import curve, hoop, loft, rim, rod, sweep, turned
from .noise import Choices
from .solids import box, moved, plate, revolve, sphere

SLAT_PITCH, SLAT_WIDTH = 0.043, 0.05
DOOR_WIDTH, DOOR_HEIGHT = 0.86, 2.06  # of the opening in the wall


def ceiling(x0, x1, z0, z1, height, thick, openings):
    """A ceiling with rectangular openings (x0, x1, z0, z1) for luminaires."""
    xs = sorted({x0, x1, *(x for o in openings for x in o[:2])})
    zs = sorted({z0, z1, *(z for o in openings for z in o[2:])})

    def keep(i, j):
        return not any(o[0] <= xs[i] < o[1] and o[2] <= zs[j] < o[3] for o in openings)

    return [plate(xs, zs, lambda x, z: (x, height, z), lambda x, z: (x, height + thick, z), keep)]


def ceiling_bars(x0, x1, z0, z1, height, openings, edge=0.6):
    """The bars between tiles; those that would cross an opening end at its rim. Bars of the two
    directions hang down by different lengths, so that no faces share a plane."""
    solids = []
    for k in range(1, round((x1 - x0) / edge)):
        x = x0 + k * edge
        spans = _spans(z0, z1, [o[2:] for o in openings if o[0] < x < o[1]])
        solids += [box((x - 0.012, height - 0.005, a), (x + 0.012, height + 0.03, b))
                   for a, b in spans]
    for k in range(1, round((z1 - z0) / edge)):
        z = z0 + k * edge
        spans = _spans(x0, x1, [o[:2] for o in openings if o[2] < z < o[3]])
        solids += [box((a, height - 0.004, z - 0.0115), (b, height + 0.029, z + 0.0115))
                   for a, b in spans]
    return solids


def _spans(first, last, gaps):
    spans, at = [], first - 0.03
    for low, high in sorted(gaps):
        spans.append((at, low - 0.001))
        at = high + 0.001
    return spans + [(at, last + 0.03)]


def luminaire_rim(half_x, half_z, width, depth, height):
    """A frame about the y axis around an opening of a ceiling, which it hangs down from by
    `depth`; its inside reaches up to `height`."""
    return [turned(rim(half_x, half_z, width, -height, depth), 0, 90.0)]


def downlight_ring(radius):
    """The round trim of a small square opening, on the ceiling at y = 0."""
    profile = [(radius, -0.004), (radius + 0.004, -0.009), (radius + 0.03, -0.006),
               (radius + 0.036, 0.004), (radius + 0.001, 0.012)]
    return [hoop(profile, 32)]


def door():
    """A door in its frame, in a wall whose face is z = 0, seen from +z; origin on the floor."""
    half, top = 0.5 * DOOR_WIDTH, DOOR_HEIGHT
    leaf = [box((-half - 0.02, -0.02, -0.07), (half + 0.02, top + 0.02, -0.03))]
    for y0, y1 in ((0.16, 0.92), (1.06, 1.92)):
        for x0, x1 in ((-half + 0.1, -0.04), (0.04, half - 0.1)):
            centre = (0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.0)
            leaf.append(moved(rim(0.5 * (x1 - x0), 0.5 * (y1 - y0), 0.022, -0.05, -0.022), centre))
    frame = []
    for side in (-1.0, 1.0):
        x0, x1 = sorted((side * (half - 0.025), side * (half + 0.08)))
        frame.append(box((x0, -0.015, -0.06), (x1, top + 0.03, 0.018)))
    frame.append(box((-half - 0.095, top - 0.02, -0.061), (half + 0.095, top + 0.09, 0.022)))
    metal = [box((-half + 0.055, 0.95, -0.04), (-half + 0.095, 1.13, -0.024)),
             rod((-half + 0.075, 1.06, -0.035), (-half + 0.075, 1.06, 0.028), 0.01, 12),
             sweep(curve([(-half + 0.062, 1.06, 0.02), (-half + 0.1, 1.06, 0.026),
                          (-half + 0.2, 1.058, 0.022)], 3), (0.0, 1.0, 0.0), (0.011, 0.008), 10),
             rod((-half + 0.075, 0.99, -0.034), (-half + 0.075, 0.99, -0.019), 0.012, 14)]
    metal += [rod((half - 0.03, y, -0.028), (half - 0.03, y + 0.1, -0.028), 0.009, 10)
              for y in (0.22, 1.0, 1.74)]
    return {"leaf": leaf, "frame": frame, "metal": metal}


def slat(length, degrees):
    """A bent slat of a blind, along z; at `degrees` its edge at +x is low."""
    columns = [0.5 * SLAT_WIDTH * k / 5 for k in range(-5, 6)]

    def face(lift):
        return lambda x, z: (x, lift - 3.2 * x * x, z)
    solid = plate(columns, (0.0, length), face(0.0004), face(-0.0004))
    return [turned(solid, 2, -degrees)]


def blind_gear(length, top, bottom):
    """The head rail, the bottom rail and the cords of a blind, along z from 0."""
    solids = [box((-0.028, top, 0.0), (0.028, top + 0.04, length)),
              box((-0.024, bottom - 0.014, 0.002), (0.024, bottom, length - 0.002))]
    for share in (0.12, 0.5, 0.88):
        z = share * length
        for x in (-0.027, 0.0255):
            solids.append(box((x, bottom - 0.006, z - 0.002), (x + 0.0015, top + 0.01, z + 0.002)))
    solids.append(rod((0.03, top + 0.02, 0.09), (0.034, top - 0.7, 0.09), 0.004, 8))
    return solids


def picture(half_x, half_y, seed):
    """A framed picture of coloured fields, in the plane z = 0 and before it: solids by part."""
    choices, bar = Choices(seed), 0.028
    parts = {"frame": [rim(half_x, half_y, bar, -0.01, 0.022)],
             "mat": [box((bar - half_x - 0.01, bar - half_y - 0.01, -0.008),
                         (half_x - bar + 0.01, half_y - bar + 0.01, 0.008))]}
    inner_x, inner_y = 0.68 * half_x, 0.7 * half_y
    y, lift = -inner_y, 0.0085
    while y < inner_y - 0.01:
        top = min(y + choices.between(0.12, 0.5) * half_y, inner_y)
        x = -inner_x
        while x < inner_x - 0.01:
            right = min(x + choices.between(0.2, 0.9) * half_x, inner_x)
            which = f"field {1 + int(choices.between(0.0, 4.0))}"
            lift += 0.00003
            parts.setdefault(which, []).append(box((x, y, 0.0), (right - 0.004, top - 0.004, lift)))
            x = right
        y = top
    return parts


def leaf(length, width, droop):
    """A leaf that begins at the origin, rises and bends outwards along +x."""
    rings, count = [], 7
    for k in range(count + 1):
        t = k / count
        x = length * t * (0.75 + 0.25 * t)
        y = length * (0.62 * t - droop * t * t)
        half = max(width * 2.2 * t * (1.0 - t) * (1.35 - 0.7 * t), 0.0022)
        fold = 0.25 * half
        rings.append([(x, y + fold, half), (x, y + 0.0012, 0.0), (x, y + fold, -half),
                      (x, y + fold - 0.0012, -half), (x, y - 0.0012, 0.0),
                      (x, y + fold - 0.0012, half)])
    return loft(rings)


def plant(seed, leaves, size, foot):
    """Leaves in tiers about stems that grow from (0, foot, 0)."""
    choices, green = Choices(seed), []
    for k in range(leaves):
        t = (k + 0.5) / leaves
        length = size * choices.between(0.75, 1.1) * (1.0 - 0.45 * t)
        blade = leaf(length, 0.19 * length, choices.between(0.35, 0.8) * (1.25 - t))
        blade = turned(blade, 2, 58.0 * t * t + choices.between(-6.0, 8.0))
        blade = turned(blade, 1, 137.508 * k + choices.between(-9.0, 9.0))
        green.append(moved(blade, (choices.between(-0.012, 0.012), foot + 0.55 * size * t,
                                   choices.between(-0.012, 0.012))))
    for k in range(3):
        lean = turned(rod((0.014, foot - 0.05, 0.0), (0.004, foot + 0.56 * size, 0.0), 0.009, 7,
                          0.004), 1, 120.0 * k)
        green.append(lean)
    return green


def pot(radius, height):
    """A tapered pot with a rim and the soil in it; origin at its foot."""
    profile = [(0.66, -0.004), (0.7, 0.02), (0.92, 0.86), (1.0, 0.88), (1.0, 1.0), (0.9, 1.0),
               (0.88, 0.9), (0.8, 0.5)]
    clay = revolve([(radius * r, height * y) for r, y in profile], 40)
    soil = [(radius * 0.86, height * 0.6), (radius * 0.875, height * 0.86),
            (radius * 0.5, height * 0.89), (radius * 0.2, height * 0.9)]
    return {"pot": [clay], "soil": [revolve(soil, 24)]}


def skirting(x0, x1, z0, z1, gaps=()):
    """Skirting boards of the back wall, with gaps (x, x) for doors, and of both side walls."""
    solids = [box((x0 - 0.04, -0.012, z0 - 0.1), (x0 + 0.016, 0.1, z1 + 0.1)),
              box((x1 - 0.016, -0.013, z0 - 0.1), (x1 + 0.04, 0.099, z1 + 0.1))]
    at = x0 - 0.1
    for low, high in (*sorted(gaps), (x1 + 0.1, None)):
        solids.append(box((at, -0.011, z0 - 0.04), (low, 0.098, z0 + 0.015)))
        at = high
    return solids


def clock(radius):
    """A wall clock that faces +z: solids by part."""
    body = revolve([(radius, -0.01), (radius, 0.03), (radius * 0.94, 0.036),
                    (radius * 0.9, 0.036), (radius * 0.89, 0.022)], 40)
    marks = [turned(box((-0.004, radius * 0.68, 0.0), (0.004, radius * 0.82, 0.0235)), 2, 30.0 * k)
             for k in range(12)]
    marks += [turned(box((-0.005, -0.01, 0.0), (0.005, radius * 0.48, 0.0245)), 2, 58.0),
              turned(box((-0.0035, -0.012, 0.0), (0.0035, radius * 0.7, 0.0255)), 2, -62.0)]
    face = revolve([(radius * 0.92, 0.0), (radius * 0.92, 0.0225)], 40)
    return {"case": [turned(body, 0, 90.0)], "face": [turned(face, 0, 90.0)], "marks": marks}


def crumpled(seed, radius):
    """A ball of crumpled paper."""
    choices = Choices(seed)
    bumps = {}

    def height(d):
        key = tuple(round(2.2 * c) for c in d)
        bumps.setdefault(key, choices.between(0.8, 1.15))
        return radius * bumps[key]
    return sphere(3, height)
