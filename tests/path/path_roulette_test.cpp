// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/path_fixture.h"

#define NATIVE_KERNELS "kernels/path/path.cl"
#include "tests/testing/native_kernels.h"

// What path tracing chooses at random must not move its mean: which paths end, which light is
// sampled, and whether light is found by sampling or by meeting it.
//
// Comparisons with known values allow what sidak_limit gives for 300 of them (about 5.1 standard
// errors), more than this file makes; seeds are fixed, and standard errors are bounded.
namespace weft::path_roulette_test {
namespace {

using test::at;
using test::polygon_irradiance;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 300;

native::PathVertex vertex_of(std::uint32_t bounce, float throughput) {
    native::PathVertex vertex{};
    vertex.bounce = bounce;
    vertex.throughput = native::f3(throughput, throughput, throughput);
    vertex.survival = 1.0F;
    vertex.surface.bsdf.albedo = native::f3(0.25F, 1.0F, 0.5F);
    return vertex;
}

/// What the vertex scatters of the path's light.
native::float3 scattered(const native::PathVertex& vertex) {
    return native::scattered_throughput(&vertex, vertex.surface.bsdf.albedo);
}

TEST(PathRoulette, FirstBouncesAlwaysSurvive) {
    native::Random random = native::make_random(1, 2, 3);
    for (std::uint32_t bounce = 1; bounce < ROULETTE_START; ++bounce)
        for (int i = 0; i < 1000; ++i) {
            native::PathVertex vertex = vertex_of(bounce, 1e-3F);
            ASSERT_EQ(native::survives(&vertex, ROULETTE_START, ROULETTE_LEVEL, &random), 1);
            ASSERT_EQ(scattered(vertex).y, 1e-3F);
        }
}

TEST(PathRoulette, SurvivorsCarryTheWeightOfThoseThatEnd) {
    // The number of survivors is binomial: the mean weight 1 has the variance (1 - q) / (q n).
    constexpr int n = 200'000;
    for (const float throughput :
         {1e-6F, 0.01F, 0.05F, 0.2F, 0.5F, 0.9F, 0.95F, 0.99F, 1.0F, 10.0F})
        for (const auto& [bounce, level] :
             {std::pair{ROULETTE_START, 1.0F}, std::pair{ROULETTE_START, ROULETTE_LEVEL},
              std::pair{ROULETTE_START + 1U, 0.01F}, std::pair{50U, ROULETTE_LEVEL}}) {
            SCOPED_TRACE("throughput " + std::to_string(throughput) + " level " +
                         std::to_string(level));
            native::Random random = native::make_random(5, bounce, 7);
            int survivors = 0;
            double weight = 0.0;
            for (int i = 0; i < n; ++i) {
                native::PathVertex vertex = vertex_of(bounce, throughput);
                if (native::survives(&vertex, ROULETTE_START, level, &random) == 0) continue;
                ++survivors;
                const auto after = static_cast<double>(scattered(vertex).y);
                ASSERT_TRUE(survivors == 1 || after / static_cast<double>(throughput) == weight);
                weight = after / static_cast<double>(throughput);
                ASSERT_NEAR(static_cast<double>(scattered(vertex).x), 0.25 * after, 1e-6 * after);
                ASSERT_NEAR(static_cast<double>(scattered(vertex).z), 0.5 * after, 1e-6 * after);
            }
            ASSERT_GT(survivors, 0);
            const double q = 1.0 / weight;
            EXPECT_NEAR(q,
                        std::clamp(static_cast<double>(throughput) / static_cast<double>(level),
                                   double{ROULETTE_LEAST}, double{ROULETTE_MOST}),
                        1e-6);
            EXPECT_NEAR(survivors * weight / n, 1.0,
                        test::sidak_limit(comparisons) * std::sqrt((1.0 - q) / (q * n)));
        }
}

/// A closed sphere of which all emits: e / (1 - rho), and rho^2 e / (1 - rho) of it indirectly.
void expect_furnace(const glm::vec3& albedo, std::uint32_t samples, double largest_error) {
    const glm::vec3 emission(1.0F, 2.0F, 0.5F);
    SceneBuilder builder;
    builder.add(test::icosphere(2, true), builder.material(albedo, emission));
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(
            backend, builder.scene, test::look_at({0.1, 0.2, 0.3}, {-0.5, 0.1, -0.4}, 1.2),
            test::path_settings(24, 24, samples, 9));
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double rho = at(albedo, c);
            const test::Tolerance tolerance{comparisons, largest_error, 1e-5};
            const std::string name =
                std::string(test::backend_name(backend)) + " albedo " + std::to_string(rho);
            test::expect_estimate(test::beauty_of(rendering, c), at(emission, c) / (1.0 - rho),
                                  tolerance, name);
            test::expect_estimate(test::layer_of(rendering, "indirect", c),
                                  rho * rho * at(emission, c) / (1.0 - rho), tolerance,
                                  name + " indirect");
        }
    }
}

TEST(PathRoulette, LongPathsKeepTheirLight) {
    expect_furnace({0.9F, 0.8F, 0.7F}, 64, 0.01);
    // Channels whose throughput lies far below the one that decides.
    expect_furnace({0.95F, 0.5F, 0.05F}, 64, 0.01);
}

TEST(PathRoulette, DarkSurfacesKeepTheirLight) {
    // From the third bounce on throughputs of 0.008 and less survive with the least probability,
    // and bring a fifth of the indirect light in the first channel.
    expect_furnace({0.2F, 0.1F, 0.02F}, 128, 0.01);
}

/// A floor point under two area lights of different kinds, by how its lights are chosen.
class PathRouletteChoice : public testing::Test {
  protected:
    PathRouletteChoice() {
        builder_.add(test::quad_mesh({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}),
                     builder_.material(glm::vec3(0.6F)));
        const Mesh area_lights[] = {
            test::quad_mesh({-1.1F, -0.5F, 0.8F}, {0, 1, 0}, {1, 0, 0}),
            test::quad_mesh({0.2F, -0.4F, 0.5F}, {0, 1, 0}, {0.8F, 0, 0.5F})};
        for (int i = 0; i < 2; ++i) {
            const float radiance = i == 0 ? 1.0F : 3.0F;
            builder_.add(area_lights[i], builder_.material(glm::vec3(0.0F), glm::vec3(radiance)));
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(area_lights[i].positions.at(k));
            };
            expected_ += static_cast<double>(radiance) *
                         polygon_irradiance({corner(0), corner(1), corner(3), corner(2)}, {0, 0, 0},
                                            {0, 0, 1});
        }
        validate_scene(builder_.scene);
        flat_ = flatten(builder_.scene);
    }

    void expect_the_same(const std::string& name) const {
        PathSettings settings = test::path_settings(16, 16, 512, 11);
        settings.indirect = false;
        for (const TestBackend backend : test::light_backends())
            test::expect_estimate(
                test::layer_of(
                    test::path_image(test::shared_executor(backend), flat_,
                                     test::look_at({0.02, -0.05, 0.1}, {0, 0, 0}, 0.001), settings),
                    "direct", 0),
                0.6 / pi * expected_, {comparisons, 0.01, 1e-5},
                std::string(test::backend_name(backend)) + " " + name);
    }

    SceneBuilder builder_;
    FlatScene flat_;
    double expected_ = 0.0;
};

TEST_F(PathRouletteChoice, AnyProbabilitiesGiveTheSameLight) {
    ASSERT_EQ(flat_.lights.size(), 2U);
    for (const float first : {0.0F, 0.05F, 0.5F, 0.95F, 1.0F}) {
        flat_.light_nodes[flat_.lights[0].node].intensity = first;
        flat_.light_nodes[flat_.lights[1].node].intensity = 1.0F - first;
        expect_the_same("probability " + std::to_string(first));
    }
    // A light that is never chosen is only ever met by scattered rays.
    flat_.light_nodes[flat_.lights[0].node].shape = LIGHT_SPOT;
    flat_.light_nodes[flat_.lights[0].node].axis.w = 2.0F;
    expect_the_same("never chosen");
}

TEST_F(PathRouletteChoice, LightsThatAreInNoTableAreMet) {
    // One of them, and all.
    flat_.instances[1].light = INVALID_INDEX;
    flat_.instances[2].light = 0;
    flat_.lights.erase(flat_.lights.begin());
    flat_.lights[0].choice_probability = 1.0F;
    flat_.lights[0].choice_cumulative = 1.0F;
    flat_.area_lights = 1;
    flat_.features &= ~static_cast<std::uint32_t>(FEATURE_LIGHT_TREE);
    flat_.light_nodes.clear();
    expect_the_same("one light in the table");
    flat_.instances[2].light = INVALID_INDEX;
    flat_.lights.clear();
    flat_.area_lights = 0;
    expect_the_same("none in the table");
}

TEST(PathRoulette, AgreesWithInstantRadiosity) {
    // Another estimator of the same light: virtual point lights without a bound on a wall of a dark
    // room, whose orders above the eighth are 0.3^9 = 2e-5 of the light. Both give a mean over the
    // image; virtual lights that of 64 seeds, whose t distribution is close to normal.
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.3F, 0.25F, 0.2F}));
    builder.add(test::quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.6F}),
                builder.material(glm::vec3(0.0F), {5.0F, 6.0F, 7.0F}));
    builder.add(test::icosphere(2, false), builder.material({0.3F, 0.2F, 0.1F}),
                test::placement(0.2, {-0.3, 0.2, -0.3}));
    validate_scene(builder.scene);
    const FlatScene flat = flatten(builder.scene);
    const Camera camera = test::look_at({0.2, 0.1, 0.3}, {0.1, -1.0, 0.2}, 0.5);
    std::vector<std::vector<double>> virtual_lights(3);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    for (std::uint32_t seed = 0; seed < 64; ++seed) {
        RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, 8, 8));
        settings.samples = 16;
        settings.seed = seed;
        settings.sampling.bounces = 8;
        const Rendering rendering = test::render_flat(executor, flat, camera, settings, 2);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::vector<double> values = test::channel_of(rendering, "indirect", c);
            double mean = 0.0;
            for (const double value : values) mean += value / 64.0;
            virtual_lights[c].push_back(mean);
        }
    }
    PathSettings settings = test::path_settings(8, 8, 8192, 13);
    settings.direct = false;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering paths =
            test::path_image(test::shared_executor(backend), flat, camera, settings);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const test::Estimate a = test::estimate(virtual_lights[c]);
            const test::Estimate b = test::beauty_of(paths, c);
            test::expect_estimate({b.mean, std::hypot(a.error, b.error)}, a.mean,
                                  {comparisons, 0.01, 1e-4}, "instant radiosity");
        }
    }
}

}  // namespace
}  // namespace weft::path_roulette_test
