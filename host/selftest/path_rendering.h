// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_PATH_RENDERING_H
#define WEFT_SELFTEST_PATH_RENDERING_H

#include <cstdint>
#include <string_view>

#include "render/path_renderer.h"
#include "selftest/rendering.h"
#include "selftest/statistics.h"

namespace weft::selftest {

/// Settings of a path-traced image of samples [0, `samples`).
[[nodiscard]] PathSettings path_settings(std::uint32_t width, std::uint32_t height,
                                         std::uint32_t samples, std::uint32_t seed = 0);

/// A path-traced image with the variance of its pixels.
[[nodiscard]] Rendering trace_flat(Executor& executor, const FlatScene& flat, const Camera& camera,
                                   const PathSettings& settings);

/// Validates, flattens and path traces a scene.
[[nodiscard]] Rendering trace_paths(Executor& executor, const Scene& scene, const Camera& camera,
                                    const PathSettings& settings);

/// Mean of the image's pixels and its standard error from the variance of each pixel, as the
/// renderer estimates it.
[[nodiscard]] Estimate beauty_of(const Rendering& rendering, std::uint32_t channel);

/// Mean of a layer whose pixels all have the same expectation, and its standard error from their
/// scatter: for layers without a variance of their own.
[[nodiscard]] Estimate layer_of(const Rendering& rendering, std::string_view layer,
                                std::uint32_t channel);

}  // namespace weft::selftest

#endif
