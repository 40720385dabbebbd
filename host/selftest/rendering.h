// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_RENDERING_H
#define WEFT_SELFTEST_RENDERING_H

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/renderer.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

// Renders small images of scenes whose light is known, and measures them.
namespace weft::selftest {

/// A finished rendering.
struct Rendering {
    Image image;
    std::vector<FrameStats> stats;
    FramePlan plan;

    /// Values of a layer, "" for beauty: planar.
    [[nodiscard]] const std::vector<float>& layer(std::string_view name) const;
    [[nodiscard]] float at(std::string_view name, std::uint32_t x, std::uint32_t y,
                           std::uint32_t channel = 0) const;
    /// Irradiance of a pixel by a light layer, without its albedo.
    [[nodiscard]] double irradiance(std::string_view name, std::uint32_t x, std::uint32_t y,
                                    std::uint32_t channel = 0) const;
};

/// Settings for a small image, in which direct light adapts however few lights there are.
[[nodiscard]] RenderSettings small_settings(Algorithm algorithm, std::uint32_t width,
                                            std::uint32_t height);

/// Settings whose bound on the geometry term has no effect, so that means are unbiased.
[[nodiscard]] RenderSettings unbounded(RenderSettings settings);

/// Renders a flattened scene.
[[nodiscard]] Rendering render_flat(Executor& executor, const FlatScene& flat, const Camera& camera,
                                    const RenderSettings& settings, std::uint32_t frames = 1);

/// Validates, flattens and renders a scene.
[[nodiscard]] Rendering render(Executor& executor, const Scene& scene, const Camera& camera,
                               const RenderSettings& settings, std::uint32_t frames = 1);

/// Mean of all values.
[[nodiscard]] double mean_of(const std::vector<float>& values);

/// Values of one channel of a layer over all pixels.
[[nodiscard]] std::vector<double> channel_of(const Rendering& rendering, std::string_view layer,
                                             std::uint32_t channel);

/// Sum of squared differences over sum of squares; 0 where both are all zero.
[[nodiscard]] double relative_mse(const std::vector<float>& reference,
                                  const std::vector<float>& test);

/// Number of values that differ in any bit, over all layers.
[[nodiscard]] std::size_t differing_values(const Image& a, const Image& b);

/// Number of values in all layers that are Inf, NaN or, except for normals, negative.
[[nodiscard]] std::size_t unclean_values(const Image& image);

/// Number of values that were guarded on their way to the film, over all frames and components.
[[nodiscard]] std::size_t guarded_values(const std::vector<FrameStats>& stats);

}  // namespace weft::selftest

#endif
