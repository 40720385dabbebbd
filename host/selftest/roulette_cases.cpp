// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/path_rendering.h"
#include "selftest/scene_builder.h"

#define NATIVE_KERNELS "kernels/path/path.cl"
#include "selftest/native_kernels.h"

// Russian roulette, which must keep the mean whatever the probability of survival.
namespace weft::selftest {
namespace {

/// The mean weight after roulette of paths with this throughput, which should be 1; the number of
/// survivors is binomial.
Estimate mean_weight(float throughput) {
    constexpr int paths = 200'000;
    native::Random random = native::make_random(5, 6, 7);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < paths; ++i) {
        native::PathVertex vertex{};
        vertex.bounce = ROULETTE_START;
        const native::float3 white = native::f3(1.0F, 1.0F, 1.0F);
        vertex.surface.bsdf.albedo = white;
        vertex.throughput = white * throughput;
        vertex.survival = 1.0F;
        if (native::survives(&vertex, ROULETTE_START, ROULETTE_LEVEL, &random) == 0) continue;
        const double weight = static_cast<double>(native::scattered_throughput(&vertex, white).x) /
                              static_cast<double>(throughput);
        sum += weight;
        squares += weight * weight;
    }
    const double mean = sum / paths;
    return {mean, std::sqrt(std::max(0.0, squares / paths - mean * mean) / paths)};
}

/// Radiance in a closed sphere whose whole surface emits 1.
Estimate furnace(Executor& executor, float albedo, std::uint32_t samples) {
    SceneBuilder builder;
    builder.add(icosphere(2, true), builder.material(glm::vec3(albedo), glm::vec3(1.0F)));
    const Rendering rendering =
        trace_paths(executor, builder.scene, look_at({0.1, 0.2, 0.3}, {-0.5, 0.1, -0.4}, 1.2),
                    path_settings(20, 20, samples, 9));
    return beauty_of(rendering, 0);
}

}  // namespace

std::vector<SelftestCase> roulette_cases() {
    const std::string random = "paths end by chance; the sum of those that go on keeps its mean";
    const std::string binomial = "of 200,000 paths the survivors are binomial";
    return {
        host_case(
            35, "roulette at any probability",
            {{"weight where 1 of 20 survives", 1.0, by_chance(0.02, 1e-6), binomial},
             {"weight where 1 of 2 survives", 1.0, by_chance(0.02, 1e-6), binomial}},
            []() -> std::vector<Measured> {
                return {mean_weight(0.05F * ROULETTE_LEVEL), mean_weight(0.5F * ROULETTE_LEVEL)};
            }),
        {35,
         "roulette at any probability",
         RunsOn::devices,
         {{"furnace of albedo 1/10", 1.0 / 0.9, by_chance(0.01, 1e-5), random},
          {"furnace of albedo 95/100", 20.0, by_chance(0.02, 2e-5), random}},
         [](Executor& executor) -> std::vector<Measured> {
             return {furnace(executor, 0.1F, 64), furnace(executor, 0.95F, 64)};
         }}};
}

}  // namespace weft::selftest
