// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_HDR_VDP_STIMULI_H
#define WEFT_SELFTEST_HDR_VDP_STIMULI_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "metrics/hdr_vdp.h"

namespace weft::selftest {

inline constexpr std::uint32_t stimulus_edge = 256;
inline constexpr double stimulus_ppd = 30.0;
inline constexpr std::size_t stimulus_centre = std::size_t{128} * stimulus_edge + 128;

/// Luminance in cd/m^2 by pixel position.
using Luminance = std::function<double(std::uint32_t x, std::uint32_t y)>;

inline std::vector<float> luminance_map(std::uint32_t width, std::uint32_t height,
                                        const Luminance& luminance) {
    std::vector<float> map;
    map.reserve(std::size_t{width} * height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            map.push_back(static_cast<float>(luminance(x, y)));
    return map;
}

/// Settings that reproduce the original program of 2005, with luminances as they are.
inline HdrVdpSettings parity_settings() {
    HdrVdpSettings settings;
    settings.pixels_per_degree = stimulus_ppd;
    settings.luminance_scale = 1.0;
    settings.legacy_fan = true;
    settings.legacy_otf_grid = true;
    return settings;
}

inline HdrVdpResult compare(const Luminance& test, const Luminance& reference,
                            const HdrVdpSettings& settings = parity_settings()) {
    return hdr_vdp(luminance_map(stimulus_edge, stimulus_edge, test),
                   luminance_map(stimulus_edge, stimulus_edge, reference), stimulus_edge,
                   stimulus_edge, settings);
}

inline float largest(const HdrVdpResult& result) {
    return *std::max_element(result.probability.begin(), result.probability.end());
}

/// Horizontal wave of `frequency` cycles per degree with amplitude 1 and its crest in the middle.
inline double wave(std::uint32_t x, double frequency) {
    return std::cos(2.0 * std::numbers::pi * frequency * (x - 128.0) / stimulus_ppd);
}

/// Gaussian envelope around the middle with a standard deviation of half a degree.
inline double window(std::uint32_t x, std::uint32_t y) {
    const double horizontal = (x - 128.0) / stimulus_ppd;
    const double vertical = (y - 128.0) / stimulus_ppd;
    return std::exp(-(horizontal * horizontal + vertical * vertical) / 0.5);
}

/// A Gabor patch of `contrast` on uniform `luminance`, and the original program's results:
/// probability in the middle, mean probability, percent of pixels of at least 0.75 and 0.95.
struct GaborPatch {
    double luminance;
    double frequency;
    double contrast;
    double probability;
    double mean;
    double p75;
    double p95;

    [[nodiscard]] double operator()(std::uint32_t x, std::uint32_t y) const {
        return luminance * (1.0 + contrast * wave(x, frequency) * window(x, y));
    }
    [[nodiscard]] Luminance background() const {
        return [level = luminance](std::uint32_t, std::uint32_t) { return level; };
    }
    [[nodiscard]] std::string name() const {
        return std::to_string(luminance) + " cd/m^2, " + std::to_string(frequency) + " cpd, " +
               std::to_string(contrast);
    }
};

}  // namespace weft::selftest

#endif
