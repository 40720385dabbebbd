# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Pseudo-random numbers that are the same everywhere: integers, and sums and products of them."""


def lattice(x, y, seed):
    """A fixed pseudo-random integer in [0, 65535] for a lattice point."""
    h = (x * 0x9E3779B1 + y * 0x85EBCA77 + seed * 0xC2B2AE3D) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 0x2C1B3C6D) & 0xFFFFFFFF
    h = ((h ^ (h >> 12)) * 0x297A2D39) & 0xFFFFFFFF
    return (h ^ (h >> 15)) & 0xFFFF


class Choices:
    """Numbers in [0, 1), one after the other."""

    def __init__(self, seed):
        self._seed, self._count = seed, 0

    def between(self, low, high):
        self._count += 1
        return low + (high - low) * (lattice(self._count, 0, self._seed) / 65536.0)


class Clouds:
    """Value noise in [0, 1) over space, with a period of `wrap` cells of edge 1."""

    def __init__(self, seed, wrap=32):
        self._wrap = wrap
        self._values = [lattice(x + wrap * y, z, seed) / 65536.0
                        for z in range(wrap) for y in range(wrap) for x in range(wrap)]

    def at(self, x, y, z):
        values, wrap = self._values, self._wrap
        i, j, k = int(x // 1.0), int(y // 1.0), int(z // 1.0)
        x, y, z = x - i, y - j, z - k
        x, y, z = x * x * (3.0 - 2.0 * x), y * y * (3.0 - 2.0 * y), z * z * (3.0 - 2.0 * z)
        i0, i1, j0, j1 = i % wrap, (i + 1) % wrap, j % wrap * wrap, (j + 1) % wrap * wrap

        def slab(base):
            near, far = base + j0, base + j1
            a = values[near + i0] + (values[near + i1] - values[near + i0]) * x
            b = values[far + i0] + (values[far + i1] - values[far + i0]) * x
            return a + (b - a) * y

        first = slab(k % wrap * wrap * wrap)
        return first + (slab((k + 1) % wrap * wrap * wrap) - first) * z

    def fractal(self, x, y, z, octaves):
        """The sum of octaves, each twice as fine and half as strong as the last, in [0, 1)."""
        total, strength, sum_of_strengths = 0.0, 1.0, 0.0
        for _ in range(octaves):
            total += strength * self.at(x, y, z)
            sum_of_strengths += strength
            x, y, z = 2.0 * x + 17.3, 2.0 * y + 5.7, 2.0 * z + 29.1
            strength *= 0.5
        return total / sum_of_strengths
