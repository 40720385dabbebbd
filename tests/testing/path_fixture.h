// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_PATH_FIXTURE_H
#define WEFT_TESTS_TESTING_PATH_FIXTURE_H

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/path_renderer.h"
#include "selftest/path_rendering.h"
#include "selftest/statistics.h"
#include "tests/testing/closed_forms.h"
#include "tests/testing/render_fixture.h"

namespace weft::test {

/// A channel of a colour, in double precision.
inline double at(const glm::vec3& colour, std::uint32_t channel) {
    return static_cast<double>(colour[static_cast<glm::length_t>(channel)]);
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

/// A path-traced image with the variance of its pixels.
inline Rendering path_image(Executor& executor, const FlatScene& flat, const Camera& camera,
                            const PathSettings& settings) {
    Rendering rendering{resolve_sums(path_sums(executor, flat, camera, settings)), {}, {}};
    expect_clean(rendering);
    return rendering;
}

/// Validates, flattens and renders.
inline Rendering path_image(TestBackend backend, const Scene& scene, const Camera& camera,
                            const PathSettings& settings) {
    validate_scene(scene);
    return path_image(shared_executor(backend), flatten(scene), camera, settings);
}

/// That two sums are of the same samples of the same image, to the bit.
inline void expect_same_sums(const FilmSums& a, const FilmSums& b) {
    EXPECT_TRUE(a.words == b.words);
    EXPECT_EQ(a.ranges, b.ranges);
    EXPECT_EQ(a.identity, b.identity);
    EXPECT_EQ(a.light_exponent, b.light_exponent);
    EXPECT_EQ(differing_values(resolve_sums(a), resolve_sums(b)), 0U);
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

/// That a channel of an image of a shining wall behind a medium is as expected: where the medium
/// scatters, by the mean of the layer "emission"; where it only absorbs, in every pixel to within
/// `rounding`, relative.
inline void expect_shine(const Rendering& rendering, std::uint32_t channel, double expected,
                         bool scatters, const Tolerance& tolerance, double rounding,
                         const std::string& what) {
    if (scatters) {
        expect_estimate(layer_of(rendering, "emission", channel), expected, tolerance, what);
        return;
    }
    for (const double value : channel_of(rendering, "", channel))
        ASSERT_NEAR(value, expected, rounding * expected) << what;
}

}  // namespace weft::test

#endif
