# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Writes images as OpenEXR files, so that no renderer's Python needs a library for that."""

import os
import struct

import numpy as np


def attribute(name, kind, value):
    return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value


def header(width, height):
    channels = b"".join(name + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1)
                        for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    return b"".join([
        struct.pack("<ii", 20000630, 2),
        attribute(b"channels", b"chlist", channels),
        attribute(b"compression", b"compression", b"\0"),
        attribute(b"dataWindow", b"box2i", window),
        attribute(b"displayWindow", b"box2i", window),
        attribute(b"lineOrder", b"lineOrder", b"\0"),
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1.0)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0.0, 0.0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1.0)),
        b"\0"])


def write_exr(path, image):
    """Writes an array of height by width by 3, linear, top row first, as 32-bit floats without
    compression; the file appears whole."""
    height, width, _ = image.shape
    head = header(width, height)
    line = 8 + 12 * width
    first = len(head) + 8 * height
    offsets = (first + line * np.arange(height, dtype="<u8")).tobytes()
    part = f"{path}.part"
    with open(part, "wb") as file:
        file.write(head + offsets)
        for y in range(height):
            row = np.ascontiguousarray(image[y, :, ::-1].T, dtype="<f4")
            file.write(struct.pack("<ii", y, 12 * width) + row.tobytes())
    os.replace(part, path)
