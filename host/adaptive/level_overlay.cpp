// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "base/srgb.h"
#include "metrics/heat_map.h"
#include "metrics/numeric.h"
#include "metrics/rgb_view.h"

namespace weft {
namespace {

/// Place of a layer's value on the colour scale, [0, 1]; none where the image is to stay grey.
using Scale = std::optional<double> (*)(float value);

std::optional<double> of_level(float value) {
    return 0.5 * static_cast<double>(value);
}

std::optional<double> of_samples(float value) {
    if (!(value > 0.0F)) return std::nullopt;
    return 1.0;
}

std::optional<double> of_error(float value) {
    if (!(value > 0.0F)) return std::nullopt;
    return std::log2(static_cast<double>(value) / darkest_error) /
           std::log2(brightest_error / darkest_error);
}

struct Kind {
    std::string_view ending;
    Scale scale;
};
constexpr std::array<Kind, 4> kinds{{{".level", of_level},
                                     {".samples", of_samples},
                                     {".error", of_error},
                                     {".error_middle", of_error}}};

const Kind* kind_of(std::string_view name) {
    const auto* const found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) {
        return name.size() > kind.ending.size() && name.ends_with(kind.ending);
    });
    return found == kinds.end() ? nullptr : found;
}

/// Luminance of the beauty layer as a display shows it, [0, 1].
std::vector<float> grey(const Image& image, double exposure_ev) {
    std::vector<float> values =
        luminance(RgbView{image.find("")->values, image.width, image.height});
    const auto scale = static_cast<float>(std::exp2(exposure_ev));
    for (float& value : values) value *= scale;
    return srgb_encode(values);
}

}  // namespace

bool is_overlay_layer(std::string_view name) {
    return kind_of(name) != nullptr;
}

std::vector<std::string> overlay_layers(const Image& image) {
    std::vector<std::string> names;
    for (const Layer& layer : image.layers)
        if (layer.channels == "Y" && is_overlay_layer(layer.name)) names.push_back(layer.name);
    return names;
}

Image value_overlay(const Image& image, const std::function<std::optional<double>(std::size_t)>& of,
                    double exposure_ev) {
    const std::vector<float> under = grey(image, exposure_ev);
    const std::size_t pixels = under.size();
    Image result;
    result.width = image.width;
    result.height = image.height;
    result.layers = {{"", "RGB", std::vector<float>(3 * pixels)}};
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const std::optional<double> place = of(pixel);
        const std::array<std::uint8_t, 3> colour = viridis(place.value_or(0.0));
        for (std::size_t c = 0; c < colour.size(); ++c) {
            const float over = place ? static_cast<float>(colour.at(c)) / 255.0F : under[pixel];
            result.layers[0].values[c * pixels + pixel] =
                linear_from_srgb(0.5F * (under[pixel] + over));
        }
    }
    return result;
}

Image level_overlay(const Image& image, const std::string& layer, double exposure_ev) {
    const Layer* const shown = image.find(layer);
    const Kind* const kind = kind_of(layer);
    if (shown == nullptr || kind == nullptr)
        throw std::invalid_argument("an overlay needs a layer of levels, samples or errors");
    return value_overlay(
        image, [&](std::size_t pixel) { return kind->scale(shown->values[pixel]); }, exposure_ev);
}

}  // namespace weft
