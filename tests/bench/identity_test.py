#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What bench identity calls the same, bit for bit, and what too slow: run as a program."""

import itertools
import json
import math
import pathlib
import struct
import sys
import tempfile
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench" / "identity"))

import builds  # noqa: E402
import exr_pixels  # noqa: E402
import frame_speed  # noqa: E402

WIDTH, HEIGHT = 5, 19  # a block of 16 lines and one of 3
CHANNELS = ("B", "depth.Z")


def predicted(data):
    parted = data[0::2] + data[1::2]
    before = itertools.chain([parted[0] - 128], parted)
    return bytes((byte - last + 128) & 255 for byte, last in zip(parted, before))


def attribute(name, kind, value):
    return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value


def runs(data):
    """Run-length encoding: repetitions of up to 128, and single bytes."""
    packed = b""
    for byte, group in itertools.groupby(data):
        count = len(list(group))
        while count > 0:
            length = min(count, 128)
            packed += bytes([length - 1, byte]) if length > 1 else bytes([255, byte])
            count -= length
    return packed


def exr_bytes(planes, compression, note=b"", packed=True, halves=False):
    """A file of two channels, the first of floats or halves, the second of floats; `packed` false
    keeps the bytes of ZIP or RLE as they are."""
    lines_of = {0: 1, 1: 1, 3: 16}[compression]
    kinds = [1 if halves else 2, 2]
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iiii", kind, 0, 1, 1)
                        for name, kind in zip(CHANNELS, kinds)) + b"\0"
    head = struct.pack("<ii", exr_pixels.MAGIC, 2) + b"".join([
        attribute(b"channels", b"chlist", channels), attribute(b"note", b"string", note),
        attribute(b"compression", b"compression", bytes([compression])),
        attribute(b"dataWindow", b"box2i", struct.pack("<4i", 0, 0, WIDTH - 1, HEIGHT - 1)),
        b"\0"])
    blocks = []
    for first in range(0, HEIGHT, lines_of):
        data = b"".join(line_bytes(plane[WIDTH * y:WIDTH * (y + 1)], kind)
                        for y in range(first, min(first + lines_of, HEIGHT))
                        for plane, kind in zip(planes, kinds))
        if compression and packed:
            shorter = (runs if compression == 1 else zlib.compress)(predicted(data))
            data = shorter if len(shorter) < len(data) else data
        blocks.append(struct.pack("<ii", first, len(data)) + data)
    start = len(head) + 8 * len(blocks)
    starts = itertools.accumulate((len(block) for block in blocks[:-1]), initial=start)
    return head + struct.pack(f"<{len(blocks)}Q", *starts) + b"".join(blocks)


def bits(value):
    return struct.unpack("<I", struct.pack("<f", value))[0]


def line_bytes(words, kind):
    """A line of a channel: the bits of floats, or the halves next to them."""
    data = struct.pack(f"<{len(words)}I", *words)
    if kind == 2:
        return data
    return struct.pack(f"<{len(words)}e", *struct.unpack(f"<{len(words)}f", data))


class Pixels(unittest.TestCase):
    def setUp(self):
        self.planes = [[bits(0.25 * (index // 3)) for index in range(WIDTH * HEIGHT)],
                       [bits(7.0)] * (WIDTH * HEIGHT)]

    def compared(self, first, second):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder) / name for name in ("one.exr", "other.exr")]
            for path, data in zip(paths, (first, second)):
                path.write_bytes(data)
            return exr_pixels.compare(*paths)

    def changed(self, *changes):
        planes = [list(plane) for plane in self.planes]
        for plane, index, word in changes:
            planes[plane][index] = word
        return planes

    def test_the_header_and_how_well_it_is_compressed_do_not_count(self):
        first = exr_bytes(self.planes, 3, b"one")
        second = exr_bytes(self.planes, 3, b"another", packed=False)
        self.assertNotEqual(len(first), len(second))
        self.assertIsNone(self.compared(first, second))
        for compression in (0, 1):
            third = exr_bytes(self.planes, compression)
            self.assertIsNone(self.compared(first, third), compression)

    def test_channels_of_other_types_are_compared_by_value(self):
        halves = exr_bytes(self.planes, 1, halves=True)
        self.assertIsNone(self.compared(exr_bytes(self.planes, 3), halves))
        self.assertIsNone(self.compared(halves, halves))
        planes = self.changed((0, 8, bits(1.0 + 2.0 ** -12)))
        self.assertEqual(self.compared(exr_bytes(planes, 3), exr_bytes(planes, 1, halves=True)),
                         {"pixels": 1, "layers": [{"layer": "beauty", "largest": 2.0 ** -12}]})

    def test_any_bit_of_any_channel_counts(self):
        for compression in (0, 1, 3):
            for index in (0, 1, WIDTH * 16 - 1, WIDTH * HEIGHT - 1):
                for bit in (0, 31):
                    planes = self.changed((1, index, bits(7.0) ^ (1 << bit)))
                    found = self.compared(*(exr_bytes(p, compression)
                                            for p in (self.planes, planes)))
                    self.assertEqual(found["pixels"], 1)
                    self.assertEqual([entry["layer"] for entry in found["layers"]], ["depth"])

    def test_zeros_of_other_sign_and_other_nans_differ(self):
        for one, other, largest in ((bits(0.0), bits(-0.0), 0.0), (0x7fc00000, 0x7fc00001, None),
                                    (bits(math.inf), bits(1.0), None)):
            pair = (exr_bytes(self.changed((0, 8, word)), 3) for word in (one, other))
            found = self.compared(*pair)
            self.assertEqual(found, {"pixels": 1, "layers": [{"layer": "beauty",
                                                              "largest": largest}]})

    def test_pixels_are_counted_once_and_the_largest_difference_comes_first(self):
        planes = self.changed((0, 8, bits(2.5)), (1, 8, bits(7.25)), (1, 40, bits(6.5)))
        found = self.compared(exr_bytes(self.planes, 3), exr_bytes(planes, 3))
        self.assertEqual(found, {"pixels": 2, "layers": [{"layer": "beauty", "largest": 2.0},
                                                         {"layer": "depth", "largest": 0.5}]})

    def test_another_kind_of_file_is_not_compared(self):
        whole = exr_bytes(self.planes, 0)
        other = whole.replace(CHANNELS[1].encode() + b"\0",
                              b"x" * len(CHANNELS[1]) + b"\0", 1)
        self.assertIn("shape", self.compared(whole, other))
        tiled = whole[:5] + b"\x02" + whole[6:]
        for data in (whole[:-1], whole[:20], b"", b"\x89PNG" + whole[4:], tiled):
            with self.assertRaises(exr_pixels.NotReadable):
                self.compared(whole, data)


class Speed(unittest.TestCase):
    @staticmethod
    def rounds(before, after):
        return [{"before": [ms * before, ms * before * 1.5, ms * before], "after": [ms * after]}
                for ms in (1.0, 1.25, 2.0)]

    def test_the_ratio_is_that_of_the_medians(self):
        found = frame_speed.summary_of(self.rounds(3.0, 4.0))
        self.assertEqual((found["before_ms"], found["after_ms"]), (3.75, 5.0))
        self.assertEqual(found["ratio"], 0.75)
        self.assertLessEqual(found["low"], 0.75)
        self.assertGreaterEqual(found["high"], 0.75)

    def test_processor_time_counts_where_every_round_has_it(self):
        rounds = self.rounds(1.0, 1.0)
        self.assertIsNone(frame_speed.summary_of(rounds)["cpu_ratio"])
        for pair, before in zip(rounds, (1.0, 3.0, 9.0)):
            self.assertIsNone(frame_speed.summary_of(rounds)["cpu_ratio"])
            pair["cpu"] = {"before": before, "after": 2.0}
        self.assertEqual(frame_speed.summary_of(rounds)["cpu_ratio"], 1.5)

    def test_slower_is_told_from_as_fast(self):
        summaries = {name: frame_speed.summary_of(self.rounds(before, 1.0))
                     for name, before in (("slower", 0.97), ("as fast", 0.99), ("faster", 1.5))}
        self.assertEqual(frame_speed.show(summaries), 1)


class Resume(unittest.TestCase):
    REPORT = {"benchmark": "identity", "settings": {"size": 32}, "programs": {"before": "1"}}

    def earlier(self, resume=True, **changes):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "identity.json"
            path.write_text(json.dumps({**self.REPORT, "results": {"a": 1}, **changes}),
                            encoding="utf-8")
            return builds.earlier_results(path, self.REPORT, resume)

    def test_goes_on_with_the_same_programs_alone(self):
        self.assertEqual(self.earlier(), {"a": 1})
        self.assertEqual(self.earlier(resume=False), {})
        self.assertEqual(self.earlier(programs={"before": "2"}), {})
        for changes in ({"settings": {"size": 64}}, {"settings": {"size": 32, "scenes": "1"}},
                        {"benchmark": "peers"}, {"results": []}):
            with self.assertRaises(builds.Failure):
                self.earlier(**changes)


if __name__ == "__main__":
    unittest.main()
