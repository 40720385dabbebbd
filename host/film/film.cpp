// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <algorithm>
#include <vector>

#include "film/for_each_pixel.h"
#include "shared/shared_types.h"

namespace weft {

std::size_t film_planes(std::uint32_t features) {
    return shared::film_plane_count(features);
}

Image resolve_film(std::span<const float> high, std::span<const float> low, std::uint32_t width,
                   std::uint32_t height, std::uint32_t samples, std::uint32_t features) {
    const std::size_t pixels = std::size_t{width} * height;
    const double share = 1.0 / std::max(1U, samples);
    const auto mean = [&](std::size_t plane, std::size_t pixel) {
        const std::size_t at = plane * FILM_STRIDE(pixels) + pixel;
        const double rest = samples > 1 ? static_cast<double>(low[at]) : 0.0;
        return (static_cast<double>(high[at]) + rest) * share;
    };
    Image image;
    image.width = width;
    image.height = height;
    const auto add = [&](std::string_view name, const char* channels,
                         const std::vector<std::size_t>& planes, bool half = false) {
        Layer layer{std::string(name), channels, {}, false, half};
        layer.values.resize(layer.channels.size() * pixels);
        for (std::size_t c = 0; c < layer.channels.size(); ++c)
            for_each_pixel(pixels, [&](std::size_t pixel) {
                double sum = 0.0;
                for (const std::size_t plane : planes) sum += mean(plane + c, pixel);
                layer.values[c * pixels + pixel] = static_cast<float>(sum);
            });
        image.layers.push_back(std::move(layer));
    };
    std::vector<std::size_t> beauty{FILM_EMISSION, FILM_DIRECT, FILM_INDIRECT};
    for (std::size_t plane = FILM_PLANES; plane < film_planes(features); plane += 3)
        beauty.push_back(plane);
    add("", "RGB", beauty);
    add(alpha_layer_name, "A", {FILM_ALPHA});
    add("direct", "RGB", {FILM_DIRECT});
    add("indirect", "RGB", {FILM_INDIRECT});
    if ((features & FEATURE_REFLECTION) != 0)
        add("reflection", "RGB", {shared::film_reflection_plane(features)});
    if ((features & FEATURE_REFRACTION) != 0)
        add("refraction", "RGB", {shared::film_refraction_plane(features)});
    if ((features & FEATURE_GLOSSY) != 0)
        add("glossy", "RGB", {shared::film_glossy_plane(features)});
    if ((features & FEATURE_AIRLIGHT) != 0) add("media", "RGB", {FILM_MEDIA});
    add("emission", "RGB", {FILM_EMISSION});
    add("albedo", "RGB", {FILM_ALBEDO}, true);
    add("normal", "XYZ", {FILM_NORMAL}, true);
    add("depth", "Z", {FILM_DEPTH});
    return image;
}

}  // namespace weft
