# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""PNG images, and the gallery's two: marble tiles that repeat, a mosaic with an inscription."""

import struct
import zlib

from .noise import lattice

SHADES = 16

# Letters of the inscription, 5 x 7 tesserae each, top row first.
GLYPHS = {
    "E": ("#####", "#....", "#....", "####.", "#....", "#....", "#####"),
    "F": ("#####", "#....", "#....", "####.", "#....", "#....", "#...."),
    "I": (".###.", "..#..", "..#..", "..#..", "..#..", "..#..", ".###."),
    "L": ("#....", "#....", "#....", "#....", "#....", "#....", "#####"),
    "R": ("####.", "#...#", "#...#", "####.", "#.#..", "#..#.", "#...#"),
    "T": ("#####", "..#..", "..#..", "..#..", "..#..", "..#..", "..#.."),
    "U": ("#...#", "#...#", "#...#", "#...#", "#...#", "#...#", ".###."),
    "W": ("#...#", "#...#", "#...#", "#.#.#", "#.#.#", "##.##", "#...#"),
    "X": ("#...#", "#...#", ".#.#.", "..#..", ".#.#.", "#...#", "#...#"),
    " ": (".....",) * 7,
}


def cloud_noise(x, y, cell, wrap, seed):
    """Value noise in [0, 65535] that repeats every `wrap` cells; integers only."""
    i, j, fx, fy = x // cell, y // cell, x % cell, y % cell
    corner = [lattice((i + di) % wrap, (j + dj) % wrap, seed) for dj in (0, 1) for di in (0, 1)]
    top = corner[0] * (cell - fx) + corner[1] * fx
    bottom = corner[2] * (cell - fx) + corner[3] * fx
    return (top * (cell - fy) + bottom * fy) // (cell * cell)


def _chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def _file(width, height, colour_type, palette, rows):
    """An 8-bit PNG whose deflate blocks are stored, so that the bytes do not depend on the
    compression library."""
    raw = b"".join(b"\0" + row for row in rows)
    stored = b"\x78\x01"
    for start in range(0, len(raw), 65535):
        part = raw[start:start + 65535]
        last = start + 65535 >= len(raw)
        stored += struct.pack("<BHH", last, len(part), 0xFFFF ^ len(part)) + part
    stored += struct.pack(">I", zlib.adler32(raw))
    head = struct.pack(">IIBBBBB", width, height, 8, colour_type, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", head) + palette
            + _chunk(b"IDAT", stored) + _chunk(b"IEND", b""))


def png(width, height, palette, pixels):
    """A PNG of indices into a palette of RGB."""
    return _file(width, height, 3, _chunk(b"PLTE", b"".join(bytes(c) for c in palette)),
                 [bytes(pixels[y * width:(y + 1) * width]) for y in range(height)])


def png_rgba(width, height, pixels):
    """A PNG of four bytes a pixel."""
    return _file(width, height, 6, b"", [bytes(pixels[4 * y * width:4 * (y + 1) * width])
                                         for y in range(height)])


def ramps(pairs):
    """A palette of `SHADES` steps between each pair of sRGB colours."""
    return [tuple((a * (SHADES - 1 - s) + b * s) // (SHADES - 1) for a, b in zip(dark, light))
            for dark, light in pairs for s in range(SHADES)]


def tiles():
    """512 x 512: 2 x 2 marble tiles with dark lozenges at their corners and pale joints."""
    size, tile, lozenge = 512, 256, 44
    palette = ramps([((172, 163, 148), (228, 222, 210)), ((128, 108, 92), (176, 154, 134)),
                      ((46, 50, 56), (88, 92, 96)), ((96, 92, 86), (120, 116, 108))])
    pixels = bytearray(size * size)
    for y in range(size):
        for x in range(size):
            fx, fy = x % tile, y % tile
            corner = min(fx, tile - fx) + min(fy, tile - fy)
            if corner < lozenge:
                kind = 2
            elif corner < lozenge + 3 or min(fx, fy) < 2:
                kind = 3
            else:
                kind = (x // tile + y // tile) % 2
            cloud = (cloud_noise(x, y, 64, 8, 1) + cloud_noise(x, y, 16, 32, 2) // 2) * 2 // 3
            vein = abs(cloud - 32768) < 1800 and kind < 2
            shade = 2 if vein else 3 + cloud * (SHADES - 4) // 65536
            pixels[y * size + x] = kind * SHADES + shade
    return png(size, size, palette, pixels)


def _write(grid, text, column, row, scale):
    for n, letter in enumerate(text):
        for y, line in enumerate(GLYPHS[letter]):
            for x, dot in enumerate(line):
                if dot == "#":
                    for k in range(scale * scale):
                        grid[row + y * scale + k // scale][
                            column + (n * 6 + x) * scale + k % scale] = 1


def inscription():
    """576 x 320: a mosaic of 72 x 40 tesserae. It reads WEFT, and LUX TEXITUR below."""
    columns, rows, edge = 72, 40, 8
    palette = ramps([((196, 182, 150), (236, 226, 200)), ((24, 34, 70), (52, 70, 120)),
                      ((140, 52, 30), (186, 84, 50)), ((92, 86, 78), (112, 106, 98))])
    grid = [[2 if min(x, y, columns - 1 - x, rows - 1 - y) in (1, 2) else 0
             for x in range(columns)] for y in range(rows)]
    _write(grid, "WEFT", 13, 7, 2)
    _write(grid, "LUX TEXITUR", 3, 25, 1)
    pixels = bytearray(columns * edge * rows * edge)
    for y in range(rows * edge):
        for x in range(columns * edge):
            joint = x % edge == 0 or y % edge == 0
            kind = 3 if joint else grid[y // edge][x // edge]
            shade = lattice(x // edge, y // edge, 7) * SHADES // 65536
            pixels[y * columns * edge + x] = kind * SHADES + (8 if joint else shade)
    return png(columns * edge, rows * edge, palette, pixels)
