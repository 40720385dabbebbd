// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "tests/testing/bvh_meshes.h"
#include "tests/testing/render_fixture.h"

// One scene that needs every feature, rendered in every way that must not matter.
namespace weft::backend_agreement_test {
namespace {

using test::Rendering;
using test::TestBackend;

Texture checks(std::uint32_t edge, std::uint32_t seed) {
    Texture texture;
    texture.width = edge;
    texture.height = edge;
    test::Uniform uniform(seed);
    for (std::uint32_t i = 0; i < edge * edge; ++i)
        for (int k = 0; k < 4; ++k)
            texture.rgba.push_back(static_cast<std::uint8_t>(uniform(40.0F, 250.0F)));
    return texture;
}

void add_room(test::SceneBuilder& builder) {
    // Six walls one by one: textured floor, coloured sides, an open front when looked at.
    const std::uint32_t white = builder.material({0.7F, 0.7F, 0.7F});
    const std::uint32_t red = builder.material({0.6F, 0.1F, 0.1F});
    const std::uint32_t textured = builder.material({0.9F, 0.8F, 0.7F});
    builder.scene.textures.push_back(checks(8, 3));
    builder.scene.textures.push_back(checks(5, 4));
    builder.scene.textures.back().nearest = true;
    builder.scene.textures.back().srgb = false;
    set_albedo_texture(builder.scene.materials[textured], 0);
    Mesh floor = test::quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}, 3);
    for (glm::vec2& uv : floor.uvs) uv *= 2.7F;
    builder.add(std::move(floor), textured);
    builder.add(test::quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), red);
    Mesh back = test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 5);
    test::Uniform uniform(9);
    for (std::size_t i = 0; i < back.positions.size(); ++i)
        back.colours.emplace_back(uniform(0.2F, 1.0F), uniform(0.2F, 1.0F), uniform(0.2F, 1.0F));
    builder.add(std::move(back), white);
}

Scene everything_scene(bool environment) {
    test::SceneBuilder builder;
    add_room(builder);
    const std::uint32_t nearest = builder.material({0.8F, 0.9F, 0.6F});
    set_albedo_texture(builder.scene.materials[nearest], 1);
    const std::uint32_t one_sided = builder.material({0.5F, 0.5F, 0.9F});
    builder.scene.materials[one_sided].two_sided = false;
    const std::uint32_t area_light = builder.material({0.3F, 0.3F, 0.3F}, {12.0F, 10.0F, 8.0F});
    const std::uint32_t screen = builder.material({0.0F, 0.0F, 0.0F}, {0.5F, 1.0F, 2.0F});
    builder.scene.materials[screen].emission.both_sides = true;
    builder.scene.materials[screen].emission.texture = 0;

    Mesh ball = test::icosphere(2, false);
    ball.normals = ball.positions;
    ball.uvs.assign(ball.positions.size(), glm::vec2(0.0F));
    for (std::size_t i = 0; i < ball.uvs.size(); ++i)
        ball.uvs[i] = glm::vec2(ball.positions[i].x, ball.positions[i].y * 1.3F);
    builder.add(std::move(ball), nearest, test::placement(0.35, {-0.4, -0.64, -0.2}));
    builder.add(test::quad_mesh({0.2F, -0.9F, -0.5F}, {0.5F, 0.0F, 0.3F}, {0.0F, 0.9F, 0.1F}),
                one_sided);
    builder.add(test::quad_mesh({0.3F, -0.4F, 0.7F}, {-0.3F, 0.0F, 0.1F}, {0.1F, 0.5F, 0.0F}),
                one_sided);
    builder.add(test::quad_mesh({-0.3F, 0.98F, -0.3F}, {0.6F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.6F}),
                area_light);
    builder.add(test::quad_mesh({-0.9F, 0.1F, -0.8F}, {0.2F, 0.0F, 0.2F}, {0.0F, 0.3F, 0.0F}),
                screen);
    builder.light(LightType::point, {0.5, 0.4, 0.6}, {0.3F, 0.4F, 0.3F});
    PunctualLight& spot =
        builder.light(LightType::spot, {0.0, 0.9, 0.8}, {2.0F, 1.5F, 1.0F}, {0.1, -1.0, -0.6});
    spot.cos_inner = 0.95F;
    spot.cos_outer = 0.8F;
    builder.light(LightType::directional, {}, {0.5F, 0.5F, 0.7F}, {-0.7, -0.6, -0.2});
    if (environment) builder.scene.environment = Environment{{0.2F, 0.3F, 0.4F}};
    return builder.scene;
}

const FlatScene& everything(bool environment) {
    static const FlatScene with = flatten(everything_scene(true));
    static const FlatScene without = flatten(everything_scene(false));
    return environment ? with : without;
}

Camera camera() {
    return test::look_at({0.35, 0.1, 2.9}, {0.0, -0.05, 0.0}, 0.7);
}

// Neither edge is a multiple of the interleaving (3) or of a block of slots (16).
RenderSettings settings_of(Algorithm algorithm, std::uint32_t width = 97,
                           std::uint32_t height = 70) {
    RenderSettings settings = test::small_settings(algorithm, width, height);
    settings.seed = 5;
    settings.samples = 2;
    return settings;
}

Rendering render_everything(Executor& executor, const RenderSettings& settings,
                            bool environment = true, std::uint32_t frames = 2) {
    return test::render_flat(executor, everything(environment), camera(), settings, frames);
}

std::uint64_t rays_of(const Rendering& rendering) {
    std::uint64_t rays = 0;
    for (const FrameStats& frame : rendering.stats) rays += frame.rays;
    return rays;
}

constexpr Algorithm algorithms[] = {Algorithm::igi, Algorithm::ir, Algorithm::ic};

TEST(BackendAgreement, TheSceneShowsAllItShould) {
    const Rendering rendering =
        render_everything(test::shared_executor(TestBackend::own_bvh), settings_of(Algorithm::igi));
    test::expect_clean(rendering);
    constexpr std::uint32_t all = 255U | FEATURE_EMISSION_TEXTURES;
    EXPECT_EQ(everything(true).features & all, all);
    for (const char* layer : {"direct", "indirect", "emission", "albedo", "depth"})
        EXPECT_GT(test::mean_of(rendering.layer(layer)), 0.01) << layer;
}

TEST(BackendAgreement, OpenClEqualsTheNativeKernelsBitForBit) {
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    // One executor serves frames of either feature set in turn.
    for (const Algorithm algorithm : algorithms)
        for (const bool environment : {false, true}) {
            RenderSettings settings = settings_of(algorithm);
            // Fewer samples than lights ask for: they are chosen by power.
            if (!environment) settings.sampling.max_samples_per_set = 5;
            const Rendering native = render_everything(test::shared_executor(TestBackend::own_bvh),
                                                       settings, environment);
            const Rendering opencl = render_everything(test::shared_executor(TestBackend::opencl),
                                                       settings, environment);
            EXPECT_EQ(test::differing_values(native.image, opencl.image), 0U)
                << "environment " << environment;
            EXPECT_EQ(rays_of(native), rays_of(opencl));
        }
}

class BackendAgreementLanes : public testing::TestWithParam<TestBackend> {
  protected:
    void SetUp() override {
        if (GetParam() == TestBackend::opencl && !test::has_opencl())
            GTEST_SKIP() << "no OpenCL device";
    }
};

TEST_P(BackendAgreementLanes, EveryPacketWidthGivesTheSameBits) {
    const Rendering reference = render_everything(*test::make_executor(TestBackend::own_bvh, 1),
                                                  settings_of(Algorithm::igi));
    for (const std::uint32_t lanes : {1U, 4U, 8U, 16U}) {
        const auto executor = test::make_executor(GetParam(), lanes);
        ASSERT_EQ(executor->lanes(), lanes);
        for (const Algorithm algorithm : algorithms) {
            const Rendering rendering = render_everything(*executor, settings_of(algorithm));
            if (algorithm == Algorithm::igi) {
                EXPECT_EQ(test::differing_values(reference.image, rendering.image), 0U) << lanes;
                EXPECT_EQ(rays_of(reference), rays_of(rendering)) << lanes;
                continue;
            }
            const Rendering same = render_everything(test::shared_executor(TestBackend::own_bvh),
                                                     settings_of(algorithm));
            EXPECT_EQ(test::differing_values(same.image, rendering.image), 0U) << lanes;
        }
    }
}

TEST_P(BackendAgreementLanes, EveryTileSizeGivesTheSameBits) {
    Executor& executor = test::shared_executor(GetParam());
    for (const Algorithm algorithm : algorithms) {
        RenderSettings settings = settings_of(algorithm);
        const Rendering reference = render_everything(executor, settings);
        for (const std::uint32_t tile : {1U, 7U, 16U, 1000U}) {
            settings.tile = tile;
            EXPECT_EQ(test::differing_values(reference.image,
                                             render_everything(executor, settings).image),
                      0U)
                << "tile " << tile;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OwnTraversal, BackendAgreementLanes,
                         testing::Values(TestBackend::own_bvh, TestBackend::opencl),
                         [](const auto& tested) { return test::backend_name(tested.param); });

TEST(BackendAgreement, EmbreeGivesTheSameBitsForEveryPacketWidthAndTileSize) {
    const RenderSettings settings = settings_of(Algorithm::igi);
    const Rendering reference =
        render_everything(*test::make_executor(TestBackend::embree, 1), settings);
    for (const std::uint32_t lanes : {4U, 8U, 16U}) {
        const auto executor = test::make_executor(TestBackend::embree, lanes);
        RenderSettings other = settings;
        other.tile = 5 * lanes;
        EXPECT_EQ(
            test::differing_values(reference.image, render_everything(*executor, other).image), 0U)
            << lanes;
    }
}

TEST(BackendAgreement, ThreadsDoNotMatter) {
    for (const TestBackend backend : {TestBackend::own_bvh, TestBackend::embree}) {
        const RenderSettings settings = settings_of(Algorithm::igi);
        const Rendering one = render_everything(*test::make_executor(backend, 0, 1), settings);
        const Rendering two = render_everything(*test::make_executor(backend, 0, 2), settings);
        EXPECT_EQ(test::differing_values(one.image, two.image), 0U) << test::backend_name(backend);
    }
}

std::uint32_t ulps_between(float a, float b) {
    const auto x = std::bit_cast<std::uint32_t>(a);
    const auto y = std::bit_cast<std::uint32_t>(b);
    return x > y ? x - y : y - x;
}

TEST(BackendAgreement, EmbreeDiffersFromTheOwnTraversalByAlmostNothing) {
    // One frame through pixel centres, so that a pixel holds one hit. A pixel sees the same surface
    // where depth, albedo, normal and emission agree; depth may be off by 4 ulp.
    for (const Algorithm algorithm : algorithms) {
        RenderSettings settings = settings_of(algorithm, 641, 400);
        settings.samples = 1;
        settings.sampling.vpls_per_set = 16;
        const Rendering own =
            render_everything(test::shared_executor(TestBackend::own_bvh), settings, true, 1);
        const Rendering embree =
            render_everything(test::shared_executor(TestBackend::embree), settings, true, 1);
        std::size_t different = 0;
        const std::vector<float>& depth = own.layer("depth");
        for (std::size_t i = 0; i < depth.size(); ++i) {
            bool same = ulps_between(depth[i], embree.layer("depth")[i]) <= 4;
            for (const char* layer : {"albedo", "normal", "emission"})
                for (std::size_t c = 0; c < 3; ++c)
                    same = same && std::abs(own.layer(layer)[c * depth.size() + i] -
                                            embree.layer(layer)[c * depth.size() + i]) <= 1e-5F;
            different += same ? 0 : 1;
        }
        EXPECT_LE(different, depth.size() / 100'000);
        for (const Layer& layer : own.image.layers)
            EXPECT_LE(test::relative_mse(layer.values, embree.layer(layer.name)), 1e-5)
                << layer.name;
    }
}

TEST(BackendAgreement, SmallAndOddImagesAgree) {
    using Size = std::pair<std::uint32_t, std::uint32_t>;
    for (const Algorithm algorithm : algorithms)
        for (const auto& [width, height] :
             {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, Size{7, 5}, Size{3, 64}}) {
            SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
            const RenderSettings settings = settings_of(algorithm, width, height);
            const Rendering own =
                render_everything(test::shared_executor(TestBackend::own_bvh), settings);
            test::expect_clean(own);
            EXPECT_GT(test::mean_of(own.layer("")), 0.0);
            for (const TestBackend backend : test::backends()) {
                const Rendering other = render_everything(test::shared_executor(backend), settings);
                test::expect_clean(other);
                if (backend == TestBackend::opencl)
                    EXPECT_EQ(test::differing_values(own.image, other.image), 0U);
                else
                    EXPECT_LE(test::relative_mse(own.layer(""), other.layer("")), 1e-4);
            }
        }
}

TEST(BackendAgreement, APixelDoesNotDependOnTheImagesOthers) {
    // The left part of a wide image is the image of the same rays alone: `ir` uses all samples
    // at every pixel, so only the camera could tell them apart.
    RenderSettings whole = settings_of(Algorithm::ir, 64, 32);
    whole.samples = 1;
    Camera wide = camera();
    wide.fov_axis = FovAxis::y;
    RenderSettings half = whole;
    half.width = 32;
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const Rendering a = test::render_flat(executor, everything(true), wide, whole);
    const Rendering b = test::render_flat(executor, everything(true), wide, half);
    // The middle 32 columns of `a` see what `b` sees, up to the rounding of film coordinates.
    std::size_t different = 0;
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x)
            different += std::abs(a.at("", x + 16, y) - b.at("", x, y)) > 1e-4F ? 1 : 0;
    EXPECT_LE(different, 4U);
}

}  // namespace
}  // namespace weft::backend_agreement_test
