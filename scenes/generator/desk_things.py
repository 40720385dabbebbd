# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What lies and stands on desks: books, mugs, pencils, paper, plants and frames."""

import math

from .forms import bevelled, cable, disc, lofted, rod, rotated, turn
from .solids import box, extrude, plate, revolve, sphere


def book_cover():
    """The boards and the round back of a standing book of 1 x 1 x 1; its back looks along +z.
    Nodes stretch it to thickness, height and depth."""
    board, lip, steps = 0.09, 0.5, 6
    outline = [(-lip, 0.0), (-lip, 0.94)]
    outline += [(-lip * math.cos(math.pi * k / steps), 0.94 + 0.06 * math.sin(math.pi * k / steps))
                for k in range(1, steps)]
    outline += [(lip, 0.94), (lip, 0.0), (lip - board, 0.0), (lip - board, 0.92)]
    outline += [(-lip + board, 0.92), (-lip + board, 0.0)]
    return [extrude(outline, lambda x, z, y: (x, y, z), 0.0, 1.0)]


def book_pages():
    return [box((-0.43, 0.012, 0.02), (0.43, 0.985, 0.93))]


def book_label():
    """Two bands round the back."""
    steps = 6
    bands = []
    for low, high in ((0.72, 0.84), (0.13, 0.17)):
        outline = [(-0.48 * math.cos(math.pi * k / steps),
                    0.945 + 0.0585 * math.sin(math.pi * k / steps)) for k in range(steps + 1)]
        bands.append(extrude(outline, lambda x, z, y: (x, y, z), low, high))
    return bands


def open_book(width, depth, thick):
    """The pages of a book that lies open, its spine along z; and its cover."""
    steps, half = 12, 0.5 * width
    curve = [(half * (1.0 - k / steps), thick * (0.42 + 0.58 * math.sin(
        math.pi * min(1.0, 0.04 + 0.96 * (k / steps)) ** 1.6))) for k in range(steps)]
    outline = [(half, 0.002)] + curve + [(0.0003, 0.3 * thick)]
    pages = []
    for side in (-1.0, 1.0):
        closed = [(side * x, y) for x, y in outline + [(0.0003, 0.002)]]
        pages.append(extrude(closed, lambda x, y, z: (x, y, z), -0.5 * depth, 0.5 * depth))
    x, z = half + 0.006, 0.5 * depth + 0.005
    return pages, [bevelled((-x, -0.0005, -z), (x, 0.0035, z), 0.001)]


def mug():
    """A mug 95 mm high; its handle is on the +x side."""
    outside = [(0.031, 0.0), (0.036, 0.002), (0.039, 0.008), (0.04, 0.03), (0.04, 0.089),
               (0.0393, 0.0935)]
    inside = [(0.0385, 0.095), (0.037, 0.0945), (0.0365, 0.09), (0.0365, 0.03), (0.034, 0.01),
              (0.028, 0.007)]
    bow = [(0.038 + 0.03 * math.sin(math.pi * k / 12), 0.05 + 0.028 * math.cos(math.pi * k / 12),
            0.0) for k in range(13)]
    return [revolve(outside + inside, 40), cable(bow, 0.0048, 10)]


def coffee():
    return [disc(0.037, 0.06, 0.078, 0.001, 32)]


def cup(radius, height):
    """A plain open cup for pens."""
    wall = 0.0025
    profile = [(radius - 0.002, 0.0), (radius, 0.002), (radius, height - 0.001),
               (radius - 0.001, height), (radius - wall + 0.001, height),
               (radius - wall, height - 0.001), (radius - wall, 0.005),
               (radius - wall - 0.002, 0.003)]
    return [revolve(profile, 36)]


def pencil_body(length):
    """Six-sided, along +y; its point is downwards at the origin."""
    def ring(radius, y, turned=0.0):
        return [(radius * math.cos(math.pi * (k / 3.0 + turned)), y,
                 radius * math.sin(math.pi * (k / 3.0 + turned))) for k in range(6)]
    return [lofted([ring(0.0036, 0.019), ring(0.0037, 0.021), ring(0.0037, length - 0.001),
                    ring(0.0032, length)])]


def pencil_wood():
    return [revolve([(0.0012, 0.005), (0.0033, 0.0195)], 12)]


def pencil_lead():
    return [revolve([(0.0003, 0.0), (0.0014, 0.006)], 10)]


def pen():
    """A round pen along +y with a clip."""
    return [revolve([(0.0008, 0.0), (0.0022, 0.009), (0.0046, 0.018), (0.005, 0.03), (0.005, 0.075),
                     (0.0054, 0.077), (0.0054, 0.136), (0.004, 0.139)], 14),
            bevelled((-0.0012, 0.1, 0.0045), (0.0012, 0.137, 0.0075), 0.0004)]


def scissors():
    """Two rings and two blades that lie on the origin, along +x."""
    solids = []
    for side in (-1.0, 1.0):
        path = [(-0.055 + 0.026 * math.cos(0.02 + 6.2 * k / 20), 0.005,
                 side * (0.024 + 0.018 * math.sin(0.02 + 6.2 * k / 20))) for k in range(21)]
        solids.append(cable(path, 0.0045, 8))
        blade = [[(x, y, side * z) for y, z in ((lift, 0.0), (lift, w), (lift + 0.002, w),
                                                (lift + 0.002, 0.0))]
                 for x, w, lift in ((-0.035, 0.012, 0.003 + 0.0015 * side),
                                    (0.02, 0.009, 0.003 + 0.0015 * side),
                                    (0.1, 0.001, 0.003 + 0.0015 * side))]
        solids.append(rotated(lofted(blade), turn(y=6.0 * side)))
    return solids


def leaf(segments=6):
    """A leaf on a stalk from the origin along +y, which bends over to +z; 1 m long."""
    vs = [k / segments for k in range(segments + 1)]

    def face(lift):
        def at(u, v):
            wide = 0.19 * math.sin(math.pi * (0.04 + 0.93 * v)) ** 0.8 * (1.0 - 0.25 * v)
            s = 0.3 + 0.7 * v
            y, z = s * (1.0 - 0.18 * s * s), 0.42 * s * s
            return u * wide, y - lift * 0.6 + 0.05 * abs(u), z + lift + 0.06 * u * u
        return at

    blade = plate((-1.0, -0.5, 0.0, 0.5, 1.0), vs, face(0.004), face(-0.004))
    stalk = [(0.0, s * (1.0 - 0.18 * s * s), 0.42 * s * s) for s in (0.0, 0.12, 0.24, 0.36, 0.5)]
    return [blade, cable(stalk, [0.012, 0.01, 0.009, 0.008, 0.004], 6)]


def pot(radius, height):
    """A flower pot, open at the top, on a saucer."""
    r = radius
    outside = [(0.68 * r, 0.003), (0.7 * r, 0.006), (0.9 * r, 0.8 * height),
               (0.98 * r, 0.805 * height), (r, 0.82 * height), (r, height - 0.004),
               (0.98 * r, height)]
    inside = [(0.92 * r, height), (0.9 * r, height - 0.004), (0.86 * r, 0.78 * height),
              (0.66 * r, 0.12 * height)]
    saucer = [(0.78 * r, -0.001), (1.02 * r, 0.01), (1.06 * r, 0.022), (1.03 * r, 0.022),
              (0.96 * r, 0.012), (0.6 * r, 0.008)]
    return [revolve(outside + inside, 36), revolve(saucer, 36)]


def picture_frame(width, height, bar, deep):
    """A frame in the plane of x and y, its back at z = 0, whose bars slope inwards."""
    x, y = 0.5 * width, 0.5 * height
    xs, ys = (-x, -x + bar, x - bar, x), (-y, -y + bar, y - bar, y)

    def front(u, v):
        outer = abs(u) > x - 0.5 * bar or abs(v) > y - 0.5 * bar
        return u, v, deep if outer else 0.55 * deep
    return [plate(xs, ys, front, lambda u, v: (u, v, 0.0), lambda i, j: (i, j) != (1, 1))]


def clip():
    """A paper clip that lies on the origin."""
    path = []
    for x, r, first, last in ((0.011, 0.0042, -90, 90), (-0.011, 0.0036, 90, 270),
                              (0.006, 0.0029, -90, 90)):
        middle = {0.0042: 0.0, 0.0036: 0.0006, 0.0029: -0.0001}[r]
        for k in range(6):
            a = math.radians(first + (last - first) * k / 5)
            path.append((x + r * math.cos(a), 0.0007, middle + r * math.sin(a)))
    return [cable([(-0.008, 0.0007, -0.0042)] + path + [(-0.006, 0.0007, 0.0028)], 0.0005, 5)]


def crumpled(clouds):
    """A ball of paper, about 3 cm in radius, its form from a `noise.Clouds`."""
    def radius(d):
        p = [4.0 + 2.6 * c for c in d]
        return 0.021 + 0.017 * clouds.fractal(*p, 3)
    return [sphere(3, radius)]


def globe_stand():
    """The foot and the bow of a globe of radius 0.11 m, whose centre is the origin."""
    bow = [(0.125 * math.cos(math.radians(a)), 0.125 * math.sin(math.radians(a)), 0.0)
           for a in range(-113, 68, 10)]
    tilt = math.radians(67.0)
    pin = (0.13 * math.cos(tilt), 0.13 * math.sin(tilt), 0.0)
    return [cable(bow, 0.0045, 8), rod(tuple(-c for c in pin), pin, 0.003, 8),
            revolve([(0.075, -0.171), (0.077, -0.166), (0.05, -0.157), (0.014, -0.147),
                     (0.009, -0.121)], 32)]


def coil(turns, radius, pitch):
    """Rings of a spiral binding along x."""
    solids = []
    for n in range(turns):
        path = [(pitch * (n - 0.5 * (turns - 1)), radius * math.cos(math.radians(a)),
                 radius * math.sin(math.radians(a))) for a in range(-40, 221, 26)]
        solids.append(cable(path, 0.0008, 5))
    return solids
