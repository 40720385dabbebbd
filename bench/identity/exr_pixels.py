# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Compares the pixels of two OpenEXR files as Weft writes them, bit by bit, with Python alone.

Scanline files of one part without compression, with RLE or with ZIP are read. All channels count;
what else the headers say, such as how long rendering took, does not, nor how pixels are compressed.
"""

import array
import itertools
import math
import struct
import sys
import zlib

MAGIC = 20000630
TILED_OR_PARTS = 0x200 | 0x800 | 0x1000
RLE = 1
LINES_OF = {0: 1, RLE: 1, 2: 1, 3: 16}  # lines a block by compression: none, RLE, ZIPS, ZIP
TYPE_BYTES = {0: 4, 1: 2, 2: 4}  # words, half floats, floats
WORDS, HALVES, FLOATS = 0, 1, 2


class NotReadable(Exception):
    """What is wrong with a file."""


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8"), end + 1


def attributes(data):
    """The header's attributes by name, and where it ends."""
    if len(data) < 8 or struct.unpack_from("<i", data)[0] != MAGIC:
        raise NotReadable("is no OpenEXR file")
    if struct.unpack_from("<i", data, 4)[0] & TILED_OR_PARTS:
        raise NotReadable("has tiles or several parts, expected scanlines")
    found, at = {}, 8
    while data[at] != 0:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        size, = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def channel_list(data):
    """Pairs of name and type, in the order of the file."""
    found, at = [], 0
    while data[at] != 0:
        name, at = text_at(data, at)
        kind, _, x_step, y_step = struct.unpack_from("<iiii", data, at)
        if (x_step, y_step) != (1, 1) or kind not in TYPE_BYTES:
            raise NotReadable(f"has an unusual channel {name}")
        found.append((name, kind))
        at += 16
    return found


def unpredicted(data):
    """Undoes what OpenEXR does to bytes before it compresses them."""
    sums = itertools.accumulate(data)
    whole = bytes((value - 128 * place) & 255 for place, value in enumerate(sums))
    half = (len(whole) + 1) // 2
    joined = bytearray(len(whole))
    joined[0::2], joined[1::2] = whole[:half], whole[half:]
    return bytes(joined)


def runs_expanded(data):
    """Undoes run-length encoding: a count below zero, and as many bytes as they are; or a count of
    repetitions less one, and the byte."""
    whole, at = bytearray(), 0
    while at < len(data):
        count = data[at] - 256 if data[at] > 127 else data[at]
        if count < 0:
            whole += data[at + 1:at + 1 - count]
            at += 1 - count
        else:
            whole += data[at + 1:at + 2] * (count + 1)
            at += 2
    return bytes(whole)


class Image:
    """The channels of a file and its blocks of lines, which are decoded on demand."""

    def __init__(self, path):
        try:
            self.read(path.read_bytes())
        except (IndexError, KeyError, ValueError, struct.error) as error:
            raise NotReadable(f"{path.name} is damaged or of another kind") from error

    def read(self, data):
        header, at = attributes(data)
        left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
        self.width, self.height = right - left + 1, bottom - top + 1
        self.channels = channel_list(header["channels"])
        self.compression = header["compression"][0]
        self.lines = LINES_OF[self.compression]
        self.line_bytes = self.width * sum(TYPE_BYTES[kind] for _, kind in self.channels)
        blocks = -(-self.height // self.lines)
        self.blocks = {}
        for start in struct.unpack_from(f"<{blocks}Q", data, at):
            y, size = struct.unpack_from("<ii", data, start)
            self.blocks[y - top] = data[start + 8:start + 8 + size]
            if len(self.blocks[y - top]) != size:
                raise ValueError("cut short")
        if sorted(self.blocks) != list(range(0, self.height, self.lines)):
            raise ValueError("lines are missing")

    def shape(self):
        return self.width, self.height, [name for name, _ in self.channels]

    def lines_of(self, y):
        """The bytes of the block that begins with line y: of each line the channels in turn."""
        size = self.line_bytes * min(self.lines, self.height - y)
        data = self.blocks[y]
        if len(data) != size:  # what compression does not make smaller is kept as it is
            expand = runs_expanded if self.compression == RLE else zlib.decompress
            data = unpredicted(expand(data))
        if len(data) != size:
            raise NotReadable("has a block of another size than its lines")
        return data

    def all_lines(self):
        """Of each line in turn the name, type and bytes of each channel."""
        for y in sorted(self.blocks):
            lines, at = self.lines_of(y), 0
            while at < len(lines):
                line = []
                for name, kind in self.channels:
                    end = at + TYPE_BYTES[kind] * self.width
                    line.append((name, kind, lines[at:end]))
                    at = end
                yield line


def values(data, kind):
    if kind == HALVES:
        return struct.unpack(f"<{len(data) // 2}e", data)
    words = array.array("f" if kind == FLOATS else "I", data)
    if sys.byteorder == "big":
        words.byteswap()
    return words


def layer_of(channel):
    return channel.rpartition(".")[0] or "beauty"


def distance(one, other):
    """How far two values that differ in their bits are apart; infinite where one is no number."""
    apart = abs(one - other)
    return math.inf if math.isnan(apart) else apart


def places_of(one, kind, other, other_kind, width):
    """Where two channels of a line differ, and how far: in any bit, or in their values where they
    are of different types."""
    if kind == other_kind and one == other:
        return []
    step = TYPE_BYTES[kind]
    pairs = list(zip(values(one, kind), values(other, other_kind)))
    if kind != other_kind:
        return [(x, distance(*pair)) for x, pair in enumerate(pairs) if pair[0] != pair[1]]
    return [(x, distance(*pairs[x])) for x in range(width)
            if one[step * x:step * (x + 1)] != other[step * x:step * (x + 1)]]


class Difference:
    """What differs between two images of one shape: `pixels` in all, and the largest difference
    of each layer that is not the same."""

    def __init__(self):
        self.pixels = 0
        self.layers = {}

    def add_line(self, first, second, width):
        """Adds a line of both images: pairs of name and bytes of each channel, and its type."""
        changed = set()
        for (name, kind, one), (_, other_kind, other) in zip(first, second):
            places = places_of(one, kind, other, other_kind, width)
            changed.update(x for x, _ in places)
            if not places:
                continue
            layer = layer_of(name)
            largest = max(apart for _, apart in places)
            self.layers[layer] = max(self.layers.get(layer, 0.0), largest)
        self.pixels += len(changed)

    def report(self):
        """For JSON: the layer with the largest difference first."""
        layers = sorted(self.layers.items(), key=lambda item: -item[1])
        return {"pixels": self.pixels,
                "layers": [{"layer": layer, "largest": apart if math.isfinite(apart) else None}
                           for layer, apart in layers]}


def compare(first, second):
    """None where all pixels of two files are the same, else what differs, for JSON. Raises
    NotReadable."""
    one, other = Image(first), Image(second)
    if one.shape() != other.shape():
        return {"shape": "size or channels differ"}
    difference = Difference()
    same_header = (one.compression, one.channels) == (other.compression, other.channels)
    if same_header and one.blocks == other.blocks:
        return None
    for line, other_line in zip(one.all_lines(), other.all_lines()):
        difference.add_line(line, other_line, one.width)
    return difference.report() if difference.pixels else None
