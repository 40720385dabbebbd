# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""An open racing car of an old kind, its nose along +x: body, wings, wheels, lamps, grille."""

import math

from .forms import bevelled, cable, disc, lofted, rod, rotated, turn
from .lofts import curve, hoop
from .solids import moved, plate, revolve
from .turnery import smooth, vessel

WHEEL_R, WHEEL_W = 0.31, 0.13
GRILLE_X = 0.985  # where the intake begins
# x, half width, half height, height of the middle, exponent of the superellipse
BODY = ((-1.75, 0.02, 0.02, 0.5, 2.0), (-1.72, 0.06, 0.06, 0.5, 2.0), (-1.6, 0.14, 0.13, 0.5, 2.0),
        (-1.35, 0.24, 0.21, 0.51, 2.1), (-1.0, 0.33, 0.27, 0.52, 2.3),
        (-0.6, 0.385, 0.295, 0.525, 2.5), (-0.2, 0.39, 0.295, 0.525, 2.5),
        (0.2, 0.355, 0.28, 0.52, 2.4), (0.55, 0.305, 0.258, 0.51, 2.3),
        (0.8, 0.26, 0.238, 0.5, 2.2), (0.93, 0.23, 0.222, 0.492, 2.15),
        (0.98, 0.212, 0.209, 0.488, 2.1), (0.998, 0.2, 0.198, 0.487, 2.1),
        (1.004, 0.191, 0.19, 0.487, 2.1), (0.998, 0.183, 0.182, 0.487, 2.1),
        (0.97, 0.18, 0.179, 0.487, 2.1), (0.86, 0.176, 0.175, 0.487, 2.1))


def _superellipse(x, half_z, half_y, y, exponent, count):
    ring = []
    for s in range(count):
        a = 2.0 * math.pi * s / count
        c, d = math.cos(a), math.sin(a)
        ring.append((x, y + half_y * math.copysign(abs(c) ** (2.0 / exponent), c),
                     half_z * math.copysign(abs(d) ** (2.0 / exponent), d)))
    return ring


def _smooth_rings(sections, steps):
    """Sections between those given, on smooth curves."""
    shape = curve([s[:3] for s in sections], steps)
    rest = curve([(s[3], s[4], 0.0) for s in sections], steps)
    return [(x, z, h, y, e) for (x, z, h), (y, e, _) in zip(shape, rest)]


def body():
    """The shell from the tail over the nose into the intake."""
    return [lofted([_superellipse(*s, 56) for s in _smooth_rings(BODY, 3)])]


def intake():
    """The dark floor of the intake, and before it the bars of the grille."""
    back = disc(0.179, 0.0, 0.02, 0.002, 40)
    bars = []
    for k in range(-8, 9):
        z = 0.0205 * k
        half = 0.1815 * math.sqrt(max(0.0, 1.0 - (z / 0.1815) ** 2))
        bars.append(bevelled((-0.004, -half - 0.004, z - 0.0028), (0.016, half + 0.004, z + 0.0028),
                             0.0012))
    cross = [bevelled((-0.003, -0.005, -0.186), (0.0172, 0.005, 0.186), 0.0015)]
    return {"back": [moved(rotated(back, turn(z=-90.0)), (0.87, 0.487, 0.0))],
            "bars": [moved(s, (0.955, 0.487, 0.0)) for s in bars],
            "cross": [moved(s, (0.955, 0.487, 0.0)) for s in cross]}


def intake_ring():
    """The bright ring about the intake."""
    count, sides = 72, 10
    section = [(0.0078 * math.cos(2.0 * math.pi * s / sides),
                0.0062 * math.sin(2.0 * math.pi * s / sides)) for s in range(sides)]
    profile = [(0.192 + r, t) for r, t in section]
    ring = hoop(profile, count)
    return [([(1.0005 + y, 0.487 + 0.99 * x, z) for x, y, z in ring[0]], ring[1])]


def wing(radius=0.4, width=0.2, thick=0.006, first=-28.0, last=152.0):
    """A wing over a wheel at the origin whose axle is along z; it ends low in front and behind."""
    steps, rows = 30, 12
    us = [math.radians(first + (last - first) * k / steps) for k in range(steps + 1)]
    vs = [k / rows - 0.5 for k in range(rows + 1)]

    def face(lift):
        def point(u, v):
            end = max(0.0, math.sin(math.pi * (u - us[0]) / (us[-1] - us[0])))
            narrow = 0.62 + 0.38 * end ** 0.5
            crown = (0.055 - lift * 0.2) * (1.0 - 3.2 * v * v) * (0.5 + 0.5 * end)
            droop = 0.05 * (2.0 * v) ** 4 * (0.4 + 0.6 * end)
            r = radius + lift + crown - droop
            return (r * math.cos(u), r * math.sin(u), (width + 0.4 * lift) * v * narrow)
        return point
    return [plate(us, vs, face(thick), face(0.0))]


def tyre():
    """About +y: a fat tyre with grooves around its tread."""
    half = 0.5 * WHEEL_W
    outline = [(0.205, -0.4 * half), (0.212, -0.62 * half), (0.235, -0.92 * half),
               (0.265, -1.0 * half), (0.288, -0.93 * half), (0.3, -0.8 * half)]
    tread = []
    for k in range(-3, 4):
        y = 0.215 * half * k
        crown = WHEEL_R - 0.01 * (y / half) ** 2
        tread += [(crown - 0.006, y - 0.09 * half), (crown, y - 0.065 * half),
                  (crown, y + 0.065 * half), (crown - 0.006, y + 0.09 * half)]
    profile = outline + tread[1:-1] + [(r, -y) for r, y in outline[::-1]]
    return [hoop(profile, 64)]


def rim():
    """The rim, its spokes and the hub, about +y; the outside looks along +y."""
    half = 0.5 * WHEEL_W
    ring = hoop([(0.198, -0.5 * half), (0.219, -0.66 * half), (0.219, -0.6 * half),
                 (0.206, -0.4 * half), (0.2, 0.0), (0.206, 0.4 * half), (0.222, 0.62 * half),
                 (0.225, 0.72 * half), (0.219, 0.73 * half), (0.2, 0.5 * half), (0.19, 0.3 * half),
                 (0.19, -0.3 * half)], 64)
    spokes = []
    for k in range(32):
        a = 2.0 * math.pi * (k + 0.5 * (k % 2)) / 32
        b = a + (0.42 if k % 4 < 2 else -0.42)
        out = 1.0 if k % 2 else -1.0
        y0, y1 = (0.85 * half, 0.2 * half) if out > 0 else (-0.35 * half, -0.1 * half)
        spokes.append(rod((0.034 * math.cos(a), y0, 0.034 * math.sin(a)),
                          (0.196 * math.cos(b), y1, 0.196 * math.sin(b)), 0.0027, 6))
    hub = revolve([(0.03, -0.5 * half), (0.04, -0.45 * half), (0.04, -0.35 * half),
                   (0.028, -0.25 * half), (0.028, 0.7 * half), (0.042, 0.76 * half),
                   (0.042, 0.86 * half), (0.034, 0.92 * half), (0.03, 1.0 * half),
                   (0.012, 1.06 * half)], 36)
    return {"ring": [ring], "spokes": spokes, "hub": [hub]}


def knock_off():
    """The winged nut of a hub, about +y."""
    half = 0.5 * WHEEL_W
    centre = revolve(smooth([(0.0, 0.9 * half), [0.024, 0.9 * half], (0.024, 1.12 * half),
                             (0.018, 1.26 * half), (0.0, 1.32 * half)], 4)[1:-1], 32)
    ears = [bevelled((0.012, 1.02 * half, -0.006), (0.056, 1.2 * half, 0.006), 0.003),
            bevelled((-0.056, 1.02 * half, -0.006), (-0.012, 1.2 * half, 0.006), 0.003)]
    return [centre, *ears]


LAMP = 0.105  # outer radius of a headlamp


def lamp():
    """A headlamp that shines along +y, its rim at y = 0: shell, reflector, bulb, lens, bezel."""
    outer = smooth([(0.0, -0.135), (0.02, -0.133), (0.05, -0.118), (0.08, -0.085),
                    (0.096, -0.045), (LAMP - 0.004, 0.0)], 6)
    bowl = [(r, -0.1 + 0.1 * (r / 0.0955) ** 2) for r in (0.0955 * k / 14 for k in range(15))]
    shell = vessel(outer, bowl, 72)
    bezel = hoop([(0.094, -0.004), (0.1, -0.008), (0.107, -0.006), (0.1095, 0.002),
                  (0.107, 0.0105), (0.101, 0.0135), (0.0955, 0.0115), (0.094, 0.005)], 72)
    front = smooth([(0.0, 0.03), (0.04, 0.0265), (0.075, 0.0165), (0.0965, 0.0045)], 5)
    lens = front[::-1]
    rear = [(r, y - 0.005) for r, y in front]
    glass = revolve([p for p in rear[1:] + lens[:-1]], 72)
    bulb = revolve(smooth([(0.0, -0.066), [0.007, -0.066], (0.009, -0.058), (0.013, -0.045),
                           (0.0125, -0.036), (0.007, -0.0295), (0.0, -0.028)], 4)[1:-1], 32)
    socket = revolve([(0.01, -0.101), (0.012, -0.098), (0.012, -0.066), (0.0105, -0.0625)], 28)
    return {"shell": [shell], "bezel": [bezel], "lens": [glass], "bulb": [bulb],
            "socket": [socket]}


def front_axle(reach, at):
    """The beam between the front wheels and its springs, at (x, y)."""
    x, y = at
    beam = cable(curve([(x, y, -reach), (x, y, -0.6 * reach), (x + 0.01, y - 0.035, 0.0),
                        (x, y, 0.6 * reach), (x, y, reach)], 4), 0.019, 14)
    solids = [beam]
    for side in (-1.0, 1.0):
        z = side * 0.255
        for k in range(4):
            spring = [(x - 0.3 + 0.04 * k, y + 0.055 - 0.006 * k, z),
                      (x - 0.15, y + 0.028 - 0.008 * k, z), (x, y + 0.026 - 0.008 * k, z),
                      (x + 0.1, y + 0.034 - 0.008 * k, z),
                      (x + 0.17 - 0.035 * k, y + 0.048 - 0.006 * k, z)]
            solids.append(cable(curve(spring, 3), 0.008, 8))
    return solids


def stay(a, b):
    return [cable(curve([a, tuple(0.5 * (p + q) for p, q in zip(a, b)), b], 4), 0.009, 12)]


def exhaust():
    """Four pipes that join along the left flank, at z = -0.42."""
    solids = []
    for k in range(4):
        x = 0.48 - 0.16 * k
        solids.append(cable(curve([(x, 0.56, -0.25), (x, 0.565, -0.34), (x - 0.02, 0.54, -0.4),
                                   (x - 0.09, 0.5, -0.425), (x - 0.2, 0.49, -0.43)], 5), 0.021, 16))
    solids.append(cable(curve([(0.34, 0.49, -0.43), (-0.3, 0.49, -0.44), (-0.9, 0.485, -0.44),
                               (-1.6, 0.45, -0.42)], 6), 0.032, 20))
    return solids


def bonnet_strap(x, half_z, half_y, middle):
    """A leather strap over the bonnet."""
    ring = []
    for k in range(25):
        a = math.pi * (k / 24.0 - 0.5) * 1.2
        e = 2.0 / 2.35
        c, s = math.cos(a), math.sin(a)
        ring.append((x, middle + half_y * math.copysign(abs(c) ** e, c),
                     half_z * math.copysign(abs(s) ** e, s)))
    rows = []
    for p in ring:
        out = ((p[1] - middle) / (half_y * half_y), p[2] / (half_z * half_z))
        size = math.sqrt(out[0] ** 2 + out[1] ** 2)
        ny, nz = out[0] / size, out[1] / size
        rows.append([(x + dx, p[1] + dy * ny, p[2] + dy * nz)
                     for dx, dy in ((-0.014, -0.002), (0.014, -0.002), (0.014, 0.004),
                                    (0.0125, 0.0055), (-0.0125, 0.0055), (-0.014, 0.004))])
    return [lofted(rows)]


def louvres(x0, count, half_z, height, side):
    """Slots in the flank of the bonnet, as raised blades."""
    blades = []
    for k in range(count):
        x = x0 + 0.034 * k
        z = side * half_z(x)
        path = [(x, height - 0.075, z), (x, height, z * 1.012), (x, height + 0.075, z * 0.985)]
        blades.append(cable(curve(path, 5), [0.003 + 0.0055 * math.sin(math.pi * j / 10)
                                             for j in range(11)], 10))
    return blades


def windscreen():
    """A small pane and its frame, in the plane x = 0, its foot at the origin."""
    pane = bevelled((-0.003, 0.0, -0.16), (0.003, 0.15, 0.16), 0.001)
    frame = [cable(curve([(0.0, 0.0, -0.165), (0.0, 0.08, -0.165), (0.0, 0.135, -0.16),
                          (0.0, 0.156, -0.13), (0.0, 0.157, 0.0), (0.0, 0.156, 0.13),
                          (0.0, 0.135, 0.16), (0.0, 0.08, 0.165), (0.0, 0.0, 0.165)], 4),
                   0.006, 12)]
    return {"pane": [pane], "frame": frame}


def filler_cap():
    """About +y."""
    return [revolve(smooth([(0.0, -0.01), [0.04, -0.01], [0.04, 0.008], [0.046, 0.008],
                            (0.048, 0.012), (0.047, 0.02), (0.04, 0.025), (0.0, 0.0275)],
                           4)[1:-1], 48)]


def studio(radius=4.3, height=4.2):
    """A round floor that bends up into a wall, all about the origin."""
    bend = 1.5
    inside = [(0.0, 0.0), (0.5 * radius, 0.0)]
    inside += [(radius - bend + bend * math.sin(0.5 * math.pi * k / 10),
                bend - bend * math.cos(0.5 * math.pi * k / 10)) for k in range(11)]
    inside.append((radius, height))
    outside = [(radius + 0.2, -0.3), (radius + 0.2, height)]
    ring = outside + inside[:0:-1]
    return [revolve(ring, 48)]
