// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/isolated_errors.h"

#include <tbb/parallel_for.h>

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

// What one half alone has within so many pixels, both may have in one by chance.
constexpr std::uint32_t reach = 16;

float brightness(const ColourPlanes& planes, std::size_t i) {
    return planes[0].values[i] + planes[1].values[i] + planes[2].values[i];
}

void scale_pixel(ColourPlanes& planes, std::size_t i, float factor) {
    for (Plane& plane : planes) plane.values[i] *= factor;
}

/// How far the halves are apart.
float apart(const ExactHalves& halves, std::size_t i) {
    float squares = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) {
        const float channel = halves.first[c].values[i] - halves.second[c].values[i];
        squares += channel * channel;
    }
    return std::sqrt(squares);
}

/// The greatest value in the square of pixels that `reach` spans around each.
Plane greatest_around(const Plane& plane) {
    const std::size_t width = plane.width;
    Plane rows = plane;
    tbb::parallel_for(std::size_t{0}, std::size_t{plane.height}, [&](std::size_t y) {
        const float* const from = &plane.values[y * width];
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t begin = x > reach ? x - reach : 0;
            const std::size_t end = std::min(width, x + reach + 1);
            rows.values[y * width + x] = *std::max_element(from + begin, from + end);
        }
    });
    Plane all = rows;
    tbb::parallel_for(std::size_t{0}, std::size_t{plane.height}, [&](std::size_t y) {
        const std::size_t begin = y > reach ? y - reach : 0;
        const std::size_t end = std::min<std::size_t>(plane.height, y + reach + 1);
        float* const to = &all.values[y * width];
        for (std::size_t row = begin; row < end; ++row)
            for (std::size_t x = 0; x < width; ++x)
                to[x] = std::max(to[x], rows.values[row * width + x]);
    });
    return all;
}

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
    Plane of_one_half = agreed;
    Plane bright_roots = agreed;
    for_each_pixel(pixels, [&](std::size_t i) {
        agreed.values[i] = agreed_error(difference, i);
        roots.values[i] = std::sqrt(agreed.values[i]);
        noise_roots.values[i] = std::sqrt(std::sqrt(variance.values[i]));
        of_one_half.values[i] = apart(difference, i);
        bright_roots.values[i] = std::sqrt(std::max(0.0F, brightness(image, i)));
    });
    const std::array planes{&noise_roots, &roots, &bright_roots};
    for (const std::uint32_t step : {1U, 2U}) smooth(planes, step, runs);
    const Plane by_chance = greatest_around(of_one_half);
    for_each_pixel(pixels, [&](std::size_t i) {
        const float usual = roots.values[i] * roots.values[i];
        const float noise = noise_roots.values[i] * noise_roots.values[i];
        const float limit = outstanding * std::max(2.0F * noise, usual);
        if (!(agreed.values[i] > limit)) return;
        const auto [signal, power] = half_products(difference, i);
        const float known = signal - standard_errors * variance.values[i];
        float share = known > 0.0F ? std::min(1.0F, known / power) : 0.0F;
        const float bright = bright_roots.values[i] * bright_roots.values[i];
        const bool is_speck =
            brightness(difference.first, i) < 0.0F && brightness(image, i) > outstanding * bright;
        if (!is_speck && !(agreed.values[i] > by_chance.values[i])) share = 0.0F;
        const float kept = usual / agreed.values[i];
        for (std::size_t c = 0; c < 3; ++c)
            image[c].values[i] += share * (1.0F - kept) * difference.mean(c, i);
        scale_pixel(difference.first, i, kept);
        scale_pixel(difference.second, i, kept);
    });
}

}  // namespace weft
