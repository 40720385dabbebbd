// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/edge_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/testing/half_plane.h"
#include "tests/testing/render_fixture.h"

namespace weft::edge_samples_test {
namespace {

using test::coverage;
using test::eye;
using test::fov;
using test::front_camera;
using test::half_plane;
using test::Line;
using test::line_at;
using test::Rendering;
using test::TestBackend;

RenderSettings settings_of(Algorithm algorithm, std::uint32_t width = 96,
                           std::uint32_t height = 72) {
    RenderSettings settings = test::small_settings(algorithm, width, height);
    settings.seed = 3;
    settings.sampling.vpls_per_set = 16;
    return settings;
}

RenderSettings without_edges(RenderSettings settings) {
    settings.sampling.edge_samples = 0;
    return settings;
}

const StageStats* edge_stage(const Rendering& rendering) {
    for (const StageStats& stage : rendering.stats.front().stages)
        if (stage.stage == Stage::edge_samples) return &stage;
    return nullptr;
}

struct CoverageError {
    double mean = 0.0, rms = 0.0;  // over pixels that the line crosses
};

CoverageError coverage_error(const Rendering& rendering, const Line& line) {
    CoverageError error;
    double pixels = 0.0;
    for (std::uint32_t y = 0; y < rendering.image.height; ++y)
        for (std::uint32_t x = 0; x < rendering.image.width; ++x) {
            const double exact = coverage(line, x, y);
            const double found = static_cast<double>(rendering.at("emission", x, y));
            if (exact <= 1e-6 || exact >= 1.0 - 1e-6) {
                EXPECT_NEAR(found, exact, 1e-5) << x << ", " << y;
                continue;
            }
            error.mean += found - exact;
            error.rms += (found - exact) * (found - exact);
            pixels += 1.0;
        }
    error.mean /= pixels;
    error.rms = std::sqrt(error.rms / pixels);
    return error;
}

TEST(EdgeSamples, ListsThePixelsOfMasksTileByTile) {
    const TileGrid grid{20, 9};  // 3 x 2 tiles
    std::vector<TileMask> masks(6, 0);
    masks[1] = 1U | TileMask{1} << 63;
    masks[2] = TileMask{1} << 3;
    masks[5] = TileMask{1} << 1;
    EXPECT_EQ(pixels_of(grid, masks),
              (std::vector<std::uint32_t>{8, 7 * 20 + 15, 19, 8 * 20 + 17}));
}

TEST(EdgeSamples, ASlantedEdgeCoversWhatItShould) {
    const std::uint32_t width = 240;
    const std::uint32_t height = 180;
    for (const double degrees : {3.0, 20.0, 45.0, 71.0, 94.0, 213.0}) {
        SCOPED_TRACE(degrees);
        const Line line = line_at(degrees, width, height);
        test::SceneBuilder builder;
        builder.add(half_plane(line, 0.0, width, height),
                    builder.material({0, 0, 0}, {1.0F, 1.0F, 1.0F}));
        const RenderSettings settings = settings_of(Algorithm::amax, width, height);
        const CoverageError smooth = coverage_error(
            test::render(TestBackend::own_bvh, builder.scene, front_camera(), settings), line);
        const CoverageError jagged =
            coverage_error(test::render(TestBackend::own_bvh, builder.scene, front_camera(),
                                        without_edges(settings)),
                           line);
        // Steps of 1/5 leave 0.2 / sqrt(12) = 0.058 of an axis-parallel edge, and one sample 0.29.
        // Along rows of the lattice there are three steps, for half of the pixels.
        EXPECT_LT(std::abs(smooth.mean), 0.01);
        EXPECT_LT(smooth.rms, 0.11);
        EXPECT_GT(jagged.rms, 0.2);
    }
}

TEST(EdgeSamples, OtherPixelsKeepTheirBits) {
    const std::uint32_t width = 96;
    const std::uint32_t height = 72;
    const Line line = line_at(33.0, width, height);
    test::SceneBuilder builder;
    builder.add(half_plane(line, 0.0, width, height), builder.material({0.7F, 0.2F, 0.1F}));
    builder.add(test::quad_mesh({-100, -100, -1}, {200, 0, 0}, {0, 200, 0}),
                builder.material({0.2F, 0.5F, 0.6F}));
    builder.light(LightType::point, {1.0, 2.0, 3.0}, {9.0F, 9.0F, 9.0F});
    const RenderSettings settings = settings_of(Algorithm::amax, width, height);
    const Rendering with =
        test::render(TestBackend::own_bvh, builder.scene, front_camera(), settings);
    const Rendering without =
        test::render(TestBackend::own_bvh, builder.scene, front_camera(), without_edges(settings));
    std::size_t near_line = 0;
    std::size_t changed_there = 0;
    for (const Layer& layer : with.image.layers)
        for (std::size_t i = 0; i < layer.values.size(); ++i) {
            const std::size_t pixel = i % (std::size_t{width} * height);
            const glm::dvec2 centre(static_cast<double>(pixel % width) + 0.5,
                                    static_cast<double>(pixel / width) + 0.5);
            const bool same = layer.values[i] == without.layer(layer.name)[i];
            if (std::abs(line.distance(centre)) > 1.42) {
                EXPECT_TRUE(same) << layer.name << " at " << centre.x << ", " << centre.y;
            } else if (layer.name == "depth" && std::abs(line.distance(centre)) < 0.3) {
                ++near_line;
                changed_there += same ? 0 : 1;
            }
        }
    EXPECT_GT(near_line, 40U);
    EXPECT_EQ(changed_there, near_line);
    ASSERT_NE(edge_stage(with), nullptr);
    EXPECT_EQ(edge_stage(with)->misses, 0U);
    EXPECT_EQ(edge_stage(without), nullptr);
}

TEST(EdgeSamples, EverySampleTakesTheIrradianceOfItsOwnSurface) {
    // The front surface reflects red light, the back one green light. An area light at the camera
    // shines on all that is seen, I cos / d^2.
    const std::uint32_t width = 96;
    const std::uint32_t height = 72;
    const Line line = line_at(24.0, width, height);
    test::SceneBuilder builder;
    builder.add(half_plane(line, 0.0, width, height), builder.material({0.8F, 0.0F, 0.0F}));
    builder.add(test::quad_mesh({-100, -100, -4}, {200, 0, 0}, {0, 200, 0}),
                builder.material({0.0F, 0.8F, 0.0F}));
    builder.light(LightType::point, {0.0, 0.0, eye}, {50.0F, 50.0F, 50.0F});
    RenderSettings settings = settings_of(Algorithm::amax, width, height);
    settings.indirect = false;
    const Rendering rendering =
        test::render(TestBackend::own_bvh, builder.scene, front_camera(), settings);
    std::size_t mixed = 0;
    for (std::uint32_t y = 2; y < height - 2; ++y)
        for (std::uint32_t x = 2; x < width - 2; ++x) {
            if (std::abs(line.distance({x + 0.5, y + 0.5})) > 1.4) continue;
            const double slope = 2.0 * std::tan(0.5 * fov) / height;
            const double cosine =
                1.0 / std::sqrt(1.0 + std::pow((x + 0.5 - 0.5 * width) * slope, 2) +
                                std::pow((y + 0.5 - 0.5 * height) * slope, 2));
            const auto expect = [&](std::uint32_t channel, double distance) {
                if (rendering.at("albedo", x, y, channel) == 0.0F) return 0;
                const double exact = 50.0 * std::pow(cosine, 3) / (distance * distance);
                EXPECT_NEAR(rendering.irradiance("direct", x, y, channel), exact, 0.02 * exact);
                return 1;
            };
            mixed += expect(0, eye) + expect(1, eye + 4.0) == 2 ? 1 : 0;
        }
    EXPECT_GT(mixed, 60U);
}

TEST(EdgeSamples, TheSurroundingsCountWithTheirRadiance) {
    const std::uint32_t width = 60;
    const std::uint32_t height = 40;
    const Line line = line_at(60.0, width, height);
    test::SceneBuilder builder;
    builder.add(half_plane(line, 0.0, width, height), builder.material({0, 0, 0}, {3, 3, 3}));
    builder.scene.environment = Environment{{1.0F, 1.0F, 1.0F}};
    const Rendering rendering = test::render(TestBackend::own_bvh, builder.scene, front_camera(),
                                             settings_of(Algorithm::amax, width, height));
    double sum = 0.0;
    double exact = 0.0;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const double share = coverage(line, x, y);
            sum += static_cast<double>(rendering.at("emission", x, y));
            exact += 1.0 + 2.0 * share;
            EXPECT_NEAR(rendering.at("emission", x, y), 1.0 + 2.0 * share, 0.6);
        }
    EXPECT_NEAR(sum, exact, 1e-3 * exact);
}

TEST(EdgeSamples, ASceneWithoutEdgesTracesNothing) {
    test::SceneBuilder builder;
    builder.add(test::icosphere(3, true), builder.material({0.6F, 0.5F, 0.4F}));
    builder.light(LightType::point, {0.1, 0.2, 0.1}, {1.0F, 1.0F, 1.0F});
    for (const Algorithm algorithm : {Algorithm::amax, Algorithm::ais}) {
        const Rendering rendering =
            test::render(TestBackend::own_bvh, builder.scene,
                         test::look_at({0, 0, 0.3}, {0, 0, -1}, 1.5), settings_of(algorithm));
        EXPECT_GT(rendering.plan.edge_samples, 0U);
        EXPECT_EQ(edge_stage(rendering), nullptr);
    }
}

TEST(EdgeSamples, TextureMakesNoEdges) {
    test::SceneBuilder builder;
    const std::uint32_t checked = builder.material({1.0F, 1.0F, 1.0F});
    set_albedo_texture(builder.scene.materials[checked], 0);
    Texture texture;
    texture.width = 2;
    texture.height = 2;
    texture.nearest = true;
    for (const int value : {0, 240, 240, 0})
        for (int k = 0; k < 4; ++k) texture.rgba.push_back(static_cast<std::uint8_t>(value));
    builder.scene.textures.push_back(texture);
    // Two tiles of a floor side by side; the squares are some pixels large.
    for (const float left : {-60.0F, 0.0F}) {
        Mesh tile = test::quad_mesh({left, -60.0F, 0.0F}, {60, 0, 0}, {0, 120, 0});
        for (glm::vec2& uv : tile.uvs) uv *= glm::vec2(60.0F, 120.0F);
        builder.add(std::move(tile), checked);
    }
    builder.light(LightType::point, {0.0, 0.0, eye}, {9.0F, 9.0F, 9.0F});
    const Rendering rendering = test::render(TestBackend::own_bvh, builder.scene, front_camera(),
                                             settings_of(Algorithm::amax));
    const auto& albedo = rendering.layer("albedo");
    const auto [least, most] = std::minmax_element(albedo.begin(), albedo.end());
    EXPECT_EQ(*least, 0.0F);
    EXPECT_GT(*most, 0.5F);
    EXPECT_EQ(edge_stage(rendering), nullptr);
}

TEST(EdgeSamples, ColoursMakeEdgesOnAPlane) {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-60, -60, 0}, {60, 0, 0}, {0, 120, 0}),
                builder.material({0.8F, 0.1F, 0.1F}));
    builder.add(test::quad_mesh({0, -60, 0}, {60, 0, 0}, {0, 120, 0}),
                builder.material({0.1F, 0.1F, 0.8F}));
    const Rendering rendering = test::render(TestBackend::own_bvh, builder.scene, front_camera(),
                                             settings_of(Algorithm::amax));
    ASSERT_NE(edge_stage(rendering), nullptr);
    EXPECT_EQ(edge_stage(rendering)->rays, 2U * 72U * rendering.plan.edge_samples);
}

TEST(EdgeSamples, WhatNoPixelShowsIsCounted) {
    // A blade of a seventh of a pixel, turned away from the plane before which it stands, beside
    // the plane's border: it is seen only where a further ray meets it.
    const std::uint32_t width = 96;
    const std::uint32_t height = 72;
    const Line border{{48.0, 36.0}, {1.0, 0.0}};
    test::SceneBuilder builder;
    builder.add(half_plane(border, -0.5, width, height), builder.material({0.6F, 0.6F, 0.6F}));
    const auto pixel = static_cast<float>(2.0 * eye * std::tan(0.5 * fov) / height);
    builder.add(test::quad_mesh({0.25F * pixel, -10.0F, 0.0F}, {0.07F * pixel, 0.0F, 0.07F * pixel},
                                {0.0F, 20.0F, 0.0F}),
                builder.material({0.9F, 0.9F, 0.1F}));
    builder.light(LightType::point, {-2.0, 0.0, eye}, {30.0F, 30.0F, 30.0F});
    const Rendering rendering = test::render(TestBackend::own_bvh, builder.scene, front_camera(),
                                             settings_of(Algorithm::amax, width, height));
    test::expect_clean(rendering);
    ASSERT_NE(edge_stage(rendering), nullptr);
    EXPECT_GT(edge_stage(rendering)->misses, 0U);
    EXPECT_LT(edge_stage(rendering)->misses, edge_stage(rendering)->rays);
}

Scene furnished_room(bool environment) {
    test::SceneBuilder builder;
    const std::uint32_t white = builder.material({0.7F, 0.7F, 0.7F});
    const std::uint32_t red = builder.material({0.7F, 0.1F, 0.1F});
    const std::uint32_t one_sided = builder.material({0.2F, 0.3F, 0.8F});
    builder.scene.materials[one_sided].two_sided = false;
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}, 3), white);
    builder.add(test::quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), red);
    builder.add(test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), white);
    Mesh ball = test::icosphere(3, false);
    ball.normals = ball.positions;
    builder.add(std::move(ball), red, test::placement(0.4, {0.3, -0.5, 0.1}));
    builder.add(test::quad_mesh({-0.8F, -0.7F, -0.3F}, {0.6F, 0.1F, 0.3F}, {0.1F, 0.8F, 0.0F}),
                one_sided);
    for (int i = 0; i < 6; ++i)
        builder.add(test::quad_mesh({-0.9F + 0.31F * static_cast<float>(i), 0.1F, 0.5F},
                                    {0.04F, 0.0F, 0.02F}, {0.2F, 0.8F, 0.1F}),
                    i % 2 == 0 ? white : red);
    builder.add(test::quad_mesh({-0.3F, 0.97F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material({0.3F, 0.3F, 0.3F}, {7.0F, 6.0F, 5.0F}));
    builder.light(LightType::point, {0.5, 0.4, 0.8}, {0.3F, 0.4F, 0.3F});
    if (environment) builder.scene.environment = Environment{{0.2F, 0.3F, 0.4F}};
    return builder.scene;
}

Camera room_camera() {
    return test::look_at({0.2, 0.1, 3.4}, {0.05, 0.0, 0.0}, 0.7);
}

TEST(EdgeSamples, AllBackendsWidthsTilesAndThreadsGiveTheSameBits) {
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::amax}) {
        const Scene scene = furnished_room(true);
        RenderSettings settings = settings_of(algorithm, 70, 51);
        const auto render = [&](Executor& executor) {
            return test::render(executor, scene, room_camera(), settings);
        };
        const Rendering reference = render(*test::make_executor(TestBackend::own_bvh, 1, 1));
        test::expect_clean(reference);
        ASSERT_NE(edge_stage(reference), nullptr);
        const auto expect_same = [&](const Rendering& other, const char* what) {
            EXPECT_EQ(test::differing_values(reference.image, other.image), 0U) << what;
            ASSERT_NE(edge_stage(other), nullptr);
            EXPECT_EQ(edge_stage(other)->rays, edge_stage(reference)->rays) << what;
            EXPECT_EQ(edge_stage(other)->misses, edge_stage(reference)->misses) << what;
        };
        for (const std::uint32_t lanes : {4U, 8U, 16U})
            expect_same(render(*test::make_executor(TestBackend::own_bvh, lanes, 2)), "lanes");
        if (test::has_opencl())
            expect_same(render(test::shared_executor(TestBackend::opencl)), "OpenCL");
        settings.tile = 7;
        expect_same(render(test::shared_executor(TestBackend::own_bvh)), "tile");
    }
}

TEST(EdgeSamples, TheMeanIsKeptAndEdgesComeCloser) {
    const Scene scene = furnished_room(false);
    RenderSettings settings = settings_of(Algorithm::amax);
    const Rendering smooth = test::render(TestBackend::own_bvh, scene, room_camera(), settings);
    const Rendering jagged =
        test::render(TestBackend::own_bvh, scene, room_camera(), without_edges(settings));
    settings.samples = 64;
    const Rendering many = test::render(TestBackend::own_bvh, scene, room_camera(), settings, 64);
    EXPECT_EQ(edge_stage(many), nullptr);
    for (const char* layer : {"albedo", "emission", "direct"}) {
        SCOPED_TRACE(layer);
        const double mean = test::mean_of(many.layer(layer));
        EXPECT_NEAR(test::mean_of(smooth.layer(layer)), mean, 0.01 * mean);
        EXPECT_LT(test::relative_mse(many.layer(layer), smooth.layer(layer)),
                  0.4 * test::relative_mse(many.layer(layer), jagged.layer(layer)));
    }
}

TEST(EdgeSamples, OnlyAdaptiveAlgorithmsOfFewSamplesHaveThem) {
    const FlatScene scene = flatten(furnished_room(false));
    const auto has_kernels = [](const FramePlan& plan) {
        const auto kernels = kernels_of(plan);
        return std::ranges::count(kernels, KernelId::edge_masks) +
               std::ranges::count(kernels, KernelId::edge_samples);
    };
    for (const Algorithm algorithm :
         {Algorithm::ais, Algorithm::amax, Algorithm::igi, Algorithm::ir}) {
        const bool wanted = algorithm == Algorithm::ais || algorithm == Algorithm::amax;
        RenderSettings settings = settings_of(algorithm);
        settings.sampling.edge_samples = 5;
        EXPECT_EQ(plan_for(scene, settings).edge_samples, wanted ? 4U : 0U);
        EXPECT_EQ(has_kernels(plan_for(scene, settings)), wanted ? 2 : 0);
        settings.sampling.edge_samples = 1000;
        EXPECT_EQ(plan_for(scene, settings).edge_samples, wanted ? MAX_EDGE_SAMPLES : 0U);
        settings.samples = 16;
        EXPECT_EQ(plan_for(scene, settings).edge_samples, wanted ? MAX_EDGE_SAMPLES : 0U);
        settings.samples = 17;
        EXPECT_EQ(plan_for(scene, settings).edge_samples, 0U);
        EXPECT_EQ(has_kernels(plan_for(scene, settings)), 0);
    }
}

TEST(EdgeSamples, WithoutThemAmaxIsIgi) {
    const Scene scene = furnished_room(true);
    RenderSettings plain = without_edges(settings_of(Algorithm::amax));
    plain.sampling.candidates = 1;
    const Rendering amax = test::render(TestBackend::own_bvh, scene, room_camera(), plain);
    const Rendering igi =
        test::render(TestBackend::own_bvh, scene, room_camera(), settings_of(Algorithm::igi));
    EXPECT_EQ(test::differing_values(amax.image, igi.image), 0U);
}

TEST(EdgeSamples, SmallImagesAndHugeRadianceAreClean) {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-0.31F, -0.17F, 0.0F}, {0.4F, 0, 0}, {0.1F, 0.6F, 0}),
                builder.material({0, 0, 0}, {1e38F, 3e38F, 2e38F}));
    for (const std::uint32_t size : {1U, 2U, 3U, 9U}) {
        RenderSettings settings = settings_of(Algorithm::amax, size, 2 * size);
        settings.indirect = false;
        const Rendering rendering =
            test::render(TestBackend::own_bvh, builder.scene, front_camera(), settings);
        for (const float value : rendering.layer("emission")) EXPECT_TRUE(std::isfinite(value));
    }
}

}  // namespace
}  // namespace weft::edge_samples_test
