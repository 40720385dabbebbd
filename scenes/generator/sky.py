# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A sky of our own as images of the environment: a hazy sun, thin clouds, and the ground. It is
computed by sums, products and square roots alone, which are the same on every machine."""

import math

from .noise import Clouds
from .solids import dot, unit
from .texture_images import png_rgba


def _mix(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def _step(low, high, x):
    t = max(0.0, min(1.0, (x - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


class Sky:
    """`sun` points to the sun. Radiances are in W/(m^2 sr), linear Rec.709."""

    ZENITH, HORIZON, GROUND = (0.22, 0.42, 0.88), (1.2, 1.16, 1.1), (0.28, 0.24, 0.2)
    SUN, GLOW, CLOUD = (34.0, 28.0, 20.0), (2.4, 1.8, 1.1), (1.75, 1.68, 1.6)

    def __init__(self, sun, seed=5):
        self._sun, self._clouds = unit(sun), Clouds(seed, 16)

    def radiance(self, direction):
        """What comes from a direction, a unit vector."""
        x, y, z = direction
        near = max(0.0, dot(direction, self._sun))
        glow = near * near * near
        glow = glow * glow * glow
        if y < 0.0:
            haze = _step(-0.12, 0.0, y)
            return _mix(self.GROUND, _mix(self.GROUND, self.HORIZON, 0.55), haze)
        low = (1.0 - y) * (1.0 - y)
        colour = _mix(self.ZENITH, self.HORIZON, low * low)
        lift = 0.22 + y
        cloud = self._clouds.fractal(2.2 * x / lift + 3.0, 2.0, 2.2 * z / lift + 9.0, 5)
        cover = _step(0.5, 0.72, cloud) * _step(0.02, 0.22, y) * 0.85
        colour = _mix(colour, self.CLOUD, cover)
        disc = _step(0.981, 0.99, near) * (1.0 - 0.35 * cover)
        return tuple(c + g * glow + s * disc for c, g, s in zip(colour, self.GLOW, self.SUN))


def _rgbe(colour):
    peak = max(colour)
    if peak < 1e-9:
        return bytes(4)
    exponent, scale = 0, 1.0
    while peak * scale >= 1.0:
        exponent, scale = exponent + 1, scale * 0.5
    while peak * scale < 0.5:
        exponent, scale = exponent - 1, scale * 2.0
    return bytes([*(int(c * scale * 256.0) for c in colour), exponent + 128])


def equirectangular(sky, width, height):
    """A Radiance HDR image whose middle lies at +x, and +z a quarter of its width to the right."""
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode("ascii")
    rows = []
    for j in range(height):
        angle = math.pi * (j + 0.5) / height
        y, ring = math.cos(angle), math.sin(angle)
        for i in range(width):
            turn = 2.0 * math.pi * ((i + 0.5) / width - 0.5)
            rows.append(_rgbe(sky.radiance((ring * math.cos(turn), y, ring * math.sin(turn)))))
    return head + b"".join(rows)


# Of a cube's faces +x, -x, +y, -y, +z, -z: the direction of a point s to the right, t down.
_FACES = (lambda s, t: (1.0, -t, -s), lambda s, t: (-1.0, -t, s), lambda s, t: (s, 1.0, t),
          lambda s, t: (s, -1.0, -t), lambda s, t: (s, -t, 1.0), lambda s, t: (-s, -t, -1.0))
# What a Lambertian surface makes of spherical harmonics of degree 0, 1 and 2.
_COSINE = (math.pi, 2.0 * math.pi / 3.0, math.pi / 4.0)


def _texels(face, size):
    """Directions of the middles of a face's texels, which are not unit vectors."""
    steps = [(2.0 * k + 1.0) / size - 1.0 for k in range(size)]
    return [_FACES[face](s, t) for t in steps for s in steps]


def _rgbd(colour):
    """Bytes of colour to be divided by a fourth one."""
    divisor = max(1, min(255, int(255.0 / max(max(colour), 1.0))))
    return [*(min(255, int(c * divisor + 0.5)) for c in colour), divisor]


def cube_images(sky, size):
    """The faces of the sky's cube as PNG images in RGBD, as EXT_lights_image_based has them."""
    return [png_rgba(size, size, [byte for d in _texels(face, size)
                                  for byte in _rgbd(sky.radiance(unit(d)))]) for face in range(6)]


def irradiance_coefficients(sky, size=32):
    """Nine spherical harmonics of the irradiance, for viewers that do not add up the image."""
    total = [[0.0, 0.0, 0.0] for _ in range(9)]
    for face in range(6):
        for d in _texels(face, size):
            x, y, z = unit(d)
            square = dot(d, d)
            weight = 4.0 / (size * size) / (square * math.sqrt(square))
            basis = (0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y,
                     1.092548 * y * z, 0.315392 * (3.0 * z * z - 1.0), 1.092548 * x * z,
                     0.546274 * (x * x - y * y))
            colour = sky.radiance((x, y, z))
            for row, value in zip(total, basis):
                for c in range(3):
                    row[c] += weight * value * colour[c]
    degree = (0, 1, 1, 1, 2, 2, 2, 2, 2)
    return [[round(_COSINE[degree[k]] * c, 4) + 0.0 for c in total[k]] for k in range(9)]
