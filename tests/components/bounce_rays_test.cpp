// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/testing/path_fixture.h"

// Indirect light by a path through each pixel, of open scenes: against path tracing, and when it is
// chosen.
namespace weft::bounce_rays_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr std::uint32_t edge = 24;

/// A block on a floor below a bright sky and a sun.
Scene open_scene() {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}),
                builder.material({0.6F, 0.5F, 0.4F}));
    Mesh ball = test::icosphere(2, false);
    builder.add(std::move(ball), builder.material({0.8F, 0.2F, 0.2F}),
                test::placement(1.0, {0.0, 1.0, 0.0}));
    builder.scene.environment = Environment{glm::vec3(0.5F)};
    builder.light(LightType::directional, {}, glm::vec3(2.0F), {0.4, -1.0, -0.3});
    return std::move(builder.scene);
}

/// A closed room with a lamp.
Scene closed_scene() {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.6F, 0.5F, 0.4F}));
    builder.add(test::quad_mesh({-0.3F, 0.98F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material({0.3F, 0.3F, 0.3F}, {12.0F, 10.0F, 8.0F}));
    return std::move(builder.scene);
}

Camera open_camera() {
    return test::look_at({0.0, 2.0, 5.0}, {0.0, 0.6, 0.0}, 0.8);
}

RenderSettings automatic(Algorithm algorithm = Algorithm::ais) {
    RenderSettings settings = test::small_settings(algorithm, edge, edge);
    settings.sampling.bounce_rays_if_open = true;
    return settings;
}

FramePlan plan_of(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    validate_scene(scene);
    const FlatScene flat = flatten(scene);
    Renderer renderer(test::shared_executor(TestBackend::own_bvh), flat, camera, settings);
    return renderer.plan();
}

TEST(BounceRays, AreChosenWhereFewLightPathsLand) {
    const FramePlan open = plan_of(open_scene(), open_camera(), automatic());
    EXPECT_TRUE(open.bounce_rays);
    EXPECT_FALSE(open.has_vpls());
    ASSERT_TRUE(open.landed);
    EXPECT_GT(*open.landed, 0.0);
    EXPECT_LT(*open.landed, least_landed);
    const Camera inside = test::look_at({0.0, 0.0, 0.9}, {0.0, 0.0, -1.0}, 1.2);
    const FramePlan closed = plan_of(closed_scene(), inside, automatic());
    EXPECT_FALSE(closed.bounce_rays);
    EXPECT_TRUE(closed.has_vpls());
    EXPECT_EQ(closed.landed, 1.0);
}

TEST(BounceRays, AreNotChosenAgainstTheSettings) {
    RenderSettings vpls = automatic();
    vpls.sampling.bounce_rays_if_open = false;
    EXPECT_TRUE(plan_of(open_scene(), open_camera(), vpls).has_vpls());
    EXPECT_TRUE(plan_of(open_scene(), open_camera(), automatic(Algorithm::igi)).has_vpls());
    RenderSettings records = automatic();
    records.sampling.cached = true;
    EXPECT_TRUE(plan_of(open_scene(), open_camera(), records).has_vpls());
    RenderSettings dark = automatic();
    dark.indirect = false;
    const FramePlan direct = plan_of(open_scene(), open_camera(), dark);
    EXPECT_FALSE(direct.bounce_rays);
    EXPECT_FALSE(direct.has_vpls());
    RenderSettings rays = automatic();
    rays.sampling.bounce_rays = true;
    const Camera inside = test::look_at({0.0, 0.0, 0.9}, {0.0, 0.0, -1.0}, 1.2);
    EXPECT_TRUE(plan_of(closed_scene(), inside, rays).bounce_rays);
}

TEST(BounceRays, LaunchNothingOfVirtualLights) {
    const Rendering rendering =
        test::render(TestBackend::own_bvh, open_scene(), open_camera(), automatic());
    for (const StageStats& stage : rendering.stats.at(0).stages) {
        EXPECT_NE(stage.stage, Stage::vpl_walk);
        EXPECT_NE(stage.stage, Stage::vpl_gather);
    }
}

/// Mean over the image of a layer's green.
double mean_of(const Rendering& rendering, const char* layer) {
    const std::vector<double> values = test::channel_of(rendering, layer, 1);
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

TEST(BounceRays, BringTheIndirectLightOfPathTracing) {
    // 16 images of 64 samples against a reference of 16,384 samples, whose own error is a tenth of
    // theirs: Student's t with 15 degrees of freedom exceeds 5 once in 6,000, and the seeds are
    // fixed. Filtering moves light over the edges of the ball: another 1 %.
    for (const TestBackend backend : test::light_backends())
        for (const bool open : {true, false}) {
            const Scene scene = open ? open_scene() : closed_scene();
            const Camera camera =
                open ? open_camera() : test::look_at({0.0, 0.0, 0.9}, {0.0, 0.0, -1.0}, 1.2);
            std::vector<double> means;
            for (std::uint32_t seed = 0; seed < 16; ++seed) {
                RenderSettings settings = automatic();
                settings.sampling.bounce_rays = true;
                settings.samples = 64;
                settings.seed = seed;
                means.push_back(
                    mean_of(test::render(backend, scene, camera, settings, 64), "indirect"));
            }
            const auto [mean, error] = test::estimate(means);
            PathSettings reference = test::path_settings(edge, edge, 16384, 99);
            const double expected =
                mean_of(test::path_image(backend, scene, camera, reference), "indirect");
            EXPECT_LT(error, 0.01 * expected);
            EXPECT_NEAR(mean, expected, 5.0 * error + 0.01 * expected)
                << test::backend_name(backend) << " " << open;
        }
}

}  // namespace
}  // namespace weft::bounce_rays_test
