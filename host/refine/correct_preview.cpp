// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/correct_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "film/for_each_pixel.h"
#include "refine/isolated_errors.h"
#include "refine/sample_noise.h"

namespace weft {
namespace {

Plane difference(const Plane& a, const Plane& b) {
    Plane result{a.width, a.height, std::vector<float>(a.values.size())};
    for_each_pixel(a.values.size(),
                   [&](std::size_t i) { result.values[i] = a.values[i] - b.values[i]; });
    return result;
}

/// The share that a pixel has itself in the mean over its neighbourhood on the finest scale: the
/// square of the middle of two splines after each other, the second of twice the width.
constexpr float own_share = 44.0F * 44.0F / (256.0F * 256.0F);
constexpr std::int64_t wider_step = 2;  // of the second

/// What both halves of a pixel agree on, as far as it may be chance: up to six standard errors of
/// two samples, and less of many, which are rarely all bright.
float chance_in_pixel(float agreed, float noise, std::uint64_t samples) {
    constexpr float most = 36.0F;
    return std::min(agreed, most * noise * std::sqrt(2.0F / static_cast<float>(samples)));
}

/// What is known of details: adds it to `image`, weighed over neighbourhoods that are a few times
/// as wide as they are. `variance`: of the noise of the pixels that have become each detail.
void add_known(const ExactHalves& details, const Plane& variance, std::uint32_t scale,
               const SurfaceRuns& runs, ColourPlanes& image) {
    Plane signal{variance.width, variance.height, std::vector<float>(variance.values.size())};
    Plane power = signal;
    Plane noise_squares = signal;
    std::vector<float> chances(scale == 0 ? signal.values.size() : 0);
    for_each_pixel(variance.values.size(), [&](std::size_t i) {
        const HalfProducts products = half_products(details, i);
        signal.values[i] = products.signal;
        power.values[i] = products.power;
        const float noise = variance.values[i] * noise_left(runs.rows[i], runs.columns[i], scale);
        noise_squares.values[i] = noise * noise;
        if (scale == 0) chances[i] = chance_in_pixel(products.signal, noise, details.samples);
    });
    const std::array planes{&signal, &power, &noise_squares};
    for (const std::uint32_t wider : {0U, 1U}) smooth(planes, 1U << (scale + wider), runs);
    for_each_pixel(variance.values.size(), [&](std::size_t i) {
        const float by_chance =
            std::sqrt(noise_squares.values[i]) *
            chance_agreement(runs.rows[i], runs.columns[i], scale, details.samples);
        float agreed = signal.values[i];
        // Two rare bright samples fall in one pixel now and then, one in each half. Such a pixel
        // cannot bear witness for itself: those around it have to.
        if (scale == 0 && is_smoothed(runs.rows[i], wider_step) &&
            is_smoothed(runs.columns[i], wider_step))
            agreed = std::min(agreed, (agreed - own_share * chances[i]) / (1.0F - own_share));
        const float known = agreed - by_chance;
        if (!(known > 0.0F)) return;
        const float share = std::min(1.0F, known / power.values[i]);
        for (std::size_t c = 0; c < 3; ++c) image[c].values[i] += share * details.mean(c, i);
    });
}

/// The planes of both halves.
std::array<Plane*, 6> all_planes(ExactHalves& halves) {
    return {halves.first.data(),  &halves.first[1],  &halves.first[2],
            halves.second.data(), &halves.second[1], &halves.second[2]};
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

/// Corrects a layer of light, if all images have it.
void correct_layer(Image& preview, const ExactMeans& exact, std::string_view name, Layer* beauty,
                   const SurfaceRuns& runs) {
    const auto layer = common_layer(preview, exact, name);
    if (!layer) return;
    const ColourPlanes result =
        corrected(planes_of(preview, *layer->preview),
                  {planes_of(exact.first, *layer->first), planes_of(exact.second, *layer->second),
                   static_cast<float>(exact.first_share), exact.samples},
                  runs);
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

/// Whether a preview has light of mirrors, gloss, glass or media, which paths count as direct,
/// indirect or emitted light.
bool shows_more_than_paths(const Image& preview) {
    constexpr std::array layers{"reflection", "refraction", "glossy", "media"};
    return std::any_of(layers.begin(), layers.end(),
                       [&](const char* layer) { return preview.find(layer) != nullptr; });
}

}  // namespace

ColourPlanes corrected(const ColourPlanes& preview, const ExactHalves& exact,
                       const SurfaceRuns& runs) {
    ColourPlanes image = preview;
    ExactHalves rest{{}, {}, exact.first_share, exact.samples};
    for (std::size_t c = 0; c < 3; ++c) {
        rest.first[c] = difference(exact.first[c], preview[c]);
        rest.second[c] = difference(exact.second[c], preview[c]);
    }
    Plane variance = sample_variance(rest);
    correct_isolated(rest, variance, runs, image);
    const std::uint32_t scales = starlet_scales(runs.width, runs.height);
    for (std::uint32_t scale = 0; scale < scales; ++scale) {
        std::vector<Plane> taken = take_details(all_planes(rest), scale, runs);
        ExactHalves details{{}, {}, exact.first_share, exact.samples};
        const auto planes = all_planes(details);
        for (std::size_t k = 0; k < planes.size(); ++k) *planes[k] = std::move(taken[k]);
        add_known(details, variance, scale, runs, image);
        const std::array noise{&variance};
        smooth(noise, 1U << scale, runs);
    }
    add_known(rest, variance, scales, runs, image);
    return image;
}

void correct_preview(Image& preview, const ExactMeans& exact) {
    const SurfaceRuns runs = find_surface_runs(preview);
    average_layer(preview, exact, alpha_layer_name, nullptr);
    if (shows_more_than_paths(preview)) {
        correct_layer(preview, exact, "", nullptr, runs);
        return;
    }
    Layer* const beauty = layer_of(preview, "");
    correct_layer(preview, exact, "direct", beauty, runs);
    correct_layer(preview, exact, "indirect", beauty, runs);
    average_layer(preview, exact, "emission", beauty);
    if (beauty == nullptr) return;
    for_each_pixel(beauty->values.size(),
                   [&](std::size_t i) { beauty->values[i] = std::max(0.0F, beauty->values[i]); });
}

}  // namespace weft
