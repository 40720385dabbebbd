# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What a bathroom is fitted with: tiles, a tub and its water, basin, taps, bottles, a towel."""

import math

from .forms import bevelled, cable, disc, lofted, rod, rounded
from .lofts import curve
from .noise import Choices
from .solids import box, moved, plate, revolve
from .turnery import level, smooth, vessel

JOINT, GLAZE = 0.003, 0.004  # width of the joints, height of a tile above them


def tile(x0, x1, y0, y1, choices, tilt=0.0003):
    """A tile in the plane z = 0, its edges bevelled, its face a little out of true."""
    half, bevel = 0.5 * JOINT, 0.0022
    base = [(x, y, -0.004) for x, y in ((x0 + half, y0 + half), (x1 - half, y0 + half),
                                        (x1 - half, y1 - half), (x0 + half, y1 - half))]
    foot = [(x, y, GLAZE - bevel) for x, y, _ in base]
    dx, dy = choices.between(-tilt, tilt), choices.between(-tilt, tilt)
    inset = half + bevel
    face = [(x0 + inset, y0 + inset, GLAZE - dx - dy), (x1 - inset, y0 + inset, GLAZE + dx - dy),
            (x1 - inset, y1 - inset, GLAZE + dx + dy), (x0 + inset, y1 - inset, GLAZE - dx + dy)]
    triangles = [(0, 2, 1), (0, 3, 2), (8, 9, 10), (8, 10, 11)]
    for k in range(4):
        n = (k + 1) % 4
        for row in (0, 4):
            a, b = row + k, row + n
            triangles += [(a, b, b + 4), (a, b + 4, a + 4)]
    return base + foot + face, triangles


def tile_row(count, width, height, seed):
    """Tiles side by side along +x."""
    choices = Choices(seed)
    return [tile(k * width, (k + 1) * width, 0.0, height, choices) for k in range(count)]


def checkers(columns, rows, edge, odd):
    """The tiles of one colour of a chequered floor, in the plane z = 0."""
    choices = Choices(31 + odd)
    return [tile(i * edge, (i + 1) * edge, j * edge, (j + 1) * edge, choices, 0.0002)
            for j in range(rows) for i in range(columns) if (i + j) % 2 == odd]


def _oval(width, depth, y):
    return rounded(width, depth, 0.499 * min(width, depth), 12, y)


TUB = ((0.58, 1.42, 0.012), (0.6, 1.46, 0.0), (0.63, 1.5, 0.015), (0.68, 1.58, 0.12),
       (0.72, 1.65, 0.32), (0.77, 1.73, 0.52), (0.805, 1.775, 0.575), (0.815, 1.785, 0.588),
       (0.81, 1.78, 0.6), (0.785, 1.755, 0.603), (0.73, 1.69, 0.592), (0.705, 1.66, 0.56),
       (0.66, 1.59, 0.32), (0.61, 1.5, 0.16), (0.54, 1.4, 0.105), (0.4, 1.2, 0.09))


def tub():
    """Free standing, along z: width, depth and height of its outline from the foot over the rim
    to the floor inside."""
    return [lofted([_oval(w, d, y) for w, d, y in TUB])]


def bath_water(height, overlap=0.006):
    """The water in it up to a height, with rings as of drops that fell at one end."""
    inner = [(w + 2.0 * overlap, d + 2.0 * overlap, y - overlap) for w, d, y in TUB[:10:-1]]
    (w0, d0, y0), (w1, d1, y1) = next((a, b) for a, b in zip(inner, inner[1:])
                                      if a[2] < height <= b[2])
    share = (height - y0) / (y1 - y0)
    w, d = w0 + share * (w1 - w0), d0 + share * (d1 - d0)
    rings = [_oval(*ring) for ring in inner if ring[2] < height] + [_oval(w, d, height)]

    def ripple(p):
        x, z = p[0] + 0.05, p[2] - 0.28
        r = math.sqrt(x * x + z * z)
        lift = 0.0016 * math.cos(62.0 * r) / (1.0 + 5.0 * r)
        return (p[0], p[1] + lift * min(1.0, 6.0 * (1.0 - p[3])), p[2])
    count = 26
    for k in range(1, count):
        t = 1.0 - k / count
        rings.append([ripple((x * t, y, z * t, t)) for x, y, z in _oval(w, d, height)])
    return [lofted(rings)]


def basin():
    outside = smooth([(0.0, 0.004), (0.06, 0.004), [0.09, 0.0], (0.094, 0.001), (0.1, 0.006),
                      (0.15, 0.04), (0.188, 0.09), (0.2, 0.13)], 5)
    inside = smooth([(0.0, 0.0165), (0.02, 0.017), (0.08, 0.024), (0.135, 0.046), (0.173, 0.092),
                     (0.188, 0.13)], 5)
    return {"bowl": [vessel(outside, inside, 64)],
            "drain": [revolve([(0.019, 0.0155), (0.0225, 0.0185), (0.021, 0.0205), (0.012, 0.0225),
                               (0.004, 0.023)], 32)]}


def tap():
    """A tall tap that reaches along +z."""
    column = revolve(smooth([(0.0, -0.002), [0.027, -0.002], [0.027, 0.003], (0.0255, 0.006),
                             (0.0185, 0.01), (0.0165, 0.02), (0.0165, 0.2), [0.0165, 0.236],
                             (0.015, 0.239), (0.0, 0.24)], 4)[1:-1], 36)
    spout = cable(curve([(0.0, 0.21, 0.008), (0.0, 0.225, 0.04), (0.0, 0.236, 0.08),
                         (0.0, 0.234, 0.115), (0.0, 0.214, 0.136), (0.0, 0.19, 0.14)], 5),
                  0.0105, 20)
    lever = [rod((0.0, 0.238, 0.0), (0.0, 0.256, 0.0), 0.0135, 24),
             cable(curve([(0.0, 0.25, -0.004), (0.0, 0.257, -0.035), (0.0, 0.266, -0.068)], 4),
                   [0.0062 - 0.0002 * k for k in range(9)], 14)]
    return [column, spout, *lever]


def tumbler():
    outside = smooth([(0.0, 0.001), (0.02, 0.001), [0.03, 0.0], (0.0322, 0.0015), (0.033, 0.006),
                      (0.0345, 0.05), (0.036, 0.102)], 4)
    inside = smooth([(0.0, 0.0095), (0.02, 0.0095), (0.0295, 0.0105), (0.0315, 0.015),
                     (0.0327, 0.05), (0.0342, 0.102)], 4)
    return [vessel(outside, inside, 56)]


def toothbrush():
    """Along +y from its end: the handle and the bristles, which look along +z."""
    handle = cable(curve([(0.0, 0.0, 0.0), (0.0, 0.03, 0.001), (0.0, 0.08, -0.001),
                          (0.0, 0.12, 0.0), (0.0, 0.15, 0.002), (0.0, 0.18, 0.002)], 4),
                   [0.0042 + 0.0012 * math.cos(0.5 * k) for k in range(21)], 12)
    return {"handle": [handle],
            "bristles": [bevelled((-0.0048, 0.152, 0.003), (0.0048, 0.181, 0.0135), 0.0015)]}


def soap_bottle():
    outside = smooth([(0.0, 0.002), (0.02, 0.002), [0.031, 0.0], (0.0335, 0.002), (0.034, 0.006),
                      (0.034, 0.05), (0.034, 0.1), (0.031, 0.112), (0.018, 0.121), (0.0135, 0.126),
                      (0.0132, 0.138)], 4)
    inside = smooth([(0.0, 0.0055), (0.02, 0.0055), (0.0295, 0.006), (0.0315, 0.0085),
                     (0.0315, 0.05), (0.0315, 0.099), (0.0285, 0.11), (0.016, 0.1195),
                     (0.011, 0.126), (0.0107, 0.138)], 4)
    pump = [revolve(smooth([(0.0, 0.128), [0.016, 0.128], (0.0165, 0.13), (0.0165, 0.144),
                            (0.0145, 0.147), [0.006, 0.148], [0.0045, 0.164], [0.008, 0.165],
                            (0.0085, 0.17), (0.0078, 0.175), (0.0, 0.176)], 3)[1:-1], 32),
            cable(curve([(0.0, 0.1705, 0.0), (0.02, 0.172, 0.0), (0.038, 0.168, 0.0),
                         (0.043, 0.161, 0.0)], 4), 0.0038, 12)]
    return {"glass": [vessel(outside, inside, 56)], "soap": [level(inside, 0.082, 0.0004, 56)],
            "pump": pump}


def flask(radius, height):
    """A flat-shouldered scent bottle with a ball for a stopper."""
    wall = 0.16 * radius
    outside = smooth([(0.0, 0.0), [0.85 * radius, 0.0], (radius, 0.06 * height),
                      (radius, 0.4 * height), [radius, 0.72 * height], (0.8 * radius, 0.8 * height),
                      (0.34 * radius, 0.86 * height), (0.3 * radius, height)], 4)
    inside = smooth([(0.0, 0.1 * height), (0.7 * radius, 0.1 * height),
                     (radius - wall, 0.16 * height), (radius - wall, 0.4 * height),
                     [radius - wall, 0.7 * height], (0.7 * radius, 0.76 * height),
                     (0.2 * radius, 0.84 * height), (0.17 * radius, height)], 4)
    stopper = revolve(smooth([(0.0, 0.9 * height), [0.15 * radius, 0.9 * height],
                              [0.165 * radius, 1.01 * height], (0.34 * radius, 1.03 * height),
                              (0.46 * radius, 1.12 * height), (0.3 * radius, 1.22 * height),
                              (0.0, 1.25 * height)], 4)[1:-1], 40)
    return {"glass": [vessel(outside, inside, 48)],
            "scent": [level(inside, 0.55 * height, 0.0004, 48)], "stopper": [stopper]}


def towel(width, length):
    """Folded over a rail at the origin that lies along x; it hangs down in front and behind."""
    columns = [width * (k / 24 - 0.5) for k in range(25)]
    over = 0.016
    path = [(-over - 0.004, -0.75 * length), (-over, -0.4 * length), (-over, -0.03)]
    path += [(-over * math.cos(math.pi * k / 8), over * math.sin(math.pi * k / 8))
             for k in range(9)]
    path += [(over, -0.02 - (length - 0.02) * k / 14) for k in range(15)]
    rows = [float(k) for k in range(len(path))]

    def face(thick):
        def point(x, v):
            z, y = path[int(v)]
            k = int(v)
            (za, ya), (zb, yb) = path[max(k - 1, 0)], path[min(k + 1, len(path) - 1)]
            size = math.sqrt((zb - za) ** 2 + (yb - ya) ** 2)
            nz, ny = -(yb - ya) / size, (zb - za) / size
            hang = max(0.0, min(1.0, -y / length))
            wave = 0.007 * hang * math.sin(30.0 * x + 1.3) + 0.004 * hang * math.sin(71.0 * x)
            return (x * (1.0 - 0.05 * hang), y + thick * ny, z + thick * nz + wave)
        return point
    return [plate(columns, rows, face(0.0035), face(-0.0035))]


def drop_window(half_z, y0, y1, bar=0.03):
    """The frame of a window in the plane x = 0 and its cross, seen from +x."""
    middle = y0 + 0.62 * (y1 - y0)
    bars = [bevelled((-0.06, y0 - 0.05, -half_z - 0.05), (0.02, y0 + 0.012, half_z + 0.05), 0.004),
            bevelled((-0.06, y1 - 0.012, -half_z - 0.051), (0.021, y1 + 0.05, half_z + 0.051),
                     0.004)]
    for side in (-1.0, 1.0):
        a, b = sorted((side * (half_z - 0.011), side * (half_z + 0.049)))
        bars.append(bevelled((-0.06, y0, a), (0.019, y1, b), 0.004))
    bars.append(bevelled((-0.055, y0, -0.5 * bar), (0.004, y1, 0.5 * bar), 0.003))
    bars.append(bevelled((-0.054, middle - 0.5 * bar, -half_z), (0.003, middle + 0.5 * bar, half_z),
                         0.003))
    sill = bevelled((-0.06, y0 - 0.075, -half_z - 0.09), (0.09, y0 - 0.045, half_z + 0.09), 0.005)
    return [*bars, sill]


def shelf_bracket():
    return [rod((0.0, 0.0, -0.004), (0.0, 0.0, 0.1), 0.006, 16), disc(0.008, -0.004, 0.004, 0.001,
                                                                      20)]


def rail(width):
    """A towel rail along x that stands off a wall at z = 0 by 5 cm."""
    bars = [rod((-0.5 * width, 0.0, 0.05), (0.5 * width, 0.0, 0.05), 0.007, 18)]
    for side in (-1.0, 1.0):
        x = side * (0.5 * width - 0.02)
        bars.append(rod((x, 0.0, -0.005), (x, 0.0, 0.05), 0.006, 16))
    return bars


def knob():
    """Along +z."""
    turned = revolve(smooth([(0.0, -0.002), [0.0055, -0.002], (0.005, 0.008), (0.011, 0.016),
                             (0.0115, 0.021), (0.007, 0.0245), (0.0, 0.025)], 4)[1:-1], 28)
    return [([(x, -z, y) for x, y, z in turned[0]], turned[1])]


def lamp_tube(length):
    """A tube of opal glass along x, and the caps and the arm that hold it off a wall at z = 0."""
    x = 0.5 * length
    tube = cable([(-x, 0.0, 0.09), (-0.5 * x, 0.0, 0.09), (0.5 * x, 0.0, 0.09), (x, 0.0, 0.09)],
                 0.021, 28)
    holders = [rod((side * (x - 0.012), 0.0, 0.09), (side * (x + 0.012), 0.0, 0.09), 0.024, 28)
               for side in (-1.0, 1.0)]
    holders += [moved(box((-0.008, -0.012, -0.006), (0.008, 0.012, 0.075)), (side * 0.6 * x, 0, 0))
                for side in (-1.0, 1.0)]
    return {"tube": [tube], "holders": holders}
