// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_PATH_FIXTURE_H
#define WEFT_TESTS_PATH_FIXTURE_H

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "closed_forms.h"
#include "frame/path_renderer.h"
#include "render_fixture.h"

namespace weft::test {

/// A channel of a colour, in double precision.
inline double at(const glm::vec3& colour, std::uint32_t channel) {
    return static_cast<double>(colour[static_cast<glm::length_t>(channel)]);
}

/// Settings of a path-traced picture of samples [0, `samples`).
inline PathSettings path_settings(std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                                  std::uint32_t seed = 0) {
    PathSettings settings;
    settings.width = width;
    settings.height = height;
    settings.samples = {0, samples};
    settings.seed = seed;
    return settings;
}

/// Renders all samples of `settings` and returns the sums, after those that `before` may hold.
inline FilmSums path_sums(Executor& executor, const FlatScene& flat, const Camera& camera,
                          const PathSettings& settings, FilmSums before = {}) {
    PathRenderer renderer(executor, flat, camera, settings, std::move(before));
    while (renderer.render_frame({})) continue;
    for (const FrameStats& frame : renderer.stats())
        for (std::size_t c = 0; c < frame.nonfinite.size(); ++c)
            EXPECT_EQ(frame.nonfinite[c].count, 0U) << "component " << c;
    return renderer.sums();
}

/// A path-traced picture with the variance of its pixels.
inline Rendering path_picture(Executor& executor, const FlatScene& flat, const Camera& camera,
                              const PathSettings& settings) {
    Rendering rendering{resolve_sums(path_sums(executor, flat, camera, settings)), {}, {}};
    expect_clean(rendering);
    return rendering;
}

/// Validates, flattens and renders.
inline Rendering path_picture(Backend backend, const Scene& scene, const Camera& camera,
                              const PathSettings& settings) {
    validate_scene(scene);
    return path_picture(shared_executor(backend), flatten(scene), camera, settings);
}

/// Values of one channel of a layer over all pixels.
inline std::vector<double> channel_of(const Rendering& rendering, std::string_view layer,
                                      std::uint32_t channel) {
    const std::size_t pixels = std::size_t{rendering.image.width} * rendering.image.height;
    const std::vector<float>& all = rendering.layer(layer);
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(channel * pixels);
    return {first, first + static_cast<std::ptrdiff_t>(pixels)};
}

/// Mean of the picture's pixels and its standard error from the variance of each pixel, as the
/// renderer estimates it.
inline Estimate beauty_of(const Rendering& rendering, std::uint32_t channel) {
    Estimate result;
    const std::vector<double> values = channel_of(rendering, "", channel);
    for (const double value : values) result.mean += value;
    for (const double variance : channel_of(rendering, "variance", channel))
        result.error += variance;
    const auto n = static_cast<double>(values.size());
    return {result.mean / n, std::sqrt(result.error) / n};
}

/// Mean of a layer whose pixels all have the same expectation, and its standard error from their
/// scatter: for layers without a variance of their own.
inline Estimate layer_of(const Rendering& rendering, std::string_view layer,
                         std::uint32_t channel) {
    return estimate(channel_of(rendering, layer, channel));
}

/// How many standard errors a normal variable may be off (either way), so that `comparisons`
/// independent ones of a correct renderer together fail with a probability of 1e-4 (Sidak 1967).
inline double sidak_limit(std::size_t comparisons, double failure = 1e-4) {
    const double each = -std::expm1(std::log1p(-failure) / static_cast<double>(comparisons));
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 100; ++i) {
        const double z = 0.5 * (low + high);
        (std::erfc(z / std::sqrt(2.0)) > each ? low : high) = z;
    }
    return high;
}

/// What a comparison allows.
struct Tolerance {
    std::size_t comparisons = 100;  ///< of the file: for sidak_limit
    double error = 0.01;  ///< largest standard error, relative: above it anything would pass
    double bias = 2e-6;   ///< what model and floats are off by, relative
};

/// That an estimate agrees with a closed form and is good enough to say so.
inline void expect_estimate(const Estimate& found, double expected, const Tolerance& tolerance,
                            const std::string& what) {
    EXPECT_LE(found.error, tolerance.error * expected) << what;
    EXPECT_NEAR(found.mean, expected,
                sidak_limit(tolerance.comparisons) * found.error + tolerance.bias * expected)
        << what << ", " << (found.mean - expected) / found.error << " standard errors of "
        << found.error;
}

}  // namespace weft::test

#endif
