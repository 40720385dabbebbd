// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/sample_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "film/for_each_pixel.h"

namespace weft {
namespace {

/// The sum of the squares of the weights by which places of a run have become one on a scale. The
/// splines together are nearly a Gaussian; short runs are smoothed up to a quarter of their length.
float weight_squares(Run run, std::uint32_t scale) {
    const float spline = scale == 0 ? 1.0F : std::ldexp(0.5F, -static_cast<int>(scale));
    return std::clamp(2.0F / static_cast<float>(run.length()), spline, 1.0F);
}

/// How many independent details the neighbourhood of a pixel has along a run, about. Where the run
/// goes on far enough it is one over the sum of the squares of the weights, less by the square root
/// of two, since details next to each other hang together; the neighbourhood is 8 details wide.
float independent_details(Run run, std::uint32_t scale) {
    constexpr float most = 5.57F;
    constexpr float width = 7.8F;
    const float details = std::ldexp(static_cast<float>(run.length()), -static_cast<int>(scale));
    return std::clamp(details * (most / width), 1.0F, most);
}

}  // namespace

Plane sample_variance(const ExactHalves& halves) {
    const Plane& any = halves.first[0];
    Plane variance{any.width, any.height, std::vector<float>(any.values.size())};
    const float of_square = halves.first_share * (1.0F - halves.first_share);
    for_each_pixel(any.values.size(), [&](std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float apart = halves.first[c].values[i] - halves.second[c].values[i];
            variance.values[i] += of_square * apart * apart;
        }
    });
    const Plane around = smoothed(variance, 1);
    for_each_pixel(any.values.size(), [&](std::size_t i) {
        variance.values[i] = std::max(variance.values[i], around.values[i]);
    });
    return variance;
}

float noise_left(Run row, Run column, std::uint32_t scale) {
    return weight_squares(row, scale) * weight_squares(column, scale);
}

float chance_agreement(Run row, Run column, std::uint32_t scale, std::uint64_t samples) {
    const float n = independent_details(row, scale) * independent_details(column, scale);
    return (1.0F / std::sqrt(n) + 1.0F / n) * (1.0F + 2.0F / static_cast<float>(samples));
}

}  // namespace weft
