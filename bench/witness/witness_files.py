# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Files that scenes with materials need beside their XML: meshes, textures and an environment."""

import math
import struct
import zlib

SEGMENTS, RINGS = 128, 64  # of a sphere
MAP_EDGE = 24  # texels of textures: larger than pixels, so that nothing is averaged


def _quads(columns, rows, at, texture):
    """Triangles of a grid of `at(i, j)`, (position, normal), with coordinates `texture(i, j)`. Those
    without area, at poles, are left out."""
    vertices, faces = [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            position, normal = at(i, j)
            vertices.append((*position, *normal, *texture(i, j)))
    for j in range(rows):
        for i in range(columns):
            a, b = j * (columns + 1) + i, (j + 1) * (columns + 1) + i
            for face in ((a, b, b + 1), (a, b + 1, a + 1)):
                if len({vertices[v][:3] for v in face}) == 3:
                    faces.append(face)
    return vertices, faces


def _sphere_point(i, j):
    theta, phi = math.pi * j / RINGS, 2.0 * math.pi * (i % SEGMENTS) / SEGMENTS
    sine = math.sin(theta) if 0 < j < RINGS else 0.0
    direction = (sine * math.sin(phi), math.cos(theta), sine * math.cos(phi))
    return direction, direction


def _faceted(vertices, faces):
    """With the normals of the triangles at their corners."""
    corners, numbers = [], []
    for face in faces:
        a, b, c = (vertices[v] for v in face)
        p = [b[k] - a[k] for k in range(3)]
        q = [c[k] - a[k] for k in range(3)]
        n = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
        length = math.sqrt(sum(x * x for x in n))
        n = tuple(x / length for x in n)
        numbers.append(tuple(range(len(corners), len(corners) + 3)))
        corners += [(*v[:3], *n, *v[6:]) for v in (a, b, c)]
    return corners, numbers


def _ply(vertices, faces):
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(vertices)}\n"
            + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz",
                                                             "u", "v"))
            + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    return (head.encode("ascii") + b"".join(struct.pack("<8f", *v) for v in vertices)
            + b"".join(struct.pack("<B3i", 3, *f) for f in faces))


def _sphere():
    return _quads(SEGMENTS, RINGS, _sphere_point,
                  lambda i, j: (i / SEGMENTS, 1.0 - j / RINGS))


def sphere_ply():
    """A sphere of radius 1 whose normals are those of its triangles."""
    return _ply(*_faceted(*_sphere()))


def smooth_sphere_ply():
    """A sphere of radius 1 with its own normals."""
    return _ply(*_sphere())


def _png(pixel):
    """An image of MAP_EDGE squared; `pixel(u, v)` gives three numbers in [0, 1] at the centre of a
    pixel, v from the bottom up."""
    rows = b""
    for y in range(MAP_EDGE):
        v = 1.0 - (y + 0.5) / MAP_EDGE
        rows += b"\0" + b"".join(
            bytes(round(255.0 * c) for c in pixel((x + 0.5) / MAP_EDGE, v))
            for x in range(MAP_EDGE))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", MAP_EDGE, MAP_EDGE, 8, 2, 0,
                                                             0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def bumps_png():
    """Normals of bumps that lean up to some 30 degrees."""
    def pixel(u, v):
        n = (0.6 * math.cos(8.0 * math.pi * u), 0.4 * math.cos(6.0 * math.pi * v), 1.0)
        length = math.sqrt(sum(x * x for x in n))
        return [0.5 + 0.5 * x / length for x in n]
    return _png(pixel)


def waves_png():
    """Grey that runs smoothly from black to white, for opacity and roughness."""
    def pixel(u, v):
        wave = 0.5 + 0.5 * math.sin(6.0 * math.pi * u) * math.sin(4.0 * math.pi * v)
        return [wave, wave, wave]
    return _png(pixel)


def colours_png():
    """Colours that change smoothly."""
    return _png(lambda u, v: (0.5 + 0.4 * math.sin(4.0 * math.pi * u),
                              0.5 + 0.4 * math.cos(6.0 * math.pi * u), 0.1 + 0.8 * v))


def sky_hdr():
    """An environment of 128 x 64 pixels: a gradient of coloured light with a bright round patch of
    some ten degrees, whose rim is soft."""
    width, height = 128, 64
    sun = (0.48, 0.62, 0.62)
    body = b""
    for y in range(height):
        for x in range(width):
            theta, phi = math.pi * (y + 0.5) / height, 2.0 * math.pi * (x + 0.5) / width
            d = (math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi))
            up = 0.5 + 0.5 * d[1]
            cosine = sum(a * b for a, b in zip(d, sun)) / math.sqrt(sum(s * s for s in sun))
            patch = 18.0 / (1.0 + math.exp(-(cosine - 0.975) * 300.0))
            colour = (0.25 + 0.2 * up + patch, 0.25 + 0.35 * up + 0.9 * patch,
                      0.2 + 0.7 * up + 0.12 * d[0] + 0.7 * patch)
            mantissa, exponent = math.frexp(max(colour))
            scale = mantissa * 256.0 / max(colour)
            body += bytes(int(c * scale) for c in colour) + bytes([exponent + 128])
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    return head.encode("ascii") + body


FILES = {"sphere.ply": sphere_ply, "smooth_sphere.ply": smooth_sphere_ply, "bumps.png": bumps_png,
         "waves.png": waves_png, "colours.png": colours_png, "sky.hdr": sky_hdr}
