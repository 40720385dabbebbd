# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Seeds of the targets vol and nanovdb."""
import struct
import zlib


def vol(size, densities, channels=1, box=(0, 0, 0, 1, 1, 1), version=3, encoding=1):
    return b"VOL" + struct.pack("<B5i6f", version, encoding, *size, channels, *box) + \
        struct.pack(f"<{len(densities)}f", *densities)


def vol_files():
    return {
        "blob.vol": vol((5, 4, 3), [(i * 7 % 11) / 8 for i in range(60)], box=(-1, 0, 2, 1, 3, 4)),
        "empty.vol": vol((0, 4, 4), []),
        "flatbox.vol": vol((2, 1, 1), [0, 1], box=(0, 0, 0, 1, 0, 1)) + b"rest",
        "badsize.vol": vol((2147483647, 2147483647, 4), [1, 2]),
        "badvoxel.vol": vol((2, 1, 1), [0, -1]),
        "badcolour.vol": vol((1, 1, 1), [1, 2], channels=2),
        "colour.vol": vol((2, 1, 1), [1, 2, 3, 0, 0.5, 0.25], channels=3),
    }


MAGIC = b"NanoVDB0"
VERSION = 32 << 21 | 4 << 10 | 2
BOX = (-2, 1, 3, 9, 6, 5)  # smallest and largest index of the grid


def nanovdb_nodes():
    """An upper, a lower and a leaf node, each the only child of the one before."""
    box = struct.pack("<6i", *BOX)
    # The children of the cubes at (-4096, 0, 0), at (-128, 0, 0) in it, and at (-8, 0, 0).
    upper_child, lower_child = 31 << 10, 15 << 8
    mask = bytearray(4096)
    mask[upper_child // 8] = 1
    upper = box + bytes(8 + 4096) + mask + bytes(32)
    table = bytearray(8 << 15)
    struct.pack_into("<q", table, 8 * upper_child, len(upper) + len(table))
    upper += table
    mask = bytearray(512)
    mask[lower_child // 8] = 1
    lower = box + bytes(8 + 512) + mask + bytes(32)
    table = bytearray(8 << 12)
    struct.pack_into("<q", table, 8 * lower_child, len(lower) + len(table))
    leaf = struct.pack("<3i4B", -8, 0, 0, 7, 7, 7, 2) + b"\xff" * 64 + bytes(16)
    leaf += struct.pack("<512f", *((i * 7 % 13) / 8 for i in range(512)))
    return upper + lower + table + leaf


def nanovdb_grid(tiles, nodes=b"", kind=1, background=0.0, scale=0.5):
    """A grid of floats with these tiles of the root: (x, y, z, value), or None for the nodes."""
    offset = 64 + 32 * len(tiles)
    root = struct.pack("<6iI5f", *BOX, len(tiles), background, 0, 1, 0, 0).ljust(64, b"\0")
    for x, y, z, value in tiles:
        key = (z & 0xFFFFFFFF) >> 12 | (y & 0xFFFFFFFF) >> 12 << 21 | (x & 0xFFFFFFFF) >> 12 << 42
        child = offset if value is None else 0
        root += struct.pack("<QqIf", key, child, 1, value or 0).ljust(32, b"\0")
    tree = struct.pack("<4Q6IQ", 0, 0, 0, 64, *(1 if nodes else 0,) * 3, 0, 0, 0, 9)
    matrix = (scale, 0, 0, 0, scale, 0, 0, 0, scale)
    inverse = tuple(1 / v if v else 0 for v in matrix)
    place = (1, 2, 3, 1)
    map_ = struct.pack("<22f22d", *(matrix + inverse + place) * 2)
    size = 672 + 64 + len(root) + len(nodes)
    data = MAGIC + struct.pack("<Q4IQ", 0, VERSION, 0, 0, 1, size) + b"density".ljust(256, b"\0")
    data += map_ + struct.pack("<6d3d2IqII2Q", *BOX, scale, scale, scale, 2, kind, size, 0, 0, 0, 0)
    return data + tree + root + nodes


def nanovdb(grid, codec=0, name=b"density\0"):
    packed = grid
    if codec == 1:
        packed = zlib.compress(grid, 9)
        packed = struct.pack("<Q", len(packed)) + packed
    meta = struct.pack("<4Q2I6d6i3d", len(grid), len(packed), 0, 9, 1, 2, *BOX, *BOX, 1, 1, 1)
    meta += struct.pack("<8I2HI", len(name), 1, 1, 1, 1, 0, 0, 0, codec, 0, VERSION)
    return MAGIC + struct.pack("<I2H", VERSION, 1, codec) + meta + name + packed


def nanovdb_files():
    nodes = nanovdb_grid([(-4096, 0, 0, None), (0, 0, 0, 0.25)], nanovdb_nodes())
    tiles = nanovdb_grid([(-4096, 0, 0, 0.5), (0, 0, 0, 0.25)])
    heat = nanovdb(nanovdb_grid([(0, 0, 0, 3.0)], background=0.5), name=b"heat\0")
    return {
        "zip.nvdb": nanovdb(nodes, codec=1),
        "tiles.nvdb": nanovdb(tiles),
        "two.nvdb": heat + nanovdb(tiles),
        "badtile.nvdb": nanovdb(nanovdb_grid([(0, 0, 0, -1.0)])),
        "badtwice.nvdb": nanovdb(nanovdb_grid([(0, 0, 0, 1.0), (1, 1, 1, 1.0)])),
        "badnode.nvdb": nanovdb(nanovdb_grid([(0, 0, 0, None)])),
        "badkind.nvdb": nanovdb(nanovdb_grid([], kind=6)),
    }
