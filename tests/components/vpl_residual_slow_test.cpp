// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/testing/path_fixture.h"

namespace weft::vpl_residual_slow_test {
namespace {

using test::Estimate;

constexpr std::uint32_t edge = 8;

/// Mean indirect light of the images of many seeds; `image(seed)` renders one.
template <typename Image>
Estimate indirect_light(std::uint32_t first, std::uint32_t count, const Image& image) {
    std::vector<double> values;
    for (std::uint32_t seed = first; seed < first + count; ++seed) {
        const test::Rendering rendering = image(seed);
        test::expect_clean(rendering);
        values.push_back(test::mean_of(rendering.layer("indirect")));
    }
    return test::estimate(values);
}

constexpr std::size_t comparisons = 4;

// A spot light shines into the edge of a room of size 2, and the image is of the two strips
// beside that edge, `width` wide each: VPLs lie as close as that to the receivers. Of at least a
// thousand seeds each; a correct renderer fails with a probability of 1e-4.
void expect_path_traced_mean(double width, double bias) {
    test::SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.6F)));
    const double away = 0.05 / std::sqrt(2.0);
    PunctualLight& spot = builder.light(LightType::spot, {-1.0 + away, -1.0 + away, 0.0},
                                        glm::vec3(1.0F), {-1.0, -1.0, 0.0});
    spot.cos_inner = std::cos(0.02F);
    spot.cos_outer = std::cos(0.04F);
    const FlatScene flat = flatten(builder.scene);
    // At a distance of sqrt 2, the image spans sqrt 2 of `width`, and shows both strips at 45
    // degrees.
    const Camera camera = test::look_at({0.0, 0.0, 0.0}, {-1.0, -1.0, 0.0}, width);
    Executor& executor = test::shared_executor(test::TestBackend::own_bvh);
    PathSettings path = test::path_settings(edge, edge, 32);
    path.through_centres = true;
    const Estimate traced = indirect_light(100000, 1024, [&](std::uint32_t seed) {
        path.seed = seed;
        return test::path_image(executor, flat, camera, path);
    });
    // The bound as it is, which leaves nearly everything to the residual, and one that leaves it
    // about half.
    for (const double spacing : {2.0, 20.0 * width}) {
        const std::string what = "strips of " + testing::PrintToString(width) + ", spacing " +
                                 testing::PrintToString(spacing);
        RenderSettings settings = test::small_settings(Algorithm::ir, edge, edge);
        settings.sampling.bound_spacing = spacing;
        settings.sampling.local_bounds = false;
        settings.sampling.vpl_tail = false;
        const auto render = [&](std::uint32_t seed) {
            settings.seed = seed;
            return test::render_flat(executor, flat, camera, settings);
        };
        const Estimate without = indirect_light(1, 64, render);
        EXPECT_LT(without.mean, 0.7 * traced.mean) << what;
        settings.sampling.compensation = true;
        const Estimate with = indirect_light(1, 4096, render);
        test::expect_estimate({with.mean, std::hypot(with.error, traced.error)}, traced.mean,
                              {comparisons, 0.006, bias}, what);
    }
}

// VPLs are moved off their surfaces by 1.4e-6 here, which is up to 6 % of a receiver's distance.
TEST(VplResidualSlow, AtTheDistanceOfRoundingFromAWallItNearlyEqualsPathTracing) {
    expect_path_traced_mean(2e-4, 0.01);
}

TEST(VplResidualSlow, CloseToAWallItEqualsPathTracing) {
    expect_path_traced_mean(2e-3, 1e-3);
}

}  // namespace
}  // namespace weft::vpl_residual_slow_test
