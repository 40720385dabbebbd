# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Spectra to linear Rec.709, with the CIE 1931 2 degree observer.

The colour matching functions are the analytic multi-lobe fit of Wyman, Sloan and Shirley,
"Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013.
"""

import math

FIRST_NM, LAST_NM = 400, 700

# XYZ to linear Rec.709 with its D65 white point (IEC 61966-2-1).
XYZ_TO_REC709 = (
    (3.2404542, -1.5371385, -0.4985314),
    (-0.9692660, 1.8760108, 0.0415560),
    (0.0556434, -0.2040259, 1.0572252),
)


def _lobe(nm, height, mean, below, above):
    """A Gaussian whose inverse width differs below and above its mean."""
    t = (nm - mean) * (below if nm < mean else above)
    return height * math.exp(-0.5 * t * t)


def xyz_sensitivity(nm):
    """The three colour matching functions at one wavelength in nanometres."""
    x = (_lobe(nm, 0.362, 442.0, 0.0624, 0.0374) + _lobe(nm, 1.056, 599.8, 0.0264, 0.0323)
         + _lobe(nm, -0.065, 501.1, 0.0490, 0.0382))
    y = _lobe(nm, 0.821, 568.8, 0.0213, 0.0247) + _lobe(nm, 0.286, 530.9, 0.0613, 0.0322)
    z = _lobe(nm, 1.217, 437.0, 0.0845, 0.0278) + _lobe(nm, 0.681, 459.0, 0.0385, 0.0725)
    return x, y, z


def piecewise_linear(first_nm, step_nm, values):
    """A spectrum, as a function of nanometres, through equally spaced values."""
    def at(nm):
        place = (nm - first_nm) / step_nm
        i = min(max(int(place), 0), len(values) - 2)
        return values[i] + (values[i + 1] - values[i]) * (place - i)
    return at


def _integral(function):
    """Trapezoidal rule over the measured range at 1 nm."""
    inner = math.fsum(function(nm) for nm in range(FIRST_NM + 1, LAST_NM))
    return inner + 0.5 * (function(FIRST_NM) + function(LAST_NM))


def _rec709_integral(spectrum):
    xyz = [_integral(lambda nm, k=k: spectrum(nm) * xyz_sensitivity(nm)[k]) for k in range(3)]
    return [sum(m * v for m, v in zip(row, xyz)) for row in XYZ_TO_REC709]


def emission(spectrum):
    """Radiance as linear Rec.709, scaled so that the spectrum 1 has luminance Y = 1."""
    luminance = _integral(lambda nm: xyz_sensitivity(nm)[1])
    return [max(v / luminance, 0.0) for v in _rec709_integral(spectrum)]


def reflectance(spectrum, illuminant):
    """Linear Rec.709 albedo that reflects `illuminant` with its true colour, within [0, 1]."""
    reflected = _rec709_integral(lambda nm: spectrum(nm) * illuminant(nm))
    incoming = _rec709_integral(illuminant)
    return [min(max(r / i, 0.0), 1.0) for r, i in zip(reflected, incoming)]
