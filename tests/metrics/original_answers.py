#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Prints what other programs answer to the stimuli of flip_test.cpp and numeric_metrics_test.cpp.

It needs, from PyPI: flip-evaluator (NVIDIA's FLIP), scikit-image (SSIM) and cvvdp (PU21, by an
author of PU21). Only one class of cvvdp is used, so `pip install --no-deps cvvdp` is enough.

All values of the stimuli are small integers times a power of two, and so the same floats here and
in C++.
"""

import ast
import importlib.metadata
import importlib.util
import pathlib

import flip_evaluator
import numpy
from skimage.metrics import structural_similarity

WIDTH, HEIGHT = 63, 47  # odd, so that one pixel has the median luminance
DEFAULT_PPD = 3840.0 * numpy.pi / 180.0
PIXELS = [(0, 0), (24, 16), (30, 20), (33, 23), (38, 25), (45, 40), (62, 46)]


def ramp(x, y, c):
    return (x * (c + 1) + y) / 256


def ramp_with_patch(x, y, c):
    patch = (x >= 24) & (x < 40) & (y >= 16) & (y < 28)
    return ramp(x, y, c) + numpy.where(patch, (c + 1) / 32, 0)


def checker(x, y, c):
    return (1 + (x // 8 * 7 + y // 8 * 3) * (2 * c + 1) % 14) / 16


def noisy_checker(x, y, c):
    return checker(x, y, c) + ((7 * x * x + 5 * x * y + 13 * y + 29 * c) % 17 - 8) / 256


def edge(x, y, c):
    return numpy.where(2 * x + y < 88, (c + 1) / 32, (7 - c) / 8)


def shifted_edge(x, y, c):
    return edge(x - 1, y, c)


def high_range(x, y, c):
    return numpy.exp2(20 * x // 62 - 10) * (8 + (5 * x + 3 * y + 7 * c) % 8) / 8


def striped_range(x, y, c):
    return high_range(x, y, c) * (16 + (3 * x + 5 * y + c) % 4) / 16


def lamp(x, y, c, centre=32):
    disc = (x - centre) ** 2 + (y - 24) ** 2 < 36
    return numpy.where(disc, 512 - 128 * c, (1 + (x // 8 + y // 8 + c) % 3) / 32)


def shifted_lamp(x, y, c):
    return lamp(x, y, c, 33)


PAIRS = {
    "ramp": (ramp, ramp_with_patch),
    "checker": (checker, noisy_checker),
    "edge": (edge, shifted_edge),
    "range": (high_range, striped_range),
    "lamp": (lamp, shifted_lamp),
    "unlike": (ramp, noisy_checker),
}


def images(name):
    y, x, c = numpy.indices((HEIGHT, WIDTH, 3))
    pair = [numpy.asarray(formula(x, y, c), dtype=numpy.float64) for formula in PAIRS[name]]
    floats = [image.astype(numpy.float32) for image in pair]
    assert all((a == b).all() and (b >= 0).all() for a, b in zip(pair, floats))
    return floats


def flip(name, dynamic_range, **parameters):
    reference, test = images(name)
    error, mean, used = flip_evaluator.evaluate(reference, test, dynamic_range, inputsRGB=False,
                                                applyMagma=False, parameters=parameters)
    print(f"{dynamic_range}-FLIP {name} {used}")
    values = ", ".join(f"{error[y, x, 0]:.7f}F" for x, y in PIXELS)
    # The program's own mean is a sum of floats, whose last digits are rounding.
    print(f"    {error.mean(dtype=numpy.float64):.8f} ({mean:.8f}), {{{values}}}")


def ssim(name, data_range):
    pair = [image[:, :, 1].astype(numpy.float64) for image in images(name)]
    mean, similarity = structural_similarity(
        *pair, data_range=data_range, gaussian_weights=True, sigma=1.5,
        use_sample_covariance=False, full=True)
    values = ", ".join(f"{similarity[y, x]:.13f}" for x, y in PIXELS[1:-1])
    print(f"SSIM {name}, green, range {data_range}")
    print(f"    {mean:.13f}, {{{values}}}")


def pu21():
    """The class PU of cvvdp, without the import of PyTorch, which it does not need for numbers."""
    module = pathlib.Path(importlib.util.find_spec("pycvvdp").origin).with_name("utils.py")
    tree = ast.parse(module.read_text())
    tree.body = [node for node in tree.body if getattr(node, "name", "") == "PU"]
    names = {"cache": lambda function: function}
    exec(compile(tree, str(module), "exec"), names)
    encoder = names["PU"](type="banding_glare")
    print("PU21")
    for exponent in range(-7, 14, 2):
        luminance = numpy.float64(2.0**exponent)
        print(f"    {{0x1p{exponent}, {encoder.encode(luminance):.10f}}},")
    for luminance in (0.005, 100.0, 1e4):
        print(f"    {{{luminance}, {encoder.encode(numpy.float64(luminance)):.10f}}},")


def main():
    for package in ("flip-evaluator", "scikit-image", "cvvdp"):
        print(package, importlib.metadata.version(package))
    for name in ("ramp", "checker", "edge"):
        flip(name, "LDR", ppd=DEFAULT_PPD)
    flip("checker", "LDR", ppd=20.0)
    for name, start, stop, count in (("range", -8.0, 4.0, 5), ("lamp", -9.0, 3.0, 4)):
        flip(name, "HDR", ppd=DEFAULT_PPD, startExposure=start, stopExposure=stop,
             numExposures=count, tonemapper="aces")
    for name in ("range", "lamp", "ramp", "edge"):
        flip(name, "HDR", ppd=DEFAULT_PPD, tonemapper="aces")
    for name in ("ramp", "checker", "edge", "unlike"):
        ssim(name, 1.0)
    ssim("range", 256.0)
    pu21()


if __name__ == "__main__":
    main()
