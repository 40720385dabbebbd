// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "device/launch.h"
#include "pipeline/frame_context.h"
#include "tests/testing/render_fixture.h"

// What VPLs bring to points that the camera sees (kernels/light/vpl_contribution.cl), against the
// geometry term in double precision.
namespace weft::vpl_contribution_test {
namespace {

using test::TestBackend;

constexpr std::uint32_t points = 32;
constexpr std::uint32_t sets = 2;
constexpr std::uint32_t walked = 21;
constexpr std::uint32_t pixels = 200;
constexpr float scale = 0.25F;

/// The plane z = 0 as the camera sees it, some of its pixels without a surface, below a screen at
/// z = 0.5 that covers x < 0.
struct Stage {
    std::vector<shared::float4> positions, normals, shadings, albedo, emission;
    std::vector<std::uint32_t> ids, view_points;
    std::vector<shared::Vpl> vpls;
    std::vector<shared::float4> corners{
        {-9, -9, 0.5F, 0}, {0, -9, 0.5F, 0}, {0, 9, 0.5F, 0}, {-9, 9, 0.5F, 0}};
    std::vector<shared::Triangle> triangles{{0, 1, 2, 0}, {0, 2, 3, 0}};
};

Stage make_stage() {
    Stage stage;
    std::mt19937 random(17);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    for (std::uint32_t i = 0; i < pixels; ++i) {
        const bool surface = i % 13 != 5;
        stage.positions.push_back({uniform(random), uniform(random), 0.0F, 0.0F});
        stage.normals.push_back({0.0F, 0.0F, 1.0F, 0.0F});
        const glm::vec3 bent =
            glm::normalize(glm::vec3(0.3F * uniform(random), 0.3F * uniform(random), 1.0F));
        stage.shadings.push_back({bent.x, bent.y, bent.z, 0.0F});
        stage.albedo.push_back({0.5F, 0.5F, 0.5F, surface ? 1.0F : 0.0F});
        stage.emission.push_back({});
        stage.ids.push_back(surface ? i : INVALID_INDEX);
        stage.ids.push_back(0);
    }
    for (std::uint32_t i = 0; i < sets * points; ++i) stage.view_points.push_back(i * 37 % pixels);
    for (std::uint32_t i = 0; i < sets * walked; ++i) {
        shared::Vpl vpl{};
        vpl.position = {uniform(random), uniform(random), 0.3F + 0.5F * std::abs(uniform(random)),
                        i % 4 == 0 ? 0.05F : 1e30F};
        const glm::vec3 normal = glm::normalize(
            glm::vec3(0.5F * uniform(random), 0.5F * uniform(random), i % 5 == 0 ? 1.0F : -1.0F));
        vpl.normal = {normal.x, normal.y, normal.z, 0.0F};
        const float flux = i % 6 == 0 ? 0.0F : 1.0F + uniform(random);
        vpl.flux = {flux, 0.5F * flux, 2.0F * flux, 0.5F};
        stage.vpls.push_back(vpl);
    }
    return stage;
}

glm::dvec3 vector_of(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

struct Expected {
    double value = 0.0;
    /// What rounding may change: distances to planes, which are off by some 1e-6 with the offset of
    /// receivers, and the factor that they share.
    double rounding = 0.0;
};

Expected expected_contribution(const Stage& stage, const shared::Vpl& vpl, std::uint32_t pixel) {
    if (stage.ids[2 * std::size_t{pixel}] == INVALID_INDEX) return {};
    const glm::dvec3 from = vector_of(vpl.position);
    const glm::dvec3 d = vector_of(stage.positions[pixel]) - from;
    const double receiver = -glm::dot(d, vector_of(stage.shadings[pixel]));
    const double emitter = glm::dot(d, vector_of(vpl.normal));
    if (!(receiver > 0.0) || !(emitter > 0.0) || !(d.z < 0.0)) return {};
    const double crossing = (0.5 - from.z) / d.z;
    if (crossing > 0.0 && crossing < 1.0 && from.x + crossing * d.x < 0.0) return {};
    const double square = glm::dot(d, d);
    const double g =
        std::min(static_cast<double>(vpl.position.w), emitter * receiver / (square * square));
    const double luminance = 0.2126 * static_cast<double>(vpl.flux.x) +
                             0.7152 * static_cast<double>(vpl.flux.y) +
                             0.0722 * static_cast<double>(vpl.flux.z);
    const double factor = luminance * static_cast<double>(scale);
    return {g * factor, 1e-5 * factor * (g + (emitter + receiver) / (square * square))};
}

TEST(VplContribution, IsTheBoundedGeometryTermWhereNothingLiesBetween) {
    const Stage stage = make_stage();
    for (const TestBackend backend : test::backends()) {
        Executor& executor = test::shared_executor(backend);
        executor.build(std::vector{KernelId::vpl_contribution}, 0);
        const auto scene = executor.make_scene({stage.corners, stage.triangles, 1e-6F});
        GBuffer gbuffer;
        gbuffer.gb_ids = upload<kinds::SurfaceIds>(executor, stage.ids, "ids");
        gbuffer.gb_position = upload<kinds::SurfacePositions>(executor, stage.positions, "places");
        gbuffer.gb_normal = upload<kinds::SurfaceNormals>(executor, stage.normals, "normals");
        gbuffer.gb_shading =
            upload<kinds::SurfaceShadingNormals>(executor, stage.shadings, "shading normals");
        gbuffer.gb_albedo = upload<kinds::SurfaceAlbedo>(executor, stage.albedo, "albedo");
        gbuffer.gb_emission = upload<kinds::SurfaceEmission>(executor, stage.emission, "emission");
        const auto view_points =
            upload<kinds::SlotPixels>(executor, stage.view_points, "points of view");
        const auto vpls = upload<kinds::VirtualLights>(executor, stage.vpls, "VPLs");
        const auto counters =
            upload<kinds::RayCounters>(executor, std::vector<shared::RayCounter>(1), "counters");
        constexpr std::size_t count = std::size_t{sets} * walked * points;
        auto contributions = allocate<kinds::VplContributions>(executor, count, "contributions");
        shared::RenderParams params{};
        params.sampling.walked_per_set = walked;
        params.scene.extent = 1.0F;
        ASSERT_TRUE(run_kernel(executor, params,
                               kernels::vpl_contribution{.scene = *scene,
                                                         .surfaces = view(gbuffer),
                                                         .points = points,
                                                         .scale = scale,
                                                         .view_points = view_points,
                                                         .vpls = vpls,
                                                         .contributions = contributions,
                                                         .counters = counters},
                               sets * walked));
        const auto found = read_buffer(executor, contributions, count);
        std::uint32_t lit = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t vpl = i / points;
            const std::uint32_t pixel = stage.view_points[vpl / walked * points + i % points];
            const Expected expected = expected_contribution(stage, stage.vpls[vpl], pixel);
            EXPECT_NEAR(static_cast<double>(found[i]), expected.value, expected.rounding)
                << test::backend_name(backend) << " " << i;
            if (expected.value > 0.0) ++lit;
        }
        EXPECT_GT(lit, count / 10);
        EXPECT_LT(lit, count / 2);
        EXPECT_GT(read_buffer(executor, counters, 1).front().rays_low, lit);
    }
}

}  // namespace
}  // namespace weft::vpl_contribution_test
