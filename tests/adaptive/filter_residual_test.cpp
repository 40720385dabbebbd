// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "adaptive/level_overlay.h"
#include "tests/testing/counting_executor.h"
#include "tests/testing/divided_scene.h"
#include "tests/testing/path_fixture.h"

// The residual where ais undersamples: every pixel has a path of its own, so what it adds is what
// it adds to amax, speck by speck, and means are those of path tracing.
namespace weft::filter_residual_test {
namespace {

using test::Estimate;
using test::Rendering;
using test::TestBackend;

constexpr std::size_t comparisons = 40;  // a few more than there are

using ShippedScene = test::DividedScene;

const ShippedScene& cornell_box() {
    static const ShippedScene box("cornell-box.gltf");
    return box;
}

RenderSettings settings_of(Algorithm algorithm, bool compensation, double threshold = 12.0) {
    RenderSettings settings = test::small_settings(algorithm, 93, 61);
    settings.sampling.compensation = compensation;
    settings.sampling.threshold = threshold;
    // As with compensation, so that it is all that differs.
    settings.sampling.local_bounds = false;
    settings.sampling.vpl_tail = false;
    settings.sampling.bound_spacing = 2.0;  // the closer bound of lights leaves nothing to add
    settings.seed = 3;
    return settings;
}

Rendering render(TestBackend backend, const ShippedScene& scene, const RenderSettings& settings,
                 std::uint32_t frames = 1) {
    Rendering rendering = test::render_flat(test::shared_executor(backend), scene.flat,
                                            scene.camera, settings, frames);
    test::expect_clean(rendering);
    return rendering;
}

/// What compensation adds to a layer.
std::vector<double> added(const Rendering& with, const Rendering& without, const char* layer) {
    std::vector<double> values;
    for (std::size_t i = 0; i < with.layer(layer).size(); ++i)
        values.push_back(static_cast<double>(with.layer(layer)[i]) -
                         static_cast<double>(without.layer(layer)[i]));
    return values;
}

TEST(FilterResidual, WhatItAddsIsWhatItAddsToFullSampling) {
    for (const char* const file : {"cornell-box.gltf", "gallery.gltf"}) {
        const ShippedScene scene(file);
        for (const TestBackend backend : test::light_backends()) {
            const auto pair = [&](Algorithm algorithm) {
                return std::array{render(backend, scene, settings_of(algorithm, true)),
                                  render(backend, scene, settings_of(algorithm, false))};
            };
            const auto ais = pair(Algorithm::ais);
            const auto amax = pair(Algorithm::amax);
            EXPECT_GT(ais[0].stats[0].levels.back().tiles[0], 5U) << "no coarse tiles";
            for (const char* const layer : {"direct", "indirect"}) {
                SCOPED_TRACE(std::string(test::backend_name(backend)) + ' ' + file + ' ' + layer);
                const std::vector<double> found = added(ais[0], ais[1], layer);
                const std::vector<double> expected = added(amax[0], amax[1], layer);
                const auto& sums = amax[0].layer(layer);
                const double most =
                    static_cast<double>(*std::max_element(sums.begin(), sums.end()));
                // Sums of some floats, the largest of which is that.
                const double rounding =
                    16.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * most;
                double largest = 0.0;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    ASSERT_NEAR(found[i], expected[i], rounding) << "value " << i;
                    largest = std::max(largest, found[i]);
                }
                // So few rays meet the area light of the Cornell box that none here counts.
                const bool rare = layer == std::string("direct") && scene.flat.area_lights == 1;
                EXPECT_GT(largest, rare ? -1.0 : 1000.0 * rounding) << "nothing was added";
            }
        }
    }
}

TEST(FilterResidual, LevelsDoNotDependOnIt) {
    for (const double threshold : {2.0, 12.0}) {
        const auto levels = [&](bool compensation) {
            return render(TestBackend::own_bvh, cornell_box(),
                          settings_of(Algorithm::ais, compensation, threshold), 2)
                .stats.back()
                .levels;
        };
        const auto with = levels(true);
        const auto without = levels(false);
        ASSERT_EQ(with.size(), without.size());
        for (std::size_t i = 0; i < with.size(); ++i) {
            EXPECT_EQ(with[i].tiles, without[i].tiles);
            EXPECT_EQ(with[i].samples, without[i].samples);
        }
    }
}

TEST(FilterResidual, WithThresholdZeroTheImageIsThatOfAmax) {
    for (const TestBackend backend : test::light_backends())
        for (const bool near : {false, true}) {
            RenderSettings full = settings_of(Algorithm::amax, true);
            RenderSettings adaptive = settings_of(Algorithm::ais, true, 0.0);
            full.sampling.near_residual = adaptive.sampling.near_residual = near;
            const Rendering amax = render(backend, cornell_box(), full, 2);
            Image ais = render(backend, cornell_box(), adaptive, 2).image;
            std::erase_if(ais.layers,
                          [](const Layer& layer) { return is_overlay_layer(layer.name); });
            EXPECT_EQ(test::differing_values(amax.image, ais), 0U)
                << test::backend_name(backend) << (near ? ", near" : "");
        }
}

TEST(FilterResidual, OpenClEqualsTheNativeKernelsBitForBit) {
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    RenderSettings settings = settings_of(Algorithm::ais, true);
    settings.sampling.near_residual = true;
    const Rendering native = render(TestBackend::own_bvh, cornell_box(), settings, 2);
    const Rendering opencl = render(TestBackend::opencl, cornell_box(), settings, 2);
    EXPECT_EQ(test::differing_values(native.image, opencl.image), 0U);
}

FlatScene integrating_sphere(float reflectance) {
    test::SceneBuilder builder;
    builder.add(test::icosphere(5, true), builder.material(glm::vec3(reflectance)));
    builder.light(LightType::point, {0.0, 0.0, 0.0}, glm::vec3(1.0F));
    return flatten(builder.scene);
}

Camera camera_in_sphere() {
    return test::look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2);
}

// An integrating sphere about a point light (see vpl_residual_test): irradiance is the same
// everywhere, so no interpolation errs, and the residual is what the bound cuts off and all later
// orders. Pixels' paths are independent but for the filter's 3 x 3 footprints: the error of the
// mean is that of a ninth of the pixels at most.
TEST(FilterResidual, InASphereTheMeanIsThatOfAllOrders) {
    constexpr float reflectance = 0.8F;
    constexpr std::uint32_t width = 160;
    constexpr std::uint32_t height = 128;
    const FlatScene flat = integrating_sphere(reflectance);
    const Camera camera = camera_in_sphere();
    for (const double threshold : {0.0, 12.0, 1e9}) {
        RenderSettings settings = test::small_settings(Algorithm::ais, width, height);
        settings.sampling.threshold = threshold;
        settings.sampling.compensation = true;
        settings.sampling.roulette = 0.0;  // all VPLs add alike, chance would decide on them all
        // The bound leaves VPLs 0.3 of what G is everywhere.
        settings.sampling.bound_spacing =
            std::sqrt(9.0 * plan_for(flat, settings).vpls_per_set / 0.3);
        const Rendering rendering =
            test::render_flat(test::shared_executor(TestBackend::own_bvh), flat, camera, settings);
        test::expect_clean(rendering);
        std::vector<double> irradiance = test::channel_of(rendering, "indirect", 0);
        for (double& value : irradiance)
            value *= std::numbers::pi / static_cast<double>(reflectance);
        Estimate mean = test::estimate(irradiance);
        mean.error *= 3.0;
        const double all =
            static_cast<double>(reflectance) / (1.0 - static_cast<double>(reflectance));
        test::expect_estimate(mean, all, {comparisons, 0.01, 4e-3},
                              "threshold " + testing::PrintToString(threshold));
        if (threshold <= 1e6) continue;
        EXPECT_LT(rendering.stats[0].levels.back().samples, width * height / 10U);
    }
}

// The same of a near residual, which leaves out later orders. It is averaged over 9 x 9 pixels: the
// error of the mean is that of an 81st of the pixels at most.
TEST(FilterResidual, NearInASphereTheMeanIsThatOfTheOrdersWithVpls) {
    constexpr float reflectance = 0.8F;
    const FlatScene flat = integrating_sphere(reflectance);
    const Camera camera = camera_in_sphere();
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::amax}) {
        RenderSettings settings = test::small_settings(algorithm, 400, 320);
        settings.sampling.compensation = true;
        settings.sampling.near_residual = true;
        settings.sampling.vpl_tail = false;
        settings.sampling.roulette = 0.0;
        settings.sampling.bound_spacing =
            std::sqrt(9.0 * plan_for(flat, settings).vpls_per_set / 0.3);
        const Rendering rendering =
            test::render_flat(test::shared_executor(TestBackend::own_bvh), flat, camera, settings);
        test::expect_clean(rendering);
        std::vector<double> irradiance = test::channel_of(rendering, "indirect", 0);
        for (double& value : irradiance)
            value *= std::numbers::pi / static_cast<double>(reflectance);
        Estimate mean = test::estimate(irradiance);
        mean.error *= 9.0;
        double orders = 0.0;
        for (int k = 1; k <= 8; ++k) orders += std::pow(static_cast<double>(reflectance), k);
        test::expect_estimate(mean, orders, {comparisons, 0.01, 4e-3},
                              algorithm == Algorithm::ais ? "ais" : "amax");
    }
}

// Means over the image of 64 seeds, of three frames each, against as many of path tracing. The
// filter's blur and the undersampling that is let pass here cost less than 0.4 %.
TEST(FilterResidual, TheMeanOverFramesIsThatOfPathTracing) {
    constexpr std::uint32_t edge = 64;
    const ShippedScene& box = cornell_box();
    std::vector<double> found;
    std::vector<double> without;
    std::vector<double> traced;
    for (std::uint32_t seed = 1; seed <= 64; ++seed) {
        RenderSettings settings = test::small_settings(Algorithm::ais, edge, edge);
        settings.sampling.threshold = 3.0;
        settings.sampling.enough_support = 0.7;
        settings.seed = seed;
        settings.samples = 3;
        settings.direct = false;
        // Much is left to add.
        settings.sampling.bounces = 4;
        settings.sampling.bound_spacing = 2.0;
        settings.sampling.local_bounds = false;
        settings.sampling.vpl_tail = false;
        for (const bool compensation : {false, true}) {
            settings.sampling.compensation = compensation;
            const Rendering rendering = render(TestBackend::embree, box, settings, 3);
            (compensation ? found : without).push_back(test::mean_of(rendering.layer("indirect")));
        }
        const PathSettings path = test::path_settings(edge, edge, 16, 7000 + seed);
        traced.push_back(test::mean_of(
            test::path_image(test::shared_executor(TestBackend::embree), box.flat, box.camera, path)
                .layer("indirect")));
    }
    const Estimate reference = test::estimate(traced);
    const Estimate mean = test::estimate(found);
    test::expect_estimate({mean.mean, std::hypot(mean.error, reference.error)}, reference.mean,
                          {comparisons, 0.01, 0.004}, "Cornell box");
    EXPECT_LT(test::estimate(without).mean, 0.97 * reference.mean) << "nothing to add";
}

TEST(FilterResidual, IsThereWhereItIsAskedForAndSamplesAreFew) {
    const ShippedScene& box = cornell_box();
    const auto has_it = [&](const RenderSettings& settings) {
        test::CountingExecutor executor(test::make_executor(TestBackend::own_bvh));
        const Renderer renderer(executor, box.flat, box.camera, settings);
        const bool builds = std::ranges::count(executor.kernels(), "filter_residual") > 0;
        const bool allocates = std::ranges::count(executor.allocations(), "VPL residual",
                                                  &test::CountingExecutor::Allocation::first) > 0;
        EXPECT_EQ(builds, allocates);
        return builds;
    };
    EXPECT_TRUE(has_it(settings_of(Algorithm::ais, true)));
    EXPECT_FALSE(has_it(settings_of(Algorithm::ais, true, 0.0)));
    EXPECT_FALSE(has_it(settings_of(Algorithm::ais, false)));
    EXPECT_FALSE(has_it(settings_of(Algorithm::amax, true)));
    EXPECT_FALSE(has_it(settings_of(Algorithm::igi, true)));
}

}  // namespace
}  // namespace weft::filter_residual_test
