// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/compared_image.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "base/error.h"
#include "base/quote.h"
#include "image/load_image.h"

namespace weft {
namespace {

std::string layer_names(const Image& image) {
    std::string names;
    for (const Layer& layer : image.layers)
        names += (names.empty() ? "" : ", ") + (layer.name.empty() ? "beauty" : quote(layer.name));
    return names;
}

void check_finite(const ComparedImage& compared) {
    const std::size_t pixels = compared.view().pixels();
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const bool finite = std::isfinite(compared.rgb[i]) &&
                            std::isfinite(compared.rgb[pixels + i]) &&
                            std::isfinite(compared.rgb[2 * pixels + i]);
        if (finite) continue;
        if (count++ == 0) first = i;
    }
    if (count > 0)
        throw input_error(compared.place,
                          fmt::format("{} of {} pixels {} NaN or infinite, the first at "
                                      "column {}, row {}; expected finite values",
                                      count, pixels, count == 1 ? "is" : "are",
                                      first % compared.width, first / compared.width));
}

}  // namespace

ComparedImage compared_image(const Image& image, const std::string& place,
                             const std::optional<std::string>& layer_name) {
    const Layer* layer = image.find(layer_name.value_or(""));
    if (layer == nullptr)
        throw input_error(place, (layer_name ? "has no layer " + quote(*layer_name)
                                             : std::string("has no beauty layer")) +
                                     ", its layers are: " + layer_names(image));
    ComparedImage compared{place, {}, image.width, image.height, is_display_referred(image)};
    const std::size_t pixels = compared.view().pixels();
    const bool grey = layer->channels.size() == 1;
    if (layer->words || (!grey && !layer->channels.starts_with("RGB")))
        throw input_error(place, "has the channels " + quote(layer->channels) +
                                     " in the layer to compare, expected RGB or a single one");
    const auto begin = layer->values.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(grey ? pixels : 3 * pixels);
    compared.rgb.reserve(3 * pixels);
    for (int copy = 0; copy < (grey ? 3 : 1); ++copy)
        compared.rgb.insert(compared.rgb.end(), begin, end);
    check_finite(compared);
    return compared;
}

void check_same_size(const ComparedImage& image, const ComparedImage& reference) {
    if (image.width == reference.width && image.height == reference.height) return;
    throw input_error(
        image.place,
        fmt::format("has {} x {} pixels, expected {} x {} as the reference {}", image.width,
                    image.height, reference.width, reference.height, quote(reference.place)));
}

}  // namespace weft
