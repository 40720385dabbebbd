// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/hdr_vdp_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft {

namespace {

// Responses at log10 luminance -4, -3.875, ..., 7.25 and at the logarithm of brightest_luminance.
constexpr std::array<double, 92> knots{
    0.000,    0.323,    0.684,    1.085,    1.540,    2.067,    2.674,    3.374,    4.177,
    5.098,    6.151,    7.353,    8.720,    10.263,   11.989,   13.914,   16.057,   18.457,
    21.184,   24.238,   27.624,   31.403,   35.680,   40.510,   45.943,   52.029,   58.761,
    66.150,   74.293,   83.211,   92.868,   103.321,  114.746,  127.169,  140.592,  154.937,
    170.146,  186.219,  203.077,  220.836,  239.656,  259.518,  280.322,  301.978,  324.403,
    347.544,  371.547,  396.414,  422.055,  448.356,  475.145,  502.377,  529.937,  557.762,
    585.799,  614.003,  642.337,  670.770,  699.281,  727.861,  756.503,  785.193,  813.919,
    842.672,  871.446,  900.235,  929.035,  957.844,  986.660,  1015.481, 1044.305, 1073.132,
    1101.962, 1130.793, 1159.624, 1188.457, 1217.290, 1246.124, 1274.959, 1303.793, 1332.628,
    1361.463, 1390.298, 1419.133, 1447.968, 1476.803, 1505.639, 1534.474, 1563.310, 1592.144,
    1620.980, 1638.200};
constexpr double first_knot = -4.0;
constexpr double knot_step = 0.125;
constexpr std::size_t intervals = knots.size() - 1;

double knot_width(std::size_t interval) {
    if (interval + 1 < intervals) return knot_step;
    return std::log10(brightest_luminance) -
           (first_knot + knot_step * static_cast<double>(interval));
}

double secant(std::size_t interval) {
    return (knots[interval + 1] - knots[interval]) / knot_width(interval);
}

}  // namespace

// A slope is that of the parabola through three knots. Neighbouring secants differ too little for a
// slope to leave the region where a cubic stays monotone (Fritsch and Carlson 1980), so none is
// limited.
RetinaResponse::RetinaResponse() : slopes_(knots.size()) {
    slopes_.front() = secant(0);
    slopes_.back() = secant(intervals - 1);
    for (std::size_t i = 1; i < intervals; ++i) {
        const double left = knot_width(i - 1);
        const double right = knot_width(i);
        slopes_[i] = (right * secant(i - 1) + left * secant(i)) / (left + right);
    }
}

double RetinaResponse::operator()(double luminance) const {
    if (luminance <= darkest_luminance) return knots.front();
    if (luminance >= brightest_luminance) return knots.back();
    const double position = (std::log10(luminance) - first_knot) / knot_step;
    const std::size_t i =
        std::min(static_cast<std::size_t>(std::max(position, 0.0)), intervals - 1);
    const double width = knot_width(i);
    const double t = (position - static_cast<double>(i)) * knot_step / width;
    const double u = 1.0 - t;
    return u * u * ((1.0 + 2.0 * t) * knots[i] + t * width * slopes_[i]) +
           t * t * ((1.0 + 2.0 * u) * knots[i + 1] - u * width * slopes_[i + 1]);
}

}  // namespace weft
