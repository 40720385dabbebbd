# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Seeds of the targets image, png, exr and hdr."""
import struct
import zlib


def png(width, height, kind=2, depth=8, interlaced=False, extra=()):
    """A PNG of zeros and ramps; kind is the colour type, extra are chunks before the data."""

    def chunk(name, data):
        body = name + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind]
    passes = [(0, 0, 1, 1)]
    if interlaced:
        passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4),
                  (1, 0, 2, 2), (0, 1, 1, 2)]
    rows = b""
    for x, y, dx, dy in passes:
        columns = max(0, (width - x + dx - 1) // dx)
        size = (columns * channels * depth + 7) // 8
        for row in range(y, height, dy):
            if columns:
                mask = 1 if kind == 3 else 255
                rows += bytes([row % 5]) + bytes((row * 7 + i * 3) & mask for i in range(size))
    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, int(interlaced))
    text = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
    if kind == 3:
        text += chunk(b"PLTE", bytes(range(12)))
    for name, data in extra:
        text += chunk(name, data)
    return text + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def bmp(width, height, bits, compression=0, top_down=False):
    palette = b"".join(bytes([i, 2 * i & 255, 255 - i, 0]) for i in range(1 << bits)) \
        if bits <= 8 else b""
    masks = struct.pack("<III", 0xF800, 0x07E0, 0x001F) if compression == 3 else b""
    stride = (width * bits + 31) // 32 * 4
    pixels = bytes((i * 5) & 255 for i in range(stride * height))
    if bits <= 4:
        pixels = bytes(stride * height)
    offset = 14 + 40 + len(masks) + len(palette)
    info = struct.pack("<IiiHHIIiiII", 40, width, -height if top_down else height, 1, bits,
                       compression, len(pixels), 0, 0, 0, 0)
    return struct.pack("<2sIHHI", b"BM", offset + len(pixels), 0, 0, offset) + info + masks + \
        palette + pixels


def tga(width, height, kind, bits):
    """kind 1 palette, 2 colours, 3 grey, 8 more for run lengths."""
    palette = bytes(range(12)) if kind % 8 == 1 else b""
    header = struct.pack("<BBBHHBHHHHBB", 0, int(bool(palette)), kind, 0, 4 if palette else 0,
                         24 if palette else 0, 0, 0, width, height, bits, 0x20)
    size = bits // 8
    pixel = bytes((3 * i + 1) & 3 for i in range(size))
    if kind < 8:
        return header + palette + pixel * (width * height)
    total = width * height
    run = bytes([0x80 | (total // 2 - 1)]) + pixel
    raw = bytes([total - total // 2 - 1]) + pixel * (total - total // 2)
    return header + palette + run + raw


# Code lengths 1 to 16 and symbols of small Huffman tables.
_DC = bytes([0, 2] + [0] * 14 + [0, 4])
_AC = bytes([0, 2, 1] + [0] * 13 + [0x00, 0x01, 0x11])


def jpeg(width, height, components, progressive=False, restart=0, subsampled=False):
    """A JPEG whose coefficients are whatever the zero bits of its scans mean."""

    def segment(mark, data):
        return struct.pack(">BBH", 0xFF, mark, len(data) + 2) + data

    ids = list(range(1, components + 1))
    frame = struct.pack(">BHHB", 8, height, width, components)
    for i in ids:
        frame += bytes([i, 0x22 if subsampled and i == 1 else 0x11, 0])
    data = b"\xff\xd8" + segment(0xE0, b"JFIF\0\1\1\0\0\1\0\1\0\0")
    if components == 4:
        data += segment(0xEE, b"Adobe\0\x64\0\0\0\0\2")
    data += segment(0xDB, b"\0" + bytes([16] * 64))
    data += segment(0xC2 if progressive else 0xC0, frame)
    data += segment(0xC4, b"\x00" + _DC) + segment(0xC4, b"\x10" + _AC)
    if restart:
        data += segment(0xDD, struct.pack(">H", restart))
    scans = [(ids, 0, 63, 0)]
    if progressive:
        scans = [(ids, 0, 0, 1), ([1], 1, 63, 1), (ids, 0, 0, 0x10), ([1], 1, 63, 0x10)]
    for members, first, last, bits in scans:
        head = bytes([len(members)]) + b"".join(bytes([i, 0]) for i in members)
        data += segment(0xDA, head + bytes([first, last, bits]))
        if restart:
            data += b"\0\0\xff\xd0\0\0\xff\xd1"
        data += bytes(24)
    return data + b"\xff\xd9"


def image_files():
    files = {
        "rgb.png": png(5, 3),
        "grey1.png": png(11, 4, 0, 1),
        "grey16.png": png(3, 3, 0, 16),
        "palette.png": png(6, 5, 3, 4, extra=[(b"tRNS", b"\0\x80")]),
        "greyalpha.png": png(4, 4, 4),
        "rgba16.png": png(3, 2, 6, 16),
        "interlaced.png": png(9, 9, 6, 8, True),
        "key.png": png(4, 4, 2, 8, extra=[(b"gAMA", b"\0\0\xb1\x8f"), (b"tRNS", bytes(6))]),
        "grey.jpg": jpeg(9, 9, 1),
        "colour.jpg": jpeg(17, 9, 3, subsampled=True),
        "restart.jpg": jpeg(24, 8, 3, restart=1),
        "cmyk.jpg": jpeg(8, 8, 4),
        "progressive.jpg": jpeg(16, 16, 3, progressive=True),
        "1.bmp": bmp(9, 3, 1),
        "4.bmp": bmp(5, 3, 4),
        "8.bmp": bmp(3, 3, 8)[:1200],
        "16.bmp": bmp(3, 3, 16, 3),
        "24.bmp": bmp(3, 3, 24),
        "32.bmp": bmp(3, 3, 32, top_down=True),
        "palette.tga": tga(3, 2, 1, 8),
        "colour.tga": tga(3, 2, 2, 24),
        "15.tga": tga(3, 2, 2, 16),
        "grey.tga": tga(3, 2, 3, 8),
        "runs.tga": tga(8, 2, 10, 32),
        "greyruns.tga": tga(8, 2, 11, 8),
        "badlarge.png": png(5, 3)[:16] + struct.pack(">II", 1 << 24, 1 << 24) + png(5, 3)[24:],
        # A fill byte before the first marker; a table of 272 symbols, read past its own segment.
        "badtable.jpg": b"\xff\xff\xd8\xff\xc4\0\x03\0" + bytes([17] * 16) + bytes(300),
        "badend.png": png(5, 3)[:60],
    }
    return files


def exr(width, height, channels, compression=0, extra=(), origin=(0, 0)):
    """channels: (name, type) with type 0 integer, 1 half, 2 float. compression: 0 to 9, where the
    lossy ones 6 to 9 take halves alone."""

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    channels = sorted(channels)
    listed = b"".join(n + b"\0" + struct.pack("<IIii", t, 0, 1, 1) for n, t in channels) + b"\0"
    x, y = origin
    box = struct.pack("<iiii", x, y, x + width - 1, y + height - 1)
    head = b"\x76\x2f\x31\x01" + struct.pack("<I", 2)
    head += attribute(b"channels", b"chlist", listed)
    head += attribute(b"compression", b"compression", bytes([compression]))
    head += attribute(b"dataWindow", b"box2i", box)
    head += attribute(b"displayWindow", b"box2i", box)
    head += attribute(b"lineOrder", b"lineOrder", b"\0")
    head += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    head += attribute(b"screenWindowCenter", b"v2f", bytes(8))
    head += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
    for item in extra:
        head += attribute(*item)
    head += b"\0"
    lines = {0: 1, 1: 1, 2: 1, 3: 16, 4: 32, 5: 16, 6: 32, 7: 32, 8: 32, 9: 256}[compression]
    chunks = []
    for first in range(0, height, lines):
        raw = b""
        rows = range(first, min(first + lines, height))
        for row in rows:
            for _, kind in channels:
                value = {0: struct.pack("<I", row), 1: struct.pack("<H", 0x3C00 + row),
                         2: struct.pack("<f", row + 0.5)}[kind]
                raw += value * width
        data = raw
        if compression == 1:
            data = _exr_runs(_exr_shuffled(raw))
        elif compression in (2, 3):
            data = zlib.compress(_exr_shuffled(raw), 9)
        elif compression == 5:
            data = _exr_pxr24(width, rows, channels)
        elif compression in (6, 7):
            data = _exr_b44(width, rows, channels, compression == 7)
        elif compression in (8, 9):
            data = _exr_dwa(width, rows, channels)
        chunks.append(struct.pack("<iI", y + first, min(len(data), len(raw))) +
                      (data if len(data) < len(raw) else raw))
    offset = len(head) + 8 * len(chunks)
    table = b""
    for chunk in chunks:
        table += struct.pack("<Q", offset)
        offset += len(chunk)
    return head + table + b"".join(chunks)


def _exr_shuffled(raw):
    """Even bytes, odd bytes, then differences, as OpenEXR does before it compresses."""
    data = raw[0::2] + raw[1::2]
    return bytes([data[0]]) + bytes((data[i] - data[i - 1] + 128) & 255
                                    for i in range(1, len(data)))


def _exr_runs(data):
    result = b""
    i = 0
    while i < len(data):
        end = i
        while end < len(data) and data[end] == data[i] and end - i < 128:
            end += 1
        result += bytes([end - i - 1, data[i]]) if end - i > 2 else bytes([255, data[i]])
        i = end if end - i > 2 else i + 1
    return result


def _exr_pxr24(width, rows, channels):
    """Differences along each row, as planes of bytes; floats lose their last eight bits."""
    data = b""
    for row in rows:
        for _, kind in channels:
            value = {0: row, 1: 0x3C00 + row,
                     2: struct.unpack("<I", struct.pack("<f", row + 0.5))[0] >> 8}[kind]
            size = {0: 4, 1: 2, 2: 3}[kind]
            differences = [value] + [0] * (width - 1)
            for byte in reversed(range(size)):
                data += bytes(d >> 8 * byte & 255 for d in differences)
    return zlib.compress(data, 9)


def _exr_b44(width, rows, channels, flat):
    """Blocks of 4x4 halves of one value: its bits and, unless flat, differences of nothing."""
    data = b""
    for _ in channels:
        for row in range(rows.start, rows.stop, 4):
            ordered = struct.pack(">H", 0x3C00 + row | 0x8000)
            block = ordered + b"\xfc" if flat else \
                ordered + bytes.fromhex("02 08 20 82 08 20 82 08 20 82 08 20")
            data += block * ((width + 3) // 4)
    return data


def _exr_dwa(width, rows, channels):
    """Blocks of 8x8 halves of one value, which is their first coefficient: all others are left out.
    Channels other than R, G and B are deflated (A in runs)."""
    blocks = (width + 7) // 8 * ((len(rows) + 7) // 8)
    colours = [name for name, _ in channels if name in (b"R", b"G", b"B")]
    rules = b"".join(name + b"\0" + struct.pack("<BB", ((i + 1) << 4) | 1 << 2, 1)
                     for i, name in enumerate((b"R", b"G", b"B")))
    rules += b"A\0" + struct.pack("<BB", 2 << 2, 1)
    rules = struct.pack("<H", len(rules) + 2) + rules
    others = [name for name, _ in channels if name not in (b"R", b"G", b"B", b"A")]
    plain = b"".join(struct.pack("<H", 0x3C00) * width for _ in rows for _ in others)
    ac = struct.pack("<H", 0xFF00) * blocks * len(colours)
    dc = struct.pack("<H", 0x4000) * blocks * len(colours)
    alpha = bytes(width * len(rows)) + b"\x3c" * (width * len(rows)) \
        if (b"A", 1) in channels else b""
    runs = _exr_runs(alpha)
    packed = [zlib.compress(data, 9) if data else b""
              for data in (plain, ac, _exr_shuffled(dc) if dc else b"", runs)]
    sizes = struct.pack("<11Q", 2, len(plain), len(packed[0]), len(packed[1]), len(packed[2]),
                        len(packed[3]), len(runs), len(alpha), len(ac) // 2, len(dc) // 2, 1)
    return sizes + rules + b"".join(packed)


def exr_files():
    rgb = [(b"R", 2), (b"G", 2), (b"B", 2)]
    layers = [(b"R", 1), (b"G", 1), (b"B", 1), (b"A", 1), (b"Z", 2), (b"direct.R", 2),
              (b"direct.G", 2), (b"direct.B", 2), (b"ids", 0), (b"normal.X", 1)]
    halves = [(b"R", 1), (b"G", 1), (b"B", 1), (b"A", 1), (b"direct.Z", 1)]
    note = (b"weft", b"string", b"a text")
    return {
        "plain.exr": exr(4, 3, rgb),
        "layers.exr": exr(3, 2, layers, extra=[note]),
        "runs.exr": exr(16, 3, rgb, 1),
        "zips.exr": exr(8, 3, rgb, 2),
        "zip.exr": exr(8, 20, layers, 3, origin=(-3, 5)),
        "chromaticities.exr": exr(2, 2, rgb, extra=[
            (b"chromaticities", b"chromaticities", struct.pack("<8f", *[0.3] * 8)),
            (b"owner", b"string", b"nobody"), (b"m", b"m44f", bytes(64))]),
        "piz.exr": exr(4, 32, rgb, 4),
        "pxr24.exr": exr(8, 20, layers, 5),
        "b44.exr": exr(9, 34, halves, 6),
        "b44a.exr": exr(9, 34, halves, 7),
        "dwaa.exr": exr(64, 40, halves, 8),
        "dwab.exr": exr(64, 40, halves, 9),
        "type.exr": exr(2, 2, rgb, extra=[(b"type", b"string", b"scanlineimage"),
                                          (b"chunkCount", b"int", struct.pack("<i", 2))]),
        "badcut.exr": exr(4, 3, rgb)[:-3],
        "badcompression.exr": exr(4, 3, rgb).replace(b"compression\0\1\0\0\0\0",
                                                     b"compression\0\1\0\0\0\x0a"),
        "badtype.exr": exr(2, 2, rgb, extra=[(b"type", b"string", b"tiledimage")]),
    }


def png_files():
    """Those images that other targets read as textures, and more of what only PNG has."""
    files = {name: data for name, data in image_files().items() if name.endswith(".png")}
    files["rgb16.png"] = png(4, 3, 2, 16)
    files["grey2.png"] = png(5, 2, 0, 2, True)
    files["badsum.png"] = files["rgb.png"][:-20] + b"\0" + files["rgb.png"][-19:]
    return files


def hdr(rows, resolution, lines=("FORMAT=32-bit_rle_rgbe",)):
    head = "#?RADIANCE\n" + "".join(line + "\n" for line in lines) + "\n" + resolution + "\n"
    return head.encode() + rows


def hdr_files():
    flat = bytes((7 * i) & 255 for i in range(4 * 6))
    old = bytes([9, 8, 7, 129, 1, 1, 1, 44, 5, 5, 5, 5, 1, 1, 1, 2, 1, 1, 1, 1])
    new = bytes([2, 2, 0, 12, 128 + 12, 3, 4, 1, 2, 3, 4, 128 + 8, 9, 12] + list(range(12)) +
                [128 + 6, 128, 6] + [127, 128, 129, 130, 131, 0])
    files = {
        "flat.hdr": hdr(flat, "-Y 2 +X 3"),
        "old.hdr": hdr(old, "-Y 1 +X 304"),
        "new.hdr": hdr(new + new, "-Y 2 +X 12"),
        "exposures.hdr": hdr(flat, "-Y 2 +X 3", ("# a note", "EXPOSURE=2.5", "EXPOSURE= 1e-3",
                                                 "COLORCORR=1 0.5 2", "SOFTWARE=seed")),
        "badxyz.hdr": hdr(flat, "-Y 2 +X 3", ("FORMAT=32-bit_rle_xyze",)),
        "badlarge.hdr": hdr(flat, "-Y 30000 +X 30000"),
        "badrun.hdr": hdr(new[:4] + b"\xff" + new[5:], "-Y 1 +X 12"),
    }
    for name, resolution in {"bottomup": "+Y 2 +X 3", "mirrored": "-Y 2 -X 3",
                             "columns": "+X 3 -Y 2", "turned": "-X 3 +Y 2"}.items():
        files[name + ".hdr"] = hdr(flat, resolution)
    return files
