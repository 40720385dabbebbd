// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "selftest/placed_scene.h"
#include "tests/testing/render_fixture.h"

// Scenes at the edge of what a scene is, and one scene at every scale and place: every layer stays
// finite, and nothing has to be guarded.
namespace weft::degenerate_render_test {
namespace {

using test::isolated_dark_pixels;
using test::Placed;
using test::placed_scene;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr Algorithm algorithms[] = {Algorithm::igi, Algorithm::ir, Algorithm::ic, Algorithm::tic,
                                    Algorithm::irradiance_cache};

Camera plain_camera() {
    return test::look_at({0.3, 0.2, 3.0}, {0.0, 0.0, 0.0}, 0.8);
}

/// Renders on every backend with all of them, two frames each, and looks for what is not clean.
template <class Check>
void render_everywhere(const Scene& scene, const Camera& camera, const Check& check) {
    for (const TestBackend backend : test::backends())
        for (const Algorithm algorithm : algorithms) {
            SCOPED_TRACE(test::backend_name(backend));
            RenderSettings settings = test::small_settings(algorithm, 31, 22);
            settings.sampling.cache_rays = 16;
            const Rendering rendering = test::render(backend, scene, camera, settings, 2);
            test::expect_clean(rendering);
            check(rendering);
        }
}

void expect_black(const Rendering& rendering) {
    for (const char* layer : {"", "direct", "indirect", "emission"})
        for (const float value : rendering.layer(layer)) ASSERT_EQ(value, 0.0F) << layer;
}

double mean(const Rendering& rendering, const char* layer) {
    return test::mean_of(rendering.layer(layer));
}

TEST(DegenerateRender, EmptySceneIsBlack) {
    SceneBuilder builder;
    render_everywhere(builder.scene, plain_camera(), [](const Rendering& r) {
        expect_black(r);
        EXPECT_EQ(mean(r, "depth"), 0.0);
    });
    builder.light(LightType::point, {0, 0, 1}, glm::vec3(1.0F));
    builder.light(LightType::directional, {}, glm::vec3(1.0F));
    render_everywhere(builder.scene, plain_camera(), expect_black);
    builder.scene.environment = Environment{{0.5F, 0.25F, 2.0F}};
    render_everywhere(builder.scene, plain_camera(), [](const Rendering& r) {
        for (std::uint32_t x = 0; x < r.image.width; ++x)
            for (std::uint32_t c = 0; c < 3; ++c)
                EXPECT_EQ(r.at("", x, 5, c), (std::array{0.5F, 0.25F, 2.0F})[c]);
    });
}

TEST(DegenerateRender, ComponentsThatAreLeftOutAreBlackUnderEveryKindOfLight) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}),
                builder.material(glm::vec3(0.5F)));
    builder.add(test::icosphere(2, false), builder.material(glm::vec3(0.5F), glm::vec3(1.0F)),
                test::placement(0.5, {0.0, 1.0, 0.0}));
    builder.light(LightType::point, {1, 2, 1}, glm::vec3(1.0F));
    builder.light(LightType::directional, {}, glm::vec3(1.0F), {0.2, -1.0, 0.1});
    builder.scene.environment = Environment{{0.5F, 0.5F, 0.5F}};
    for (const TestBackend backend : test::backends())
        for (const bool direct : {false, true})
            for (const bool indirect : {false, true}) {
                RenderSettings settings = test::small_settings(Algorithm::igi, 31, 22);
                settings.direct = direct;
                settings.indirect = indirect;
                const Rendering rendering = test::render(
                    backend, builder.scene, test::look_at({0, 3, 6}, {0, 0.5, 0}, 0.8), settings);
                test::expect_clean(rendering);
                EXPECT_EQ(mean(rendering, "direct") > 0.0, direct);
                EXPECT_EQ(mean(rendering, "indirect") > 0.0, indirect);
                EXPECT_GT(mean(rendering, "emission"), 0.0);
            }
}

TEST(DegenerateRender, NoLightsAndLightsWithoutPower) {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.8F)));
    const auto see = [](const Rendering& r) {
        expect_black(r);
        EXPECT_GT(mean(r, "albedo"), 0.1);
    };
    const Camera camera = test::look_at({0.0, 0.0, 0.9}, {0.0, 0.0, 0.0}, 1.0);
    render_everywhere(builder.scene, camera, see);
    builder.light(LightType::point, {0, 0, 0}, glm::vec3(0.0F));
    builder.light(LightType::directional, {}, glm::vec3(0.0F));
    builder.scene.environment = Environment{glm::vec3(0.0F)};
    builder.add(test::quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}),
                builder.material(glm::vec3(0.5F), glm::vec3(0.0F)));
    render_everywhere(builder.scene, camera, see);
}

TEST(DegenerateRender, AreaLightWithoutAreaAndTrianglesWithoutArea) {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.8F)));
    // A point, a line and a needle, all of them shining.
    Mesh needles;
    needles.positions = {{0, 0, 0},         {0, 0, 0},       {0, 0, 0},
                         {-0.5F, 0, 0},     {0, 0, 0},       {0.5F, 0, 0},
                         {-0.5F, 0.3F, 0},  {0.5F, 0.3F, 0}, {0.5F, 0.3F + 1e-7F, 0.0F},
                         {0.0F, 1e-30F, 0}, {1e-30F, 0, 0}};
    needles.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {0, 9, 10}, {3, 3, 5}};
    builder.add(std::move(needles), builder.material(glm::vec3(0.5F), glm::vec3(9.0F)));
    render_everywhere(builder.scene, test::look_at({0.0, 0.1, 0.9}, {0.0, 0.0, 0.0}, 1.0),
                      [](const Rendering& r) { EXPECT_GT(mean(r, "albedo"), 0.1); });
    SceneBuilder points;
    Mesh nothing;
    nothing.positions.assign(3, glm::vec3(0.25F));
    nothing.triangles = {{0, 1, 2}};
    points.add(std::move(nothing), points.material(glm::vec3(0.5F), glm::vec3(9.0F)));
    render_everywhere(points.scene, plain_camera(), expect_black);
}

TEST(DegenerateRender, CameraInsideGeometryOrOnASurface) {
    SceneBuilder builder;
    builder.add(test::icosphere(2, false), builder.material(glm::vec3(0.8F)));
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.7F)), test::placement(3.0, {}));
    builder.light(LightType::point, {0.1, 0.2, 0.0}, glm::vec3(2.0F));
    for (const glm::dvec3& at : {glm::dvec3(0.0, 0.0, 0.0), glm::dvec3(0.1, 0.2, 0.0),
                                 glm::dvec3(0.0, 0.0, 3.0), glm::dvec3(3.0, 3.0, 3.0)})
        render_everywhere(builder.scene, test::look_at(at, at + glm::dvec3(0.3, 0.1, -1.0), 1.0),
                          [](const Rendering& r) { EXPECT_GT(mean(r, "albedo"), 0.0); });
    // A one-sided ball from within is black, and hides what is behind it.
    builder.scene.materials[0].two_sided = false;
    render_everywhere(builder.scene, test::look_at({0, 0, 0}, {0, 0, -1}, 1.0),
                      [](const Rendering& r) {
                          expect_black(r);
                          EXPECT_GT(mean(r, "depth"), 0.5);
                      });
}

TEST(DegenerateRender, BlackWallsReflectNothing) {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.0F)));
    builder.add(test::quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    render_everywhere(builder.scene, test::look_at({0.0, 0.0, 0.95}, {0.0, 0.2, 0.0}, 1.4),
                      [](const Rendering& r) {
                          EXPECT_EQ(mean(r, "direct"), 0.0);
                          EXPECT_EQ(mean(r, "indirect"), 0.0);
                          EXPECT_GT(mean(r, "emission"), 0.0);
                      });
}

TEST(DegenerateRender, WhiteClosedBoxStaysFiniteAndKeepsItsOrdersOfLight) {
    // A closed box of albedo 1 around a light: every order of light carries the whole flux, so over
    // the whole wall the indirect irradiance of 4 bounces is 4 times the direct one, which is 4 pi
    // I over the area. Seen from the centre in all six directions, weighted by solid angle.
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(1.0F)));
    builder.light(LightType::point, {0.0, 0.0, 0.0}, glm::vec3(1.0F));
    const Camera camera = test::look_at({0, 0, 0}, {0, 0, -1}, std::numbers::pi / 2.0);
    for (const TestBackend backend : test::backends()) {
        RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, 36, 36));
        settings.sampling.bounces = 4;
        settings.sampling.vpl_tail = false;
        const Rendering rendering = test::render(backend, builder.scene, camera, settings, 24);
        test::expect_clean(rendering);
        // Square pixels on the wall z = -1 cover equal areas, and all walls are alike.
        double direct = 0.0;
        double indirect = 0.0;
        for (std::uint32_t y = 0; y < 36; ++y)
            for (std::uint32_t x = 0; x < 36; ++x) {
                direct += rendering.irradiance("direct", x, y) / (36.0 * 36.0);
                indirect += rendering.irradiance("indirect", x, y) / (36.0 * 36.0);
            }
        const double expected = 4.0 * std::numbers::pi / 24.0;
        EXPECT_NEAR(direct, expected, 2e-3 * expected);
        // The walls' VPLs are stratified, but shared by all pixels: 24 frames of 576 leave about
        // one per cent.
        EXPECT_NEAR(indirect, 4.0 * expected, 0.03 * 4.0 * expected);
    }
}

TEST(DegenerateRender, ScaleAndPlaceDoNotChangeTheImage) {
    const glm::dvec3 far_away(1e5, 1e3, -2e5);
    for (const TestBackend backend : test::backends()) {
        const RenderSettings settings = test::small_settings(Algorithm::igi, 121, 90);
        const Placed base = placed_scene(1.0, {});
        const Rendering reference = test::render(backend, base.scene, base.camera, settings);
        test::expect_clean(reference);
        EXPECT_GT(mean(reference, "direct"), 0.01);
        EXPECT_GT(mean(reference, "indirect"), 0.01);
        for (const double scale : {1e-4, 1e-3, 0.7, 1.0, 1e3, 1e4})
            for (const glm::dvec3& move : {glm::dvec3(0.0), far_away}) {
                SCOPED_TRACE(std::string(test::backend_name(backend)) + " scale " +
                             std::to_string(scale) + " moved " + std::to_string(move.x));
                const Placed placed = placed_scene(scale, move);
                const Rendering rendering =
                    test::render(backend, placed.scene, placed.camera, settings);
                test::expect_clean(rendering);
                for (const char* layer : {"", "direct", "indirect", "emission", "albedo"})
                    EXPECT_LT(test::relative_mse(reference.layer(layer), rendering.layer(layer)),
                              1e-4)
                        << layer;
                EXPECT_EQ(isolated_dark_pixels(reference, rendering), 0U);
                std::vector<float> depth = rendering.layer("depth");
                for (float& value : depth) value /= static_cast<float>(scale);
                EXPECT_LT(test::relative_mse(reference.layer("depth"), depth), 1e-6);
            }
    }
}

TEST(DegenerateRender, HugeAndTinyCoordinates) {
    for (const double scale : {1e-30, 1e-18, 1e-9, 1e9, 1e14})
        for (const TestBackend backend : test::backends()) {
            SCOPED_TRACE(std::string(test::backend_name(backend)) + ' ' + std::to_string(scale));
            const Placed placed = placed_scene(scale, {});
            const Rendering rendering = test::render(backend, placed.scene, placed.camera,
                                                     test::small_settings(Algorithm::igi, 31, 22));
            test::expect_clean(rendering);
            EXPECT_GT(mean(rendering, "albedo"), 0.05);
        }
    // Huge and tiny in one scene: a grain of 1e-6 on a floor of 1e6.
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1e6F, 0, 1e6F}, {2e6F, 0, 0}, {0, 0, -2e6F}),
                builder.material(glm::vec3(0.5F)));
    builder.add(test::icosphere(2, false), builder.material(glm::vec3(0.9F)),
                test::placement(1e-6, {0.0, 1e-6, 0.0}));
    builder.light(LightType::directional, {}, glm::vec3(1.0F), {0.2, -1.0, 0.1});
    builder.light(LightType::point, {0.0, 1.0, 0.0}, glm::vec3(1.0F));
    render_everywhere(builder.scene, test::look_at({0, 2, 5}, {0, 0, 0}, 0.8),
                      [](const Rendering& r) { EXPECT_GT(mean(r, "direct"), 0.05); });
}

TEST(DegenerateRender, LightsInImpossiblePlaces) {
    // On a vertex, in a face, on the camera, behind everything, on each other.
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.7F)));
    for (const glm::dvec3& at :
         {glm::dvec3(-1, -1, -1), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 0.9),
          glm::dvec3(50, 50, 50), glm::dvec3(0, 0, 0.9)}) {
        builder.light(LightType::point, at, glm::vec3(0.5F));
        builder.light(LightType::spot, at, glm::vec3(0.5F), {0.0, -1.0, 0.0}).cos_outer = -1.0F;
    }
    render_everywhere(builder.scene, test::look_at({0.0, 0.0, 0.9}, {0.0, 0.0, 0.0}, 1.0),
                      [](const Rendering& r) { EXPECT_GT(mean(r, "direct"), 0.01); });
}

TEST(DegenerateRender, CoincidentFacesAndAreaLightOnAWall) {
    // Two walls in one place of different colours, and an area light in the plane of the ceiling.
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.1F, 0.1F}));
    builder.add(test::room_mesh(), builder.material({0.1F, 0.7F, 0.1F}));
    builder.add(test::quad_mesh({-0.5F, 1.0F, -0.5F}, {1, 0, 0}, {0, 0, 1}),
                builder.material(glm::vec3(0.0F), glm::vec3(3.0F)));
    render_everywhere(builder.scene, test::look_at({0.0, 0.0, 0.9}, {0.0, 0.0, 0.0}, 1.0),
                      [](const Rendering& r) {
                          // The lower id wins everywhere: no speckle of the second colour.
                          for (std::uint32_t y = 0; y < r.image.height; ++y)
                              for (std::uint32_t x = 0; x < r.image.width; ++x)
                                  ASSERT_NEAR(r.at("albedo", x, y, 1), 0.1F, 1e-6F);
                          EXPECT_GT(mean(r, "direct"), 0.01);
                      });
}

}  // namespace
}  // namespace weft::degenerate_render_test
