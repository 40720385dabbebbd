// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "plan/quality.h"

namespace weft::frame_plan_test {
namespace {

SceneStatistics room(double reflectance = 0.5) {
    SceneStatistics scene;
    scene.area_lights = 1;
    scene.surface_area = 24.0;
    scene.mean_reflectance = reflectance;
    return scene;
}

FramePlan plan_of(double reflectance, const SamplingSettings& settings = {}) {
    return plan_frames(Algorithm::igi, settings, room(reflectance));
}

std::uint32_t survivor_sum(const FramePlan& plan) {
    return std::accumulate(plan.survivors.begin(), plan.survivors.end(), 0U);
}

void expect_consistent(const FramePlan& plan, const SamplingSettings& settings) {
    ASSERT_GT(plan.paths_per_set, 0u);
    EXPECT_EQ(plan.bounces, settings.bounces);
    EXPECT_LE(plan.vpls_per_set, settings.vpls_per_set);
    EXPECT_EQ(plan.walked_per_set, survivor_sum(plan));
    EXPECT_EQ(plan.survivors[0], plan.paths_per_set);
    std::uint32_t first = 0;
    for (std::uint32_t k = 0; k < MAX_BOUNCES; ++k) {
        if (k >= plan.bounces) {
            EXPECT_EQ(plan.survivors[k], 0u);
            continue;
        }
        EXPECT_GE(plan.survivors[k], 1u) << "bounce " << k;
        EXPECT_EQ(plan.first_vpl[k], first) << "bounce " << k;
        EXPECT_LE(plan.survivors[k], plan.survivors[k > 0 ? k - 1 : 0]) << "bounce " << k;
        first += plan.survivors[k];
    }
}

TEST(FramePlan, StandardSettingByHand) {
    // floor(N/2^k), at least 1, add up to 60 for N = 31, and to 65 for N = 32.
    const FramePlan plan = plan_of(0.5);
    EXPECT_EQ(plan.paths_per_set, 31u);
    constexpr std::array<std::uint32_t, MAX_BOUNCES> by_hand{31, 15, 7, 3, 1, 1, 1, 1};
    EXPECT_EQ(plan.survivors, by_hand);
    EXPECT_EQ(plan.vpls_per_set, 60u);
    EXPECT_EQ(plan.sets, 9u);
    EXPECT_EQ(plan.interleave, 3u);
    EXPECT_EQ(plan.gather_sets, 9u);
    EXPECT_EQ(plan.filter_radius, 1u);
    EXPECT_EQ(plan.samples_per_light, 4u);
    EXPECT_EQ(plan.samples_per_set, 4u);
    EXPECT_EQ(plan.light_sample_count(), 36u);
    EXPECT_TRUE(plan.has_indirect() && plan.has_sampled_direct());
    EXPECT_FALSE(plan.has_exact_direct() || plan.has_distant());
}

TEST(FramePlan, AdaptiveSamplingChoosesAmongMoreVplsThanItGathers) {
    SamplingSettings settings;
    const SceneStatistics scene = room();
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::amax}) {
        const FramePlan plan = plan_frames(algorithm, settings, scene);
        EXPECT_TRUE(plan.selects_vpls());
        EXPECT_EQ(plan.vpls_per_set, 64U);
        EXPECT_LE(plan.walked_per_set, 512U);
        EXPECT_GT(plan.walked_per_set, 500U);
        EXPECT_EQ(plan.walked_per_set, survivor_sum(plan));
    }
    for (const Algorithm algorithm :
         {Algorithm::igi, Algorithm::ir, Algorithm::ic, Algorithm::tic, Algorithm::reference}) {
        const FramePlan plan = plan_frames(algorithm, settings, scene);
        EXPECT_FALSE(plan.selects_vpls());
        EXPECT_EQ(plan.vpls_per_set, plan.walked_per_set);
        EXPECT_LE(plan.vpls_per_set, 64U);
    }
    SamplingSettings records = settings;
    records.cached = true;
    EXPECT_FALSE(plan_frames(Algorithm::ais, records, scene).selects_vpls());
    // What candidates bring to the camera is kept, so that there are never more than 4096.
    settings.vpls_per_set = 3000;
    const FramePlan many = plan_frames(Algorithm::ais, settings, scene);
    EXPECT_EQ(many.vpls_per_set, 3000U);
    EXPECT_GT(many.walked_per_set, 4000U);
    EXPECT_LE(many.walked_per_set, 4096U);
    settings.vpls_per_set = 5000;
    EXPECT_FALSE(plan_frames(Algorithm::ais, settings, scene).selects_vpls());
    settings = {};
    settings.candidates = 1;
    EXPECT_FALSE(plan_frames(Algorithm::ais, settings, scene).selects_vpls());
}

TEST(FramePlan, ConsistentForAllReflectancesAndSizes) {
    for (std::uint32_t bounces = 1; bounces <= MAX_BOUNCES; ++bounces)
        for (const std::uint32_t vpls : {8U, 9U, 16U, 64U, 100U, 1024U})
            for (int step = 1; step <= 100; ++step) {
                SamplingSettings settings;
                settings.bounces = bounces;
                settings.vpls_per_set = vpls;
                SCOPED_TRACE(testing::Message() << bounces << " bounces, " << vpls << " VPLs, "
                                                << step << " % reflected");
                expect_consistent(plan_of(step / 100.0, settings), settings);
            }
}

TEST(FramePlan, AnotherPathWouldNotFit) {
    for (int step = 5; step <= 95; ++step) {
        const double r = step / 100.0;
        const FramePlan plan = plan_of(r);
        double count = 0.0;
        for (std::uint32_t k = 0; k < plan.bounces; ++k)
            count += std::max(1.0, std::floor((plan.paths_per_set + 1) * std::pow(r, k) + 1e-9));
        EXPECT_GT(count, 64.0) << r;
    }
}

TEST(FramePlan, BrighterScenesGetFewerButLongerPaths) {
    std::uint32_t before = std::numeric_limits<std::uint32_t>::max();
    for (int step = 1; step <= 100; ++step) {
        const std::uint32_t paths = plan_of(step / 100.0).paths_per_set;
        EXPECT_LE(paths, before) << step;
        before = paths;
    }
    EXPECT_LT(plan_of(1.0).paths_per_set, plan_of(0.05).paths_per_set);
    EXPECT_GT(plan_of(1.0).survivors[3], plan_of(0.05).survivors[3]);
}

TEST(FramePlan, MoreVplsNeverMeanFewerPaths) {
    std::uint32_t before = 0;
    for (std::uint32_t vpls = 4; vpls < 500; ++vpls) {
        SamplingSettings settings;
        settings.vpls_per_set = vpls;
        const std::uint32_t paths = plan_of(0.6, settings).paths_per_set;
        EXPECT_GE(paths, before) << vpls;
        before = paths;
    }
}

TEST(FramePlan, WithoutReflectionThereIsNoIndirectLight) {
    for (const double reflectance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        const FramePlan plan = plan_of(reflectance);
        EXPECT_FALSE(plan.has_indirect());
        EXPECT_EQ(plan.vpls_per_set, 0u);
        EXPECT_EQ(survivor_sum(plan), 0u);
        EXPECT_TRUE(plan.has_sampled_direct());
    }
}

TEST(FramePlan, ExtremeReflectancesAreBounded) {
    EXPECT_EQ(plan_of(1.0).survivors, plan_of(0.95).survivors);
    EXPECT_EQ(plan_of(1e300).survivors, plan_of(0.95).survivors);
    EXPECT_EQ(plan_of(1e-300).survivors, plan_of(0.05).survivors);
}

TEST(FramePlan, WithoutLightsThereIsNothingToDo) {
    SceneStatistics dark = room();
    dark.area_lights = 0;
    for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ir}) {
        const FramePlan plan = plan_frames(algorithm, {}, dark);
        EXPECT_FALSE(plan.has_indirect() || plan.has_sampled_direct() || plan.has_exact_direct() ||
                     plan.has_distant());
        EXPECT_EQ(plan.light_sample_count(), 0u);
    }
}

TEST(FramePlan, EveryKindOfLightAloneCallsForIndirectLight) {
    for (int kind = 0; kind < 4; ++kind) {
        SceneStatistics scene = room();
        scene.area_lights = kind == 0 ? 1 : 0;
        scene.punctual_lights = kind == 1 ? 2 : 0;
        scene.directional_lights = kind == 2 ? 3 : 0;
        scene.environment = kind == 3;
        const FramePlan plan = plan_frames(Algorithm::igi, {}, scene);
        EXPECT_TRUE(plan.has_indirect()) << kind;
        EXPECT_EQ(plan.has_sampled_direct(), kind == 0 || kind == 3) << kind;
        EXPECT_EQ(plan.has_exact_direct(), kind == 1 || kind == 2) << kind;
        EXPECT_EQ(plan.has_distant(), kind == 2 || kind == 3) << kind;
        EXPECT_EQ(plan.light_sample_count(), kind == 1 ? 2u : kind == 2 ? 0u : 36u) << kind;
    }
}

TEST(FramePlan, SamplesOfManyLightsAreCountedBeyond32Bits) {
    SamplingSettings settings;
    settings.samples_per_light = 1U << 14;
    settings.max_samples_per_set = 1U << 14;
    SceneStatistics scene = room();
    // 2^32 samples would be none, and a light more those of one light.
    for (const std::uint32_t lights : {1U << 18, (1U << 18) + 1}) {
        scene.area_lights = lights;
        const FramePlan plan = plan_frames(Algorithm::igi, settings, scene);
        EXPECT_EQ(plan.samples_per_light, 0U);
        EXPECT_EQ(plan.samples_per_set, 1U << 14);
    }
}

TEST(FramePlan, WhatTheUserLeavesOutCostsNothing) {
    SceneStatistics scene = room();
    scene.punctual_lights = 2;
    scene.directional_lights = 1;
    scene.environment = true;
    scene.direct = false;
    const FramePlan indirect = plan_frames(Algorithm::igi, {}, scene);
    EXPECT_TRUE(indirect.has_indirect());
    EXPECT_FALSE(indirect.has_sampled_direct() || indirect.has_exact_direct());
    EXPECT_EQ(indirect.light_sample_count(), 0u);
    scene.direct = true;
    scene.indirect = false;
    const FramePlan direct = plan_frames(Algorithm::igi, {}, scene);
    EXPECT_FALSE(direct.has_indirect());
    EXPECT_TRUE(direct.has_sampled_direct() && direct.has_exact_direct());
    EXPECT_EQ(direct.light_sample_count(), 36u + 2u + 36u);
}

TEST(FramePlan, ManyAreaLightsAreChosenByPower) {
    SceneStatistics scene = room();
    scene.area_lights = 64;
    const FramePlan all = plan_frames(Algorithm::igi, {}, scene);
    EXPECT_EQ(all.samples_per_light, 4u);
    EXPECT_EQ(all.samples_per_set, 256u);
    scene.area_lights = 65;
    const FramePlan chosen = plan_frames(Algorithm::igi, {}, scene);
    EXPECT_EQ(chosen.samples_per_light, 0u);
    EXPECT_EQ(chosen.samples_per_set, 256u);
    EXPECT_TRUE(chosen.has_sampled_direct());
    // The bound stands for the samples a light gets on average.
    const double square = std::pow(SamplingSettings{}.bound_spacing, 2);
    EXPECT_NEAR(chosen.light_bound_scale, std::numbers::pi * 9.0 * 256.0 / 65.0 / square, 1e-9);
    EXPECT_NEAR(all.light_bound_scale, std::numbers::pi * 9.0 * 4.0 / square, 1e-9);
}

TEST(FramePlan, DraftsChooseAmongMoreThanFourLights) {
    SceneStatistics scene = room();
    scene.area_lights = 4;
    EXPECT_EQ(plan_frames(Algorithm::ais, sampling_of(Quality::draft), scene).samples_per_light,
              4u);
    scene.area_lights = 5;
    const FramePlan chosen = plan_frames(Algorithm::ais, sampling_of(Quality::draft), scene);
    EXPECT_EQ(chosen.samples_per_light, 0u);
    EXPECT_EQ(chosen.samples_per_set, 16u);
    EXPECT_FALSE(chosen.adapts_direct());
}

TEST(FramePlan, DirectLightAdaptsToAsManyLightsAsAreToldApart) {
    SceneStatistics scene = room();
    SamplingSettings settings;
    settings.max_samples_per_set = 1024;
    scene.area_lights = 64;
    EXPECT_TRUE(plan_frames(Algorithm::ais, settings, scene).adapts_direct());
    EXPECT_FALSE(plan_frames(Algorithm::amax, settings, scene).adapts_direct());
    scene.area_lights = 65;
    EXPECT_EQ(plan_frames(Algorithm::ais, settings, scene).samples_per_light, 4u);
    EXPECT_FALSE(plan_frames(Algorithm::ais, settings, scene).adapts_direct());
}

TEST(FramePlan, FewSamplesOnLightsAreAllTracedAtOnce) {
    SceneStatistics scene = room();
    scene.area_lights = 15;
    EXPECT_FALSE(plan_frames(Algorithm::ais, {}, scene).adapts_direct());
    scene.area_lights = 16;
    EXPECT_TRUE(plan_frames(Algorithm::ais, {}, scene).adapts_direct());
    scene.area_lights = 3;
    EXPECT_FALSE(plan_frames(Algorithm::ais, sampling_of(Quality::high), scene).adapts_direct());
    scene.area_lights = 4;
    EXPECT_TRUE(plan_frames(Algorithm::ais, sampling_of(Quality::high), scene).adapts_direct());
}

TEST(FramePlan, InstantRadiosityMakesTheSameSetsAndUsesAll) {
    for (const double reflectance : {0.1, 0.5, 0.9}) {
        const FramePlan igi = plan_frames(Algorithm::igi, {}, room(reflectance));
        const FramePlan ir = plan_frames(Algorithm::ir, {}, room(reflectance));
        EXPECT_EQ(ir.sets, igi.sets);
        EXPECT_EQ(ir.survivors, igi.survivors);
        EXPECT_EQ(ir.first_vpl, igi.first_vpl);
        EXPECT_EQ(ir.samples_per_set, igi.samples_per_set);
        EXPECT_EQ(ir.vpl_bound, igi.vpl_bound);
        EXPECT_EQ(ir.light_bound_scale, igi.light_bound_scale);
        EXPECT_EQ(ir.interleave, 1u);
        EXPECT_EQ(ir.gather_sets, 1u);
        EXPECT_EQ(ir.filter_radius, 0u);
    }
}

TEST(FramePlan, IrradianceCachingTracesHemispheresInsteadOfVpls) {
    SamplingSettings settings;
    for (const auto& [rays, elevations, azimuths] :
         {std::array{16U, 2U, 8U}, {256U, 9U, 28U}, {1024U, 18U, 56U}, {16384U, 72U, 227U}}) {
        settings.cache_rays = rays;
        const FramePlan plan = plan_frames(Algorithm::irradiance_cache, settings, room());
        EXPECT_EQ(plan.cache_elevations, elevations);
        EXPECT_EQ(plan.cache_azimuths, azimuths);
        EXPECT_TRUE(plan.has_indirect() && plan.cached && plan.traces_hemispheres());
        EXPECT_FALSE(plan.has_vpls() || plan.gathers_vpls() || plan.temporal);
        EXPECT_EQ(plan.samples_per_set, plan_of(0.5).samples_per_set);
    }
    for (std::uint32_t rays = 16; rays <= 16384; ++rays) {
        settings.cache_rays = rays;
        const FramePlan plan = plan_frames(Algorithm::irradiance_cache, settings, room());
        EXPECT_LE(plan.cache_elevations * plan.cache_azimuths, rays);
        // As wide as high, within rounding to whole cells: 18 rays have 2 by 9.
        EXPECT_NEAR(plan.cache_azimuths / (std::numbers::pi * plan.cache_elevations), 1.0, 0.45)
            << rays;
    }
    EXPECT_FALSE(plan_frames(Algorithm::irradiance_cache, {}, room(0.0)).has_indirect());
    SceneStatistics scene = room();
    scene.indirect = false;
    EXPECT_FALSE(plan_frames(Algorithm::irradiance_cache, {}, scene).traces_hemispheres());
    EXPECT_TRUE(plan_frames(Algorithm::ic, {}, room()).gathers_vpls());
    EXPECT_FALSE(plan_frames(Algorithm::ic, {}, room()).traces_hemispheres());
}

TEST(FramePlan, TooManyBouncesAreCut) {
    SamplingSettings settings;
    settings.bounces = MAX_BOUNCES + 5;
    const FramePlan plan = plan_of(0.5, settings);
    EXPECT_EQ(plan.bounces, static_cast<std::uint32_t>(MAX_BOUNCES));
    EXPECT_LE(plan.vpls_per_set, 64u);
}

TEST(FramePlan, BoundOfVirtualLights) {
    // 1/d^2 at d = c sqrt(area / (pi count)).
    const double distance = 2.0 * std::sqrt(24.0 / (std::numbers::pi * 576.0));
    EXPECT_NEAR(vpl_bound(24.0, 576.0, 2.0), 1.0 / (distance * distance), 1e-9);
    SamplingSettings settings;
    settings.bound_spacing = 1.5;
    EXPECT_NEAR(plan_of(0.5, settings).vpl_bound, vpl_bound(24.0, 9.0 * 60.0, 1.5), 1e-9);
}

TEST(FramePlan, BoundScalesWithTheSceneAndTheCount) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> exponent(-6.0, 6.0);
    for (int i = 0; i < 1000; ++i) {
        const double area = std::pow(10.0, exponent(random));
        const double scale = std::pow(10.0, exponent(random) / 2.0);
        const double bound = vpl_bound(area, 100.0, 1.0);
        // The bound on G at a place of a scene that is `scale` times as large.
        EXPECT_NEAR(vpl_bound(area * scale * scale, 100.0, 1.0) * scale * scale / bound, 1.0,
                    1e-12);
        EXPECT_NEAR(vpl_bound(area, 200.0, 1.0) / bound, 2.0, 1e-12);
        EXPECT_NEAR(vpl_bound(area, 100.0, 2.0) / bound, 0.25, 1e-12);
    }
}

TEST(FramePlan, BoundWithoutMeaningIsNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double none : {0.0, -1.0, nan}) {
        EXPECT_EQ(vpl_bound(none, 64.0, 1.0), 1e30);
        EXPECT_EQ(vpl_bound(1.0, 64.0, none), 1e30);
    }
    EXPECT_EQ(vpl_bound(1e-300, 1e300, 1.0), 1e30);
    EXPECT_EQ(vpl_bound(1.0, 0.0, 1.0), 0.0);
}

TEST(FramePlan, BoundGrowsWithoutLimitButSlowerThanFrames) {
    EXPECT_EQ(bound_growth(0), 1.0);
    EXPECT_EQ(bound_growth(3), 2.0);
    EXPECT_EQ(bound_growth(99), 10.0);
    for (std::uint32_t frame = 1; frame < 100000; frame *= 2) {
        EXPECT_GT(bound_growth(frame), bound_growth(frame - 1));
        EXPECT_LT(bound_growth(frame) / (frame + 1), bound_growth(frame - 1) / frame);
    }
    EXPECT_NEAR(bound_growth(std::numeric_limits<std::uint32_t>::max()), 65536.0, 1e-6);
}

}  // namespace
}  // namespace weft::frame_plan_test
