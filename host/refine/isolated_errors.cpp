// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/isolated_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "film/for_each_pixel.h"

namespace weft {
namespace {

// An error stands out that is more than so many times what is usual around it, and than twice so
// many standard errors of its samples.
constexpr float outstanding = 3.0F;
// So many times the variance of a pixel's samples may be an agreement by chance.
constexpr float standard_errors = 2.0F;

/// The error that both halves have at least, over all channels.
float agreed_error(const ExactHalves& difference, std::size_t i) {
    float squares = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) {
        const float first = difference.first[c].values[i];
        const float second = difference.second[c].values[i];
        if (!(first * second > 0.0F)) continue;
        const float least = std::min(std::abs(first), std::abs(second));
        squares += least * least;
    }
    return std::sqrt(squares);
}

}  // namespace

void correct_isolated(ExactHalves& difference, const Plane& variance, const SurfaceRuns& runs,
                      ColourPlanes& image) {
    const std::size_t pixels = variance.values.size();
    Plane agreed{variance.width, variance.height, std::vector<float>(pixels)};
    // Means are of square roots, which a single large value hardly changes.
    Plane roots = agreed;
    Plane noise_roots = agreed;
    for_each_pixel(pixels, [&](std::size_t i) {
        agreed.values[i] = agreed_error(difference, i);
        roots.values[i] = std::sqrt(agreed.values[i]);
        noise_roots.values[i] = std::sqrt(std::sqrt(variance.values[i]));
    });
    const std::array planes{&noise_roots, &roots};
    for (const std::uint32_t step : {1U, 2U}) smooth(planes, step, runs);
    for_each_pixel(pixels, [&](std::size_t i) {
        const float usual = roots.values[i] * roots.values[i];
        const float noise = noise_roots.values[i] * noise_roots.values[i];
        const float limit = outstanding * std::max(2.0F * noise, usual);
        if (!(agreed.values[i] > limit)) return;
        const auto [signal, power] = half_products(difference, i);
        const float known = signal - standard_errors * variance.values[i];
        const float share = known > 0.0F ? std::min(1.0F, known / power) : 0.0F;
        const float kept = usual / agreed.values[i];
        for (std::size_t c = 0; c < 3; ++c) {
            image[c].values[i] += share * (1.0F - kept) * difference.mean(c, i);
            difference.first[c].values[i] *= kept;
            difference.second[c].values[i] *= kept;
        }
    });
}

}  // namespace weft
