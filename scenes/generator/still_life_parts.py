# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What stands on the table of the still life; lengths in metres, every origin on the table."""

import math

from .forms import cable, lofted, rotated, turn
from .lofts import curve
from .solids import moved, revolve, sphere
from .turnery import level, offset, smooth, vessel

BOTTLE_WALL = 0.0032


def _bottle_outlines():
    outside = smooth([(0.0, 0.004), (0.018, 0.0035), [0.033, 0.0], (0.0362, 0.0015), (0.037, 0.006),
                      (0.037, 0.09), (0.037, 0.172), (0.0345, 0.19), (0.025, 0.212), (0.0165, 0.23),
                      (0.0148, 0.245), [0.0145, 0.282], (0.0162, 0.2835), (0.0165, 0.289),
                      (0.0155, 0.294)], 4)
    inside = smooth([(0.0, 0.022), (0.012, 0.018), (0.026, 0.0085), (0.0325, 0.008),
                     (0.0338, 0.014), (0.0338, 0.09), (0.0338, 0.171), (0.0315, 0.188),
                     (0.022, 0.21), (0.0132, 0.229), (0.0114, 0.245), (0.0105, 0.294)], 4)
    return outside, inside


def bottle():
    outside, inside = _bottle_outlines()
    return {"glass": [vessel(outside, inside, 56)],
            "wine": [level(inside, 0.168, 0.0004, 56)],
            "cork": [revolve([(0.0098, 0.272), (0.0107, 0.28), (0.0108, 0.296), (0.0112, 0.304),
                              (0.0104, 0.3055)], 32)]}


def _wine_glass_outlines():
    outside = smooth([(0.0, 0.0), (0.02, 0.0), [0.0338, 0.0], (0.0346, 0.0009), (0.0335, 0.0019),
                      (0.02, 0.0044), (0.008, 0.0085), (0.0045, 0.016), (0.0038, 0.035),
                      (0.0037, 0.062), (0.0046, 0.078), (0.0095, 0.087), (0.022, 0.0955),
                      (0.0325, 0.109), (0.0375, 0.128), (0.0368, 0.15), (0.0335, 0.172),
                      (0.0305, 0.19)], 4)
    inside = smooth([(0.0, 0.0895), (0.006, 0.0902), (0.0205, 0.0975), (0.031, 0.1102),
                     (0.0362, 0.1285), (0.0356, 0.15), (0.0324, 0.172), (0.0294, 0.19)], 5)
    return outside, inside


def wine_glass():
    outside, inside = _wine_glass_outlines()
    return {"glass": [vessel(outside, inside, 60)], "wine": [level(inside, 0.128, 0.0004, 60)]}


def jug():
    """A copper jug with a lip and a brass handle on the +x side."""
    outside = smooth([(0.0, 0.003), (0.03, 0.003), [0.046, 0.0], (0.049, 0.002), (0.05, 0.006),
                      (0.047, 0.012), (0.055, 0.03), (0.0655, 0.06), (0.066, 0.085),
                      (0.055, 0.118), (0.04, 0.145), (0.0345, 0.165), (0.037, 0.19),
                      (0.046, 0.212)], 4)
    inside = offset(smooth([(0.0, 0.006), (0.03, 0.0065), (0.046, 0.014), (0.0545, 0.03),
                            (0.0655, 0.06), (0.066, 0.085), (0.055, 0.118), (0.04, 0.145),
                            (0.0345, 0.165), (0.037, 0.19), (0.046, 0.212)], 5), 0.0016)

    solid = vessel(outside, inside, 56)

    def pour(p):
        """Draws the rim out to a lip at -x."""
        x, y, z = p
        share = max(0.0, min(1.0, (y - 0.165) / 0.047))
        along = max(0.0, -x / 0.046)
        share *= share * along * along * along
        return (x - 0.022 * share, y + 0.006 * share, z * (1.0 - 0.25 * share))

    body = [pour(p) for p in solid[0]], solid[1]
    bow = curve([(0.033, 0.186, 0.0), (0.05, 0.196, 0.0), (0.082, 0.192, 0.0), (0.099, 0.165, 0.0),
                 (0.1, 0.13, 0.0), (0.085, 0.1, 0.0), (0.062, 0.084, 0.0)], 5)
    rivet = sphere(3, lambda d: 0.0052)
    return {"body": [body], "handle": [cable(bow, 0.0052, 14)],
            "rivets": [moved(rivet, at) for at in ((0.0345, 0.186, 0.0), (0.066, 0.0845, 0.0))]}


def bowl():
    """A footed bowl with a rolled rim."""
    outside = smooth([(0.0, 0.004), (0.03, 0.004), [0.04, 0.0], (0.0415, 0.0008), (0.041, 0.003),
                      (0.034, 0.008), (0.033, 0.013), (0.05, 0.019), (0.075, 0.033),
                      (0.093, 0.055), (0.099, 0.068), (0.1035, 0.0715), (0.106, 0.0712)], 4)
    inside = smooth([(0.0, 0.0165), (0.033, 0.0168), (0.05, 0.0215), (0.0735, 0.0355),
                     (0.0912, 0.0565), (0.0975, 0.0705), (0.1025, 0.0745), (0.106, 0.0738)], 4)
    return [vessel(outside, inside, 64)]


def orange(clouds, radius=0.036):
    """Slightly flat, with a peel of fine dimples."""
    def height(d):
        flat = 1.0 - 0.05 * d[1] * d[1]
        navel = max(0.0, 1.0 - 16.0 * (d[0] * d[0] + d[2] * d[2])) if d[1] > 0.0 else 0.0
        return radius * (flat - 0.035 * navel
                         + 0.006 * (clouds.at(17.0 * d[0] + 40.0, 17.0 * d[1] + 40.0,
                                              17.0 * d[2] + 40.0) - 0.5))
    return [sphere(4, height)]


def plum(radius=0.023):
    """With the furrow that plums have."""
    def height(d):
        furrow = max(0.0, 1.0 - 60.0 * d[2] * d[2]) if d[0] > 0.0 else 0.0
        top = max(0.0, 1.0 - 14.0 * (d[0] * d[0] + d[2] * d[2])) if d[1] > 0.0 else 0.0
        return radius * (1.0 + 0.1 * d[1] * d[1] - 0.035 * furrow * d[0] - 0.14 * top)
    return [sphere(4, height)]


def lemon():
    """Along +x, a nipple at the end."""
    body = revolve(smooth([(0.0, -0.039), (0.0045, -0.0385), (0.007, -0.0355), (0.013, -0.0325),
                           (0.0215, -0.024), (0.0268, -0.008), (0.0268, 0.006), (0.022, 0.022),
                           (0.0135, 0.0325), (0.0085, 0.0365), (0.0065, 0.041), (0.003, 0.0432),
                           (0.0, 0.0434)], 4)[1:-1], 44)
    return [rotated(body, turn(z=-90.0))]


def pepper_mill():
    body = revolve(smooth([(0.0, 0.0), [0.0275, 0.0], (0.029, 0.0015), (0.029, 0.008),
                           (0.0272, 0.013), (0.0215, 0.03), (0.0165, 0.062), (0.0172, 0.09),
                           (0.0232, 0.108), (0.0245, 0.1145), [0.0235, 0.1195], [0.02, 0.1205],
                           (0.0, 0.1205)], 4)[1:-1], 48)
    ring = revolve(smooth([(0.0, 0.1195), [0.0205, 0.1195], (0.0218, 0.1208), (0.0218, 0.1235),
                           [0.0205, 0.1248], (0.0, 0.1248)], 4)[1:-1], 48)
    head = revolve(smooth([(0.0, 0.1243), [0.021, 0.1243], (0.0238, 0.127), (0.0252, 0.137),
                           (0.0232, 0.15), (0.0165, 0.16), (0.007, 0.1652), (0.0, 0.166)],
                          4)[1:-1], 48)
    knob = revolve(smooth([(0.0, 0.164), [0.0045, 0.164], (0.0042, 0.169), (0.0068, 0.1735),
                           (0.0062, 0.1785), (0.003, 0.1808), (0.0, 0.181)], 4)[1:-1], 36)
    return {"body": [body], "metal": [ring, knob], "head": [head]}


def plate():
    outside = smooth([(0.0, 0.0022), (0.03, 0.0022), [0.05, 0.0], (0.0535, 0.0008), (0.056, 0.003),
                      (0.066, 0.008), (0.085, 0.0125), (0.0985, 0.0146)], 4)
    inside = smooth([(0.0, 0.0052), (0.03, 0.0052), (0.054, 0.0062), (0.066, 0.0112),
                     (0.085, 0.0156), (0.0985, 0.0172)], 4)
    return [vessel(outside, inside, 60)]


def knife():
    """Along +x from the end of its handle at the origin; it lies on its side."""
    sections = []
    for x, back, edge, thick in ((0.098, 0.0065, -0.0065, 0.0016), (0.104, 0.0085, -0.0095, 0.0016),
                                 (0.12, 0.0095, -0.0108, 0.0015), (0.16, 0.0092, -0.0112, 0.0014),
                                 (0.19, 0.0085, -0.0092, 0.0012), (0.21, 0.0074, -0.0048, 0.001),
                                 (0.219, 0.0064, 0.001, 0.0008), (0.222, 0.0058, 0.004, 0.0006)):
        half = 0.5 * thick
        sections.append([(x, half, -back), (x, 0.6 * half, -edge), (x, -0.6 * half, -edge),
                         (x, -half, -back)])
    handle = []
    for x, wide, high in ((0.0, 0.004, 0.003), (0.0015, 0.0065, 0.0048), (0.008, 0.0088, 0.006),
                          (0.03, 0.0082, 0.0058), (0.06, 0.0076, 0.0055), (0.085, 0.008, 0.0055),
                          (0.094, 0.0075, 0.0048)):
        handle.append([(x, high * math.sin(a) * (1.0 if abs(math.sin(a)) < 0.8 else 0.94),
                        wide * math.cos(a)) for a in (2.0 * math.pi * s / 20 for s in range(20))])
    bolster = [[(x, high * math.sin(a), wide * math.cos(a))
                for a in (2.0 * math.pi * s / 20 for s in range(20))]
               for x, wide, high in ((0.0925, 0.006, 0.004), (0.0935, 0.0078, 0.0051),
                                     (0.1, 0.0074, 0.0042), (0.1025, 0.0055, 0.0024))]
    return {"blade": [lofted(sections)], "handle": [lofted(handle)], "bolster": [lofted(bolster)]}


def marble(radius, levels):
    return [sphere(levels, lambda d: radius)]
