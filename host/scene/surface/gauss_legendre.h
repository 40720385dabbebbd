// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_GAUSS_LEGENDRE_H
#define WEFT_SCENE_SURFACE_GAUSS_LEGENDRE_H

#include <cmath>
#include <numbers>
#include <vector>

namespace weft {

/// A place of [-1, 1] and its weight in an integral over it.
struct QuadraturePoint {
    double x;
    double weight;
};

/// The rule of Gauss and Legendre, exact for polynomials up to the degree 2 count - 1.
[[nodiscard]] inline std::vector<QuadraturePoint> gauss_legendre(int count) {
    std::vector<QuadraturePoint> points;
    for (int i = 0; i < count; ++i) {
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
        double slope = 0.0;
        // Newton's method from there takes four or five steps.
        for (int step = 0; step < 100; ++step) {
            double before = 1.0;
            double value = x;
            for (int n = 2; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
                before = value;
                value = next;
            }
            slope = count * (x * value - before) / (x * x - 1);
            const double change = value / slope;
            x -= change;
            if (std::abs(change) < 1e-15) break;
        }
        points.push_back({x, 2 / ((1 - x * x) * slope * slope)});
    }
    return points;
}

}  // namespace weft

#endif
