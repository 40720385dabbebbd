// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/noisy_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "denoise/layer_values.h"
#include "denoise/padded_rows.h"

namespace weft {

NoisyLight::NoisyLight(const Image& image, const DenoiseView& view, const Padding& padding) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const std::span<const float> beauty = layer_values(image, "", 3);
    const std::span<const float> emission = layer_values(image, "emission", 3);
    const std::span<const float> albedo = layer_values(image, "albedo", 3);
    const std::span<const float> variances = layer_values(image, "variance", 3);
    const auto albedo_of = [&](std::size_t at) { return view.media ? 1.0 : double{albedo[at]}; };
    const auto light_of = [&](std::size_t at) {
        return (double{beauty[at]} - emission[at]) / albedo_of(at);
    };
    const auto is_lit = [&](std::size_t pixel) {
        bool reflects = false;
        for (std::size_t at = pixel; at < 3 * pixels; at += pixels) {
            if (emission[at] != 0.0F) return false;
            if (!(albedo_of(at) > 0.0)) continue;
            if (!std::isfinite(light_of(at)) || !std::isfinite(variances[at])) return false;
            reflects = true;
        }
        return reflects;
    };
    lit.resize(padding.size());
    double largest = 0.0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        if (!is_lit(pixel)) continue;
        lit[padding.at(pixel % padding.width(), pixel / padding.width())] = 1.0F;
        for (std::size_t at = pixel; at < 3 * pixels; at += pixels)
            if (albedo_of(at) > 0.0) largest = std::max(largest, std::abs(light_of(at)));
    }
    if (largest > 0.0) scale = std::ldexp(1.0, -std::ilogb(largest));
    for (std::size_t c = 0; c < 3; ++c) {
        mean[c].resize(padding.size());
        variance[c].resize(padding.size(), -1.0F);
        for_each_padded(padding, [&](std::size_t pixel, std::size_t i, std::size_t, std::size_t) {
            const std::size_t at = c * pixels + pixel;
            if (lit[i] == 0.0F || !(albedo_of(at) > 0.0)) return;
            const double unit = scale / albedo_of(at);
            constexpr double most = std::numeric_limits<float>::max() / 64.0;  // sums stay finite
            mean[c][i] = static_cast<float>(light_of(at) * scale);
            variance[c][i] = static_cast<float>(std::min(unit * unit * variances[at], most));
        });
    }
}

}  // namespace weft
