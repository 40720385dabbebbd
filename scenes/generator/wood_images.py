# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""An image of wood whose grain runs along u and that repeats both ways."""

from .noise import lattice
from .texture_images import png


def _streaks(x, y, cell, wrap, seed):
    """Smooth noise in [0, 1] with cells of different width and height."""
    i, fx = x // cell[0], (x % cell[0]) / cell[0]
    j, fy = y // cell[1], (y % cell[1]) / cell[1]
    fx, fy = fx * fx * (3.0 - 2.0 * fx), fy * fy * (3.0 - 2.0 * fy)
    a, b, c, d = (lattice((i + di) % wrap[0], (j + dj) % wrap[1], seed) / 65535.0
                  for dj in (0, 1) for di in (0, 1))
    return (a + (b - a) * fx) * (1.0 - fy) + (c + (d - c) * fx) * fy


def wood(dark, light, seed, size=(256, 256)):
    """Rings of years that wander, and fine pores; between two sRGB colours."""
    width, height = size
    shades = 64
    palette = [tuple((a * (shades - 1 - s) + b * s) // (shades - 1) for a, b in zip(dark, light))
               for s in range(shades)]

    def cells(cx, cy):
        return (cx, cy), (width // cx, height // cy)

    pixels = bytearray(width * height)
    for y in range(height):
        for x in range(width):
            sway = (14.0 * _streaks(x, y, *cells(64, 64), seed)
                    + 3.0 * _streaks(x, y, *cells(32, 16), seed + 1))
            ring = sway + y * 16.0 / height
            ring -= ring // 1.0
            ring = 1.0 - ring if ring > 0.8 else 0.39 * ring * ring
            tone = (0.62 - 0.5 * min(4.0 * ring, 1.0) * 0.5
                    + 0.3 * (_streaks(x, y, *cells(128, 32), seed + 2) - 0.5)
                    + 0.22 * (_streaks(x, y, *cells(32, 2), seed + 3) - 0.5)
                    + 0.12 * (_streaks(x, y, *cells(16, 1), seed + 4) - 0.5))
            pixels[y * width + x] = int(max(0.0, min(0.999, tone)) * shades)
    return png(width, height, palette, pixels)
