// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/correct_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "film/for_each_pixel.h"

namespace weft {
namespace {

Plane difference(const Plane& a, const Plane& b) {
    Plane result{a.width, a.height, std::vector<float>(a.values.size())};
    for_each_pixel(a.values.size(),
                   [&](std::size_t i) { result.values[i] = a.values[i] - b.values[i]; });
    return result;
}

/// Details of one size in all channels, of each half.
struct Details {
    ColourPlanes first, second;
};

/// How many independent products a neighbourhood's mean is of, about: one over the sum of the
/// squares of its weights, halved, since details next to each other hang together.
constexpr float independent_products = 31.0F;

/// What is known of the details: adds it to `image`, weighed over neighbourhoods that are a few
/// times as wide as they are.
void add_known(const Details& details, std::uint32_t scale, float first_share,
               float standard_errors, ColourPlanes& image) {
    const Plane& any = details.first[0];
    Plane signal{any.width, any.height, std::vector<float>(any.values.size())};
    Plane power = signal;
    Plane spread = signal;
    const float second_share = 1.0F - first_share;
    for_each_pixel(any.values.size(), [&](std::size_t i) {
        float apart = 0.0F;
        float squares = 0.0F;
        for (std::size_t c = 0; c < 3; ++c) {
            const float first = details.first[c].values[i];
            const float second = details.second[c].values[i];
            const float mean = first_share * first + second_share * second;
            signal.values[i] += first * second;
            power.values[i] += mean * mean;
            apart += (first - second) * (first - second);
            squares += first * first + second * second;
        }
        // Of Gaussian noise alone this is the variance of the product; without noise it is 0.
        if (standard_errors > 0.0F) spread.values[i] = apart * squares / 8.0F;
    });
    for (const std::uint32_t wider : {0U, 1U}) {
        signal = smoothed(signal, 1U << (scale + wider));
        power = smoothed(power, 1U << (scale + wider));
        if (standard_errors > 0.0F) spread = smoothed(spread, 1U << (scale + wider));
    }
    for_each_pixel(any.values.size(), [&](std::size_t i) {
        float known = signal.values[i];
        if (standard_errors > 0.0F)
            known -= standard_errors * std::sqrt(spread.values[i] / independent_products);
        if (!(known > 0.0F)) return;
        const float share = std::min(1.0F, known / power.values[i]);
        for (std::size_t c = 0; c < 3; ++c)
            image[c].values[i] += share * (first_share * details.first[c].values[i] +
                                           second_share * details.second[c].values[i]);
    });
}

ColourPlanes planes_of(const Image& image, const Layer& layer) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    ColourPlanes planes;
    for (std::size_t c = 0; c < planes.size(); ++c) {
        const auto begin = layer.values.begin() + static_cast<std::ptrdiff_t>(c * pixels);
        planes[c] = {image.width, image.height,
                     std::vector<float>(begin, begin + static_cast<std::ptrdiff_t>(pixels))};
    }
    return planes;
}

Layer* layer_of(Image& image, std::string_view name) {
    const auto found = std::find_if(image.layers.begin(), image.layers.end(),
                                    [&](const Layer& layer) { return layer.name == name; });
    return found == image.layers.end() ? nullptr : &*found;
}

/// A layer that all three images have.
struct CommonLayer {
    Layer* preview;
    const Layer *first, *second;
};

std::optional<CommonLayer> common_layer(Image& preview, const ExactMeans& exact,
                                        std::string_view name) {
    const CommonLayer layer{layer_of(preview, name), exact.first.find(name),
                            exact.second.find(name)};
    if (layer.preview == nullptr || layer.first == nullptr || layer.second == nullptr) return {};
    return layer;
}

/// Gives a value of a layer, and adds what that changes to `beauty`, if given.
void change(Layer& layer, Layer* beauty, std::size_t i, float changed) {
    changed = std::max(0.0F, changed);
    if (beauty != nullptr) beauty->values[i] += changed - layer.values[i];
    layer.values[i] = changed;
}

/// Corrects a layer of light, if all images have it; `standard_errors` as of `corrected`.
void correct_layer(Image& preview, const ExactMeans& exact, std::string_view name, Layer* beauty,
                   float standard_errors = 0.0F) {
    const auto layer = common_layer(preview, exact, name);
    if (!layer) return;
    const ColourPlanes result =
        corrected(planes_of(preview, *layer->preview),
                  {planes_of(exact.first, *layer->first), planes_of(exact.second, *layer->second),
                   static_cast<float>(exact.first_share)},
                  standard_errors);
    const std::size_t pixels = std::size_t{preview.width} * preview.height;
    for (std::size_t c = 0; c < result.size(); ++c)
        for_each_pixel(pixels, [&](std::size_t i) {
            change(*layer->preview, beauty, c * pixels + i, result[c].values[i]);
        });
}

/// Makes a layer the mean of all samples, if all images have it.
void average_layer(Image& preview, const ExactMeans& exact, std::string_view name, Layer* beauty) {
    const auto layer = common_layer(preview, exact, name);
    if (!layer) return;
    const auto of_first = static_cast<float>(exact.share * exact.first_share);
    const auto of_second = static_cast<float>(exact.share * (1.0 - exact.first_share));
    const auto of_preview = static_cast<float>(1.0 - exact.share);
    for_each_pixel(layer->preview->values.size(), [&](std::size_t i) {
        change(*layer->preview, beauty, i,
               of_preview * layer->preview->values[i] + of_first * layer->first->values[i] +
                   of_second * layer->second->values[i]);
    });
}

/// Whether a preview has light of mirrors, gloss or glass.
bool shows_mirrors(const Image& preview) {
    constexpr std::array layers{"reflection", "refraction", "glossy"};
    return std::any_of(layers.begin(), layers.end(),
                       [&](const char* layer) { return preview.find(layer) != nullptr; });
}

}  // namespace

ColourPlanes corrected(const ColourPlanes& preview, const ExactHalves& exact,
                       float standard_errors) {
    ColourPlanes image = preview;
    Details rest;
    for (std::size_t c = 0; c < 3; ++c) {
        rest.first[c] = difference(exact.first[c], preview[c]);
        rest.second[c] = difference(exact.second[c], preview[c]);
    }
    const std::uint32_t scales = starlet_scales(preview[0].width, preview[0].height);
    for (std::uint32_t scale = 0; scale < scales; ++scale) {
        Details details;
        for (std::size_t c = 0; c < 3; ++c) {
            details.first[c] = take_detail(rest.first[c], scale);
            details.second[c] = take_detail(rest.second[c], scale);
        }
        add_known(details, scale, exact.first_share, standard_errors, image);
    }
    add_known(rest, scales, exact.first_share, standard_errors, image);
    return image;
}

void correct_preview(Image& preview, const ExactMeans& exact) {
    average_layer(preview, exact, alpha_layer_name, nullptr);
    // Paths count light of mirrors and media as direct, indirect or emitted light. By way of
    // mirrors few of them bring much: a pixel's noise is no longer a small share of its
    // neighbourhood's.
    const bool mirrors = shows_mirrors(preview);
    if (mirrors || preview.find("media") != nullptr) {
        correct_layer(preview, exact, "", nullptr, mirrors ? 1.0F : 0.0F);
        return;
    }
    Layer* const beauty = layer_of(preview, "");
    correct_layer(preview, exact, "direct", beauty);
    correct_layer(preview, exact, "indirect", beauty);
    average_layer(preview, exact, "emission", beauty);
    if (beauty == nullptr) return;
    for_each_pixel(beauty->values.size(),
                   [&](std::size_t i) { beauty->values[i] = std::max(0.0F, beauty->values[i]); });
}

}  // namespace weft
