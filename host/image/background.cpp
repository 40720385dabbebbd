// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/background.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace weft {
namespace {

/// Where the alpha of beauty is: a layer of its own, or the last channel of beauty, as images are
/// read from files.
struct AlphaPlane {
    std::size_t layer = 0;
    std::size_t first = 0;
    bool found = false;
};

AlphaPlane find_alpha(const Image& image) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    for (std::size_t i = 0; i < image.layers.size(); ++i) {
        const Layer& layer = image.layers[i];
        const std::size_t channel = layer.channels.find('A');
        if (!layer.name.empty() && layer.name != alpha_layer_name) continue;
        if (channel == std::string::npos) continue;
        if (layer.values.size() != layer.channels.size() * pixels) continue;
        return {i, channel * pixels, true};
    }
    return {};
}

}  // namespace

std::string to_string(const Background& background) {
    if (background.transparent) return "transparent";
    return fmt::format("{},{},{}", background.colour.r, background.colour.g, background.colour.b);
}

std::span<const float> alpha_of(const Image& image) {
    const AlphaPlane plane = find_alpha(image);
    if (!plane.found) return {};
    return std::span(image.layers[plane.layer].values)
        .subspan(plane.first, std::size_t{image.width} * image.height);
}

void put_behind(const Background& background, Image& image) {
    const AlphaPlane plane = find_alpha(image);
    if (background.transparent || !plane.found) return;
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const std::span<const float> found = alpha_of(image);
    const std::vector<float> alpha(found.begin(), found.end());
    for (Layer& layer : image.layers) {
        const bool shows =
            layer.name.empty() || layer.name == "emission" || layer.name == noisy_layer_name;
        if (!shows || !layer.channels.starts_with("RGB")) continue;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                layer.values[c * pixels + pixel] +=
                    (1.0F - alpha[pixel]) * background.colour[static_cast<glm::length_t>(c)];
    }
    std::fill_n(image.layers[plane.layer].values.begin() + static_cast<std::ptrdiff_t>(plane.first),
                pixels, 1.0F);
}

}  // namespace weft
