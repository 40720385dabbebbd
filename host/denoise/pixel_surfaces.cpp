// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/pixel_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "denoise/layer_values.h"
#include "denoise/padded_rows.h"

namespace weft {
namespace {

// Those of the discontinuity buffer: least cosine between normals, and largest distance from the
// plane of another pixel, in pixels.
constexpr float least_cosine = 0.9F;
constexpr float reach_in_pixels = 2.0F;
// Largest difference of albedo that light is shared over where media hide what it does.
constexpr float most_albedo = 0.1F;

/// The change of a value from pixel to pixel, by those before and after it. At an edge of a surface
/// one of the two differences is that to another surface: the smaller one counts then.
float slope_of(float before, float after) {
    const float small = std::min(std::abs(before), std::abs(after));
    const float large = std::max(std::abs(before), std::abs(after));
    if (before * after > 0.0F && large < 2.0F * small) return 0.5F * (before + after);
    return std::abs(before) < std::abs(after) ? before : after;
}

/// Sets those weights of a strip to 0 whose albedos differ.
void keep_near(const float* a, const float* b, float* __restrict weights) {
    for (std::size_t k = 0; k < Padding::strip; ++k) {
        const float weight = weights[k];
        weights[k] = std::abs(a[k] - b[k]) <= most_albedo ? weight : 0.0F;
    }
}

}  // namespace

PixelSurfaces::PixelSurfaces(const Image& image, const DenoiseView& view, const Padding& padding)
    : padding_(padding), media_(view.media) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const std::span<const float> depth = layer_values(image, "depth", 1);
    const std::span<const float> normal = layer_values(image, "normal", 3);
    const std::span<const float> albedo = layer_values(image, "albedo", 3);
    for (PaddedPlane* const plane : {&nearness_, &has_normal_, &slope_x_, &slope_y_, &reach_})
        plane->resize(padding.size());
    for (PaddedPlane& plane : normal_) plane.resize(padding.size());
    for (PaddedPlane& plane : albedo_) plane.resize(media_ ? padding.size() : 0);
    for_each_padded(padding, [&](std::size_t pixel, std::size_t i, std::size_t, std::size_t) {
        const float z = depth[pixel];
        nearness_[i] = view.orthographic ? z : z > 0.0F ? 1.0F / z : 0.0F;
        double length = 0.0;
        for (std::size_t at = pixel; at < 3 * pixels; at += pixels)
            length += double{normal[at]} * normal[at];
        length = std::sqrt(length);
        has_normal_[i] = length > 0.0 ? 1.0F : 0.0F;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * pixels + pixel;
            normal_[c][i] = length > 0.0 ? static_cast<float>(normal[at] / length) : 0.0F;
            if (media_) albedo_[c][i] = albedo[at];
        }
    });
    find_slopes(view);
}

void PixelSurfaces::find_slopes(const DenoiseView& view) {
    const auto pixel = static_cast<float>(view.pixel);
    const auto slope = [&](std::size_t i, std::size_t at, std::size_t size, int dx, int dy) {
        constexpr float none = std::numeric_limits<float>::max();
        if (size < 2) return 0.0F;
        const float here = nearness_[i];
        return slope_of(at > 0 ? here - nearness_[padding_.beside(i, -dx, -dy)] : none,
                        at + 1 < size ? nearness_[padding_.beside(i, dx, dy)] - here : none);
    };
    for_each_padded(padding_, [&](std::size_t, std::size_t i, std::size_t x, std::size_t y) {
        slope_x_[i] = slope(i, x, padding_.width(), 1, 0);
        slope_y_[i] = slope(i, y, padding_.height(), 0, 1);
        // What a pixel's width of distance changes, where the surface faces the camera.
        const float facing = view.orthographic ? pixel : pixel * nearness_[i];
        const float sloped = std::abs(slope_x_[i]) + std::abs(slope_y_[i]);
        reach_[i] = reach_in_pixels * std::max(facing, sloped);
    });
}

void PixelSurfaces::keep_same(std::size_t i, int dx, int dy, float* __restrict weights) const {
    const std::size_t j = padding_.beside(i, dx, dy);
    const float* const near_i = &nearness_[i];
    const float* const near_j = &nearness_[j];
    const float* const slope_x = &slope_x_[i];
    const float* const slope_y = &slope_y_[i];
    const float* const reach = &reach_[i];
    const auto right = static_cast<float>(dx);
    const auto down = static_cast<float>(dy);
    for (std::size_t k = 0; k < Padding::strip; ++k) {
        const float weight = weights[k];
        const float off = near_j[k] - (near_i[k] + right * slope_x[k] + down * slope_y[k]);
        weights[k] = std::abs(off) <= reach[k] ? weight : 0.0F;
    }
    keep_parallel(i, j, weights);
    for (const PaddedPlane& albedo : albedo_)
        if (media_) keep_near(&albedo[i], &albedo[j], weights);
}

void PixelSurfaces::keep_parallel(std::size_t i, std::size_t j, float* __restrict weights) const {
    const float* const a[] = {&normal_[0][i], &normal_[1][i], &normal_[2][i], &has_normal_[i]};
    const float* const b[] = {&normal_[0][j], &normal_[1][j], &normal_[2][j], &has_normal_[j]};
    for (std::size_t k = 0; k < Padding::strip; ++k) {
        const float weight = weights[k];
        const float cosine = a[0][k] * b[0][k] + a[1][k] * b[1][k] + a[2][k] * b[2][k];
        weights[k] = cosine >= least_cosine * a[3][k] * b[3][k] ? weight : 0.0F;
    }
}

}  // namespace weft
