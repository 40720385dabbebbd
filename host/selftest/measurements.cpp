// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/measurements.h"

#include <cmath>

namespace weft::selftest {

Estimate over_seeds(const std::function<double(std::uint32_t)>& measure) {
    std::vector<double> values;
    for (std::uint32_t seed = 0; seed < image_seeds; ++seed) values.push_back(measure(seed));
    return estimate(values);
}

Estimate scaled(const Estimate& estimate, double factor) {
    return {factor * estimate.mean, std::abs(factor) * estimate.error};
}

double farthest_from(double expected, const std::vector<double>& values) {
    double farthest = expected;
    for (const double value : values) {
        if (!std::isfinite(value)) return value;
        if (std::abs(value - expected) > std::abs(farthest - expected)) farthest = value;
    }
    return farthest;
}

std::vector<double> irradiances(const Rendering& rendering, std::string_view layer,
                                std::uint32_t channel) {
    std::vector<double> values;
    for (std::uint32_t y = 0; y < rendering.image.height; ++y)
        for (std::uint32_t x = 0; x < rendering.image.width; ++x)
            values.push_back(rendering.irradiance(layer, x, y, channel));
    return values;
}

double mean_irradiance(const Rendering& rendering, std::string_view layer) {
    return estimate(irradiances(rendering, layer)).mean;
}

double bad_values(const Rendering& rendering) {
    return static_cast<double>(unclean_values(rendering.image) + guarded_values(rendering.stats));
}

}  // namespace weft::selftest
