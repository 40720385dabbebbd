# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The density of a column of smoke as a grid volume: made of noise, the same bytes everywhere."""

import math
import struct

from .noise import Clouds

VOXELS = (48, 72, 48)
EDGE = 0.025  # metres of a voxel
STEPS = 1024  # densities are multiples of 1 / STEPS, so that rounding elsewhere cannot show
SEED = 20


def _ramp(low, high, value):
    """0 below `low`, 1 above `high`, smooth between; also downwards where high < low."""
    t = min(max((value - low) / (high - low), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


class Column:
    """Smoke that rises along a wavering line from the middle of the grid's bottom, wider and
    thinner the higher it is. Coordinates are 0 to 1 across the grid upwards, -1/2 to 1/2 about
    its middle sideways, all in units of the grid's height."""

    def __init__(self):
        self._sway = Clouds(SEED, 16)
        self._curl = Clouds(SEED + 1)
        self._body = Clouds(SEED + 2)

    def _bend(self, x, y, z, axis):
        """How far turbulence has carried the smoke along an axis."""
        return self._curl.fractal(6.5 * x + 11.0 * axis, 5.0 * y + 3.0 * axis, 6.5 * z, 3) - 0.5

    def density(self, x, y, z):
        """The density of a place, 0 to 1."""
        radius = 0.022 + 0.2 * y * (0.6 + 0.4 * y)
        sway = 0.16 * y
        x -= sway * (2.0 * self._sway.at(0.5, 2.3 * y, 0.5) - 1.0) + 0.05 * y
        z -= sway * (2.0 * self._sway.at(5.5, 2.3 * y, 3.5) - 1.0)
        reach = radius + 0.3 * y
        if x * x + z * z > reach * reach:
            return 0.0
        strength = 0.5 * _ramp(0.05, 0.75, y)
        bx = x + strength * self._bend(x, y, z, 0)
        by = y + strength * self._bend(x, y, z, 1)
        bz = z + strength * self._bend(x, y, z, 2)
        distance = math.sqrt(bx * bx + bz * bz) / radius
        if distance >= 1.0:
            return 0.0
        # Rolls where the noise is near its mean, as smoke has between its eddies.
        body = self._body.fractal(13.0 * bx + 3.0, 8.0 * by, 13.0 * bz + 3.0, 3)
        wisps = _ramp(0.42, 0.66, body + 0.24 * (1.0 - distance) - 0.06 * y)
        return wisps * (1.0 - distance * distance) * (1.0 - 0.65 * y)


def _voxels():
    """Densities, x the fastest. The outermost voxels are empty: the grid has no visible faces."""
    column, (nx, ny, nz) = Column(), VOXELS
    for k in range(nz):
        for j in range(ny):
            fade = _ramp(ny - 1.0, 0.72 * ny, float(j)) if j else 1.0
            for i in range(nx):
                if i in (0, nx - 1) or k in (0, nz - 1) or j == ny - 1:
                    yield 0.0
                    continue
                density = fade * column.density((i + 0.5 - 0.5 * nx) / ny, (j + 0.5) / ny,
                                                (k + 0.5 - 0.5 * nz) / ny)
                yield int(density * STEPS + 0.5) / STEPS


def box(foot):
    """Where the grid is, the middle of its bottom at `foot`: its lower and its upper corner."""
    half_x, half_z = 0.5 * EDGE * VOXELS[0], 0.5 * EDGE * VOXELS[2]
    corners = (foot[0] - half_x, foot[1], foot[2] - half_z,
               foot[0] + half_x, foot[1] + EDGE * VOXELS[1], foot[2] + half_z)
    return [round(c, 6) for c in corners]


def grid(foot):
    """A Mitsuba grid volume, version 3: float32, one channel."""
    head = b"VOL\x03" + struct.pack("<5i6f", 1, *VOXELS, 1, *box(foot))
    voxels = list(_voxels())
    return head + struct.pack(f"<{len(voxels)}f", *voxels)
