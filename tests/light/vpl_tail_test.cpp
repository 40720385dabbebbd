// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "device/launch.h"
#include "tests/testing/render_fixture.h"

// The light of all bounces after the last (kernels/light/vpl_tail.cl), where it is known.
namespace weft::vpl_tail_test {
namespace {

using test::TestBackend;

constexpr std::uint32_t sets = 3;

/// Parameters of sets whose bounces have that many VPLs.
shared::RenderParams params_of(const std::vector<std::uint32_t>& survivors) {
    shared::RenderParams params{};
    params.sampling.sets = sets;
    params.sampling.bounces = static_cast<std::uint32_t>(survivors.size());
    for (std::size_t k = 0; k < survivors.size(); ++k) {
        params.sampling.first_vpl[k] = params.sampling.walked_per_set;
        params.sampling.survivors[k] = survivors[k];
        params.sampling.walked_per_set += survivors[k];
    }
    return params;
}

/// VPLs of which all of a bounce together have the flux `of_bounce` of its number, by channel.
template <class Flux>
std::vector<shared::Vpl> vpls_of(const shared::RenderParams& params, const Flux& of_bounce) {
    std::vector<shared::Vpl> vpls(sets * params.sampling.walked_per_set);
    for (std::uint32_t k = 0; k < params.sampling.bounces; ++k)
        for (std::uint32_t set = 0; set < sets; ++set)
            for (std::uint32_t i = 0; i < params.sampling.survivors[k]; ++i) {
                const glm::vec3 flux =
                    of_bounce(k) / static_cast<float>(sets * params.sampling.survivors[k]);
                vpls[set * params.sampling.walked_per_set + params.sampling.first_vpl[k] + i]
                    .flux = {flux.x, flux.y, flux.z, 0.25F};
            }
    return vpls;
}

/// Flux of the VPLs of a bounce.
glm::vec3 flux_of(const shared::RenderParams& params, const std::vector<shared::Vpl>& vpls,
                  std::uint32_t bounce) {
    glm::vec3 sum(0.0F);
    for (std::uint32_t set = 0; set < sets; ++set)
        for (std::uint32_t i = 0; i < params.sampling.survivors[bounce]; ++i) {
            const auto& flux =
                vpls[set * params.sampling.walked_per_set + params.sampling.first_vpl[bounce] + i]
                    .flux;
            sum += glm::vec3(flux.x, flux.y, flux.z);
        }
    return sum;
}

std::vector<shared::Vpl> with_tail(TestBackend backend, const shared::RenderParams& params,
                                   const std::vector<shared::Vpl>& vpls) {
    Executor& executor = test::shared_executor(backend);
    executor.build(std::vector{KernelId::vpl_tail}, 0);
    auto buffer = allocate<kinds::VirtualLights>(executor, vpls.size(), "VPLs");
    write_buffer(executor, buffer, vpls);
    EXPECT_TRUE(run_kernel(executor, params, kernels::vpl_tail{.vpls = buffer}, 1));
    return read_buffer(executor, buffer, vpls.size());
}

TEST(VplTail, TheSeriesOfBouncesEndsWithItsSum) {
    const glm::vec3 ratio(0.5F, 0.9F, 0.2F);
    const auto series = [&](std::uint32_t k) {
        return 3.0F * glm::pow(ratio, glm::vec3(static_cast<float>(k)));
    };
    for (const std::vector<std::uint32_t>& survivors :
         {std::vector<std::uint32_t>{5, 2}, {9, 7, 4}, {32, 16, 8, 4, 2, 1, 1, 1}}) {
        const shared::RenderParams params = params_of(survivors);
        const std::vector<shared::Vpl> vpls = vpls_of(params, series);
        const std::uint32_t last = params.sampling.bounces - 1;
        for (const TestBackend backend : test::backends()) {
            const std::vector<shared::Vpl> result = with_tail(backend, params, vpls);
            const glm::vec3 found = flux_of(params, result, last);
            const glm::vec3 expected = series(last) / (1.0F - ratio);
            for (glm::length_t c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c] / expected[c], 1.0F, 2e-5F) << test::backend_name(backend);
            for (std::uint32_t k = 0; k < last; ++k)
                EXPECT_EQ(flux_of(params, result, k), flux_of(params, vpls, k));
            EXPECT_EQ(result.back().flux.w, 0.25F);
        }
    }
}

TEST(VplTail, MediaCountAsMuchAsSurfaces) {
    // The flux of a VPL on a surface is stored over pi: a path that leaves the surface for a medium
    // has the same flux in it as a number pi times as high.
    const shared::RenderParams params = params_of({1, 1});
    std::vector<shared::Vpl> vpls = vpls_of(params, [](std::uint32_t) { return glm::vec3(1.0F); });
    const std::uint32_t medium = VPL_MEDIUM;
    for (std::size_t i = 1; i < vpls.size(); i += 2)
        std::memcpy(&vpls[i].normal.w, &medium, sizeof medium);
    // A quarter of the flux at the second bounce, whose series adds a third of it.
    for (std::size_t i = 0; i < vpls.size(); i += 2)
        vpls[i].flux.x = vpls[i + 1].flux.x * 4.0F / 3.14159265F;
    const std::vector<shared::Vpl> result = with_tail(TestBackend::own_bvh, params, vpls);
    EXPECT_NEAR(result[1].flux.x / vpls[1].flux.x, 4.0F / 3.0F, 1e-5F);
}

TEST(VplTail, LightThatDoesNotFallOrIsNotThereIsLimited) {
    const shared::RenderParams params = params_of({4, 4, 2, 2});
    const auto factor = [&](float before, float after) {
        const std::vector<shared::Vpl> vpls =
            vpls_of(params, [&](std::uint32_t k) { return glm::vec3(k < 3 ? before : after); });
        const std::vector<shared::Vpl> result = with_tail(TestBackend::own_bvh, params, vpls);
        return result.back().flux.x / vpls.back().flux.x;
    };
    EXPECT_NEAR(factor(1.0F, 1.0F), 20.0F, 1e-4F);
    EXPECT_NEAR(factor(1.0F, 7.0F), 20.0F, 1e-4F);
    EXPECT_EQ(factor(0.0F, 1.0F), 1.0F);
    for (const float scale : {1e-36F, 1e36F}) {
        const std::vector<shared::Vpl> vpls = vpls_of(params, [&](std::uint32_t k) {
            return glm::vec3(scale * std::pow(0.5F, static_cast<float>(k)));
        });
        const std::vector<shared::Vpl> result = with_tail(TestBackend::own_bvh, params, vpls);
        EXPECT_NEAR(result.back().flux.x / vpls.back().flux.x, 2.0F, 1e-3F);
    }
}

}  // namespace
}  // namespace weft::vpl_tail_test
