# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A lamp with two arms and a shade, as nodes that can turn at its joints."""

import math

from .forms import cable, compound, disc, put, rod, turn
from .solids import Mesh, plate, revolve

LOWER, UPPER = 0.36, 0.34  # lengths of the arms, metres
FOOT = 0.034
PANE, RIM, PANE_Y = 0.021, 0.019, -0.02


def _spring(first, last, radius, turns):
    """A helix about the y axis at x = 0 whose wire is 2 mm thick."""
    points, steps = [], 9
    for k in range(turns * steps + 1):
        angle = 2.0 * math.pi * k / steps
        points.append((radius * math.cos(angle), first + (last - first) * k / (turns * steps),
                       radius * math.sin(angle)))
    return cable(points, 0.001, 5)


def _arm(length, spring, apart):
    """Two rods, `apart` from the middle, along +y, and the pins of the joints along z."""
    solids = [rod((0.0, -0.02, z), (0.0, length + 0.02, z), 0.0048, 10) for z in (-apart, apart)]
    solids += [rod((0.0, y, -apart - 0.008), (0.0, y, apart + 0.008), 0.77 * apart, 16)
               for y in (0.0, length)]
    solids += [rod((0.0, y, -0.016), (0.0, y, 0.016), 0.003, 8) for y in spring]
    return solids + [_spring(spring[0], spring[1], 0.0065, 14)]


def _foot():
    return [revolve([(0.088, -0.001), (0.09, 0.004), (0.09, 0.012), (0.086, 0.017), (0.02, 0.024),
                     (0.015, 0.026)], 40),
            revolve([(0.013, 0.015), (0.013, FOOT - 0.004), (0.01, FOOT)], 20)]


def _shade():
    """A bell that opens downwards; its joint is the origin."""
    outside = [(0.012, 0.052), (0.026, 0.049), (0.034, 0.038), (0.037, 0.015), (0.039, -0.012),
               (0.05, -0.036), (0.071, -0.07), (0.086, -0.106), (0.091, -0.13)]
    inside = [(0.0885, -0.13), (0.0835, -0.106), (0.068, -0.071), (0.047, -0.038), (0.036, -0.014),
              (0.0345, 0.012)]
    return [revolve(outside + inside, 48)]


def _socket():
    """What holds the pane: a round body, and a square rim that the pane's edge is in."""
    cuts = (-0.029, -RIM, RIM, 0.029)
    rim = plate(cuts, cuts, lambda x, z: (x, -0.026, z), lambda x, z: (x, -0.008, z),
                lambda i, j: (i, j) != (1, 1))
    return [revolve([(0.03, -0.014), (0.03, 0.02)], 24), rim]


def _neck():
    return [rod((0.0, -0.002, -0.02), (0.0, -0.002, 0.02), 0.0105, 16),
            rod((-0.03, 0.03, 0.0), (-0.052, 0.005, 0.0), 0.006, 10),
            disc(0.008, 0.045, 0.066, 0.002, 16)]


class DeskLamp:
    """The nodes of a lamp on a table: `stand` turns about y, the others about z. The enamel, the
    metal and the pane's radiance are names of materials. Angles are in degrees: of the stand, of
    the lower arm from upright, of the upper one from the lower and of the head from the upper."""

    def __init__(self, builder, at, angles, enamel, metal, inside, radiance):
        stand, low, high, head = angles
        self.stand = put(builder, "lamp", compound(builder, "lamp foot", [
            (enamel, _foot(), 35.0)]), at, turn(y=stand))
        self.lower = put(builder, "lower arm", compound(builder, "lower arm", [
            (metal, _arm(LOWER, (0.05, 0.14), 0.0142), 60.0)]), (0.0, FOOT, 0.0), turn(z=low), None,
            self.stand)
        self.upper = put(builder, "upper arm", compound(builder, "upper arm", [
            (metal, _arm(UPPER, (0.04, 0.12), 0.0134), 60.0)]), (0.0, LOWER, 0.0), turn(z=high),
            None, self.lower)
        self.head = put(builder, "lamp head", compound(builder, "lamp head", [
            (enamel, _shade(), 50.0), (inside, _socket(), 35.0), (metal, _neck(), 60.0)]),
            (0.0, UPPER, 0.0), turn(z=head), None, self.upper)
        pane = [(-PANE, PANE_Y, -PANE), (PANE, PANE_Y, -PANE), (PANE, PANE_Y, PANE),
                (-PANE, PANE_Y, PANE)]
        put(builder, "bulb", builder.mesh("bulb", radiance, Mesh(pane, [(0, 1, 2), (0, 2, 3)])),
            parent=self.head)
