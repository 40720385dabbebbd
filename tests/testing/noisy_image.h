// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_NOISY_IMAGE_H
#define WEFT_TESTS_TESTING_NOISY_IMAGE_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace weft::test {

/// An image with the layers that denoisers read: a grey wall that faces the camera at distance 2,
/// without light.
inline Image dark_wall(std::uint32_t width, std::uint32_t height) {
    Image image{.width = width, .height = height, .layers = {}, .metadata = {}};
    const std::size_t pixels = std::size_t{width} * height;
    const auto add = [&](const char* name, const char* channels, std::vector<float> values) {
        image.layers.push_back({name, channels, {}});
        for (const float value : values)
            image.layers.back().values.insert(image.layers.back().values.end(), pixels, value);
    };
    add("", "RGB", {0.0F, 0.0F, 0.0F});
    add("alpha", "A", {1.0F});
    add("emission", "RGB", {0.0F, 0.0F, 0.0F});
    add("albedo", "RGB", {0.5F, 0.5F, 0.5F});
    add("normal", "XYZ", {0.0F, 0.0F, 1.0F});
    add("depth", "Z", {2.0F});
    add("variance", "RGB", {0.0F, 0.0F, 0.0F});
    return image;
}

/// The values of one of its layers.
inline std::vector<float>& values_of(Image& image, std::string_view name) {
    for (Layer& layer : image.layers)
        if (layer.name == name) return layer.values;
    throw std::out_of_range("no such layer");
}

/// Lets each pixel reflect its albedo times `light(x, y)`, plus noise of that standard deviation
/// (times the albedo), the same in all channels.
template <class Light>
void shine(Image& image, const Light& light, double deviation, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const std::size_t pixels = std::size_t{image.width} * image.height;
    for (std::size_t i = 0; i < pixels; ++i) {
        const double noise = deviation * normal(random);
        for (std::size_t at = i; at < 3 * pixels; at += pixels) {
            const double albedo = values_of(image, "albedo")[at];
            values_of(image, "")[at] =
                static_cast<float>(albedo * (light(i % image.width, i / image.width) + noise));
            values_of(image, "variance")[at] =
                static_cast<float>(albedo * albedo * deviation * deviation);
        }
    }
}

}  // namespace weft::test

#endif
