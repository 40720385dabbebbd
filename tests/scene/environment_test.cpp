// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.h"
#include "scene/light_exponent.h"
#include "scene/moving_scene.h"
#include "scene/validate_scene.h"
#include "tests/testing/environment_images.h"
#include "tests/testing/scene_builder.h"

// Scenes with an image of the environment, as the host validates, flattens and edits them. What
// kernels make of an image is tested in environment_image_test.cpp.
namespace weft::environment_test {
namespace {

using test::SceneBuilder;

constexpr double pi = std::numbers::pi;

Environment environment_of(EnvironmentImage image) {
    return {glm::vec3(2.0F), std::make_shared<const EnvironmentImage>(std::move(image))};
}

SceneBuilder floor_under(EnvironmentImage image) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                builder.material(glm::vec3(0.5F)));
    builder.scene.environment = environment_of(std::move(image));
    return builder;
}

TEST(EnvironmentOfScenes, AnImageIsTheLastLightThatPathsChoose) {
    SceneBuilder builder = floor_under(test::constant_image({3.0F, 3.0F, 3.0F}));
    builder.light(LightType::directional, {}, glm::vec3(1.0F));
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.lights.size(), 2U);
    EXPECT_EQ(flat.lights[1].kind, EMITTER_ENVIRONMENT);
    EXPECT_EQ(flat.environment, glm::vec3(2.0F));
    EXPECT_EQ(choice_lights(flat), 2U);
    EXPECT_EQ(flat.lights[1].choice_cumulative, 1.0F);
    EXPECT_GT(flat.lights[1].choice_probability, 0.5F);
    // 4 pi radiance 6 into the scene's disk, against the sun's irradiance of 1.
    const double total = 4.0 * pi * 6.0 + 1.0;
    EXPECT_NEAR(flat.lights[0].probability, 1.0 / total, 1e-6);
    EXPECT_EQ(
        flat.features & (FEATURE_ENVIRONMENT | FEATURE_IMAGE_ENVIRONMENT | FEATURE_LIGHT_TREE),
        FEATURE_ENVIRONMENT | FEATURE_IMAGE_ENVIRONMENT | FEATURE_LIGHT_TREE);
    // In the tree each is as bright as its irradiance: pi 6 and 1.
    ASSERT_EQ(flat.light_nodes.size(), 3U);
    const shared::LightNode& around = flat.light_nodes[flat.lights[1].node];
    const shared::LightNode& sun = flat.light_nodes[flat.lights[0].node];
    EXPECT_EQ(around.shape, LIGHT_ALL_AROUND);
    EXPECT_NEAR(sun.intensity / around.intensity, 1.0 / (6.0 * pi), 1e-6);
}

TEST(EnvironmentOfScenes, LightComesFromWhereTheImageIsBright) {
    // A sky of radiance 1 + y: its first moment is known, and its trend gives the irradiance of any
    // surface: pi (1 + 2/3 n.y).
    const EnvironmentImage image = test::image_of(128, 64, false, [](const glm::dvec3& d) {
        return glm::vec3(static_cast<float>(1.0 + d.y));
    });
    const glm::dmat3 upright{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    const FlatEnvironment flat = flatten_environment(image, upright);
    EXPECT_NEAR(flat.trend.z, 2.0 / 3.0, 2e-3);
    EXPECT_NEAR(std::hypot(flat.trend.x, flat.trend.y), 0.0, 1e-9);
    EXPECT_NEAR(flat.mean.x, 1.0, 1e-3);
}

TEST(EnvironmentOfScenes, WithoutAnImageNothingChanges) {
    SceneBuilder builder = floor_under(test::constant_image(glm::vec3(1.0F)));
    builder.scene.environment = Environment{glm::vec3(2.0F)};
    const FlatScene flat = flatten(builder.scene);
    EXPECT_FALSE(flat.environment_image.present());
    EXPECT_EQ(choice_lights(flat), 0U);
    EXPECT_EQ(flat.features & FEATURE_IMAGE_ENVIRONMENT, 0U);
}

TEST(EnvironmentOfScenes, ABlackImageIsNoLight) {
    const FlatScene flat = flatten(floor_under(test::constant_image(glm::vec3(0.0F))).scene);
    EXPECT_TRUE(flat.lights.empty());
    EXPECT_EQ(flat.features & (FEATURE_ENVIRONMENT | FEATURE_IMAGE_ENVIRONMENT), 0U);
    EXPECT_EQ(choice_lights(flat), 0U);
}

TEST(EnvironmentOfScenes, TheFilmHasRoomForTheBrightestTexel) {
    const FlatScene flat =
        flatten(floor_under(test::one_texel(64, 32, 5, 5, {0.0F, 0x1p20F, 0.0F})).scene);
    EXPECT_EQ(light_exponent(flat), 21);
}

std::string error_after(const std::function<void(EnvironmentImage&, Environment&)>& change) {
    EnvironmentImage image = test::constant_image(glm::vec3(1.0F));
    SceneBuilder builder = floor_under(image);
    change(image, *builder.scene.environment);
    builder.scene.environment->image = std::make_shared<const EnvironmentImage>(image);
    try {
        validate_scene(builder.scene);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(EnvironmentOfScenes, ImagesAreValidated) {
    const std::string place = "test scene: environment 'made up' ";
    EXPECT_EQ(error_after([](auto&, auto&) {}), "no error");
    EXPECT_EQ(error_after([](auto& image, auto&) { image.width = 0; }), place + "is empty");
    EXPECT_EQ(error_after([](auto& image, auto&) { image.radiance.pop_back(); }),
              place + "has the wrong number of values");
    EXPECT_EQ(error_after([](auto& image, auto&) { image.width = image.height = 1U << 16; }),
              place + "is larger than the limit");
    for (const float bad :
         {-1.0F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(error_after([&](auto& image, auto&) { image.radiance[7] = bad; }),
                  place + "has a radiance that is negative or not finite");
    EXPECT_EQ(error_after([](auto&, auto& environment) { environment.to_world[1][0] = 0.5; }),
              place + "is distorted, expected a rotation");
    EXPECT_EQ(error_after([](auto&, auto& environment) { environment.to_world[1][0] = NAN; }),
              place + "is distorted, expected a rotation");
    EXPECT_EQ(error_after([](auto&, auto& environment) { environment.radiance.x = -1.0F; }),
              "test scene: environment has a radiance that is negative or not finite");
}

TEST(EnvironmentOfScenes, EditsDimAnImageInPlaceAndChangeItAnew) {
    MovingScene moving(floor_under(test::sunny_sky()).scene, {}, 30.0);
    const float* const texels = moving.flat().environment_image.texels.data();
    EXPECT_TRUE(moving.edit(
        [](const SceneParts& parts) { parts.environment->radiance = glm::vec3(0.5F); }));
    EXPECT_EQ(moving.flat().environment, glm::vec3(0.5F));
    EXPECT_EQ(moving.flat().environment_image.texels.data(), texels);
    EXPECT_NE(moving.flat().features & FEATURE_IMAGE_ENVIRONMENT, 0U);
    // Another image, or the same one turned.
    EXPECT_FALSE(moving.edit([](const SceneParts& parts) {
        parts.environment = environment_of(test::constant_image(glm::vec3(1.0F)));
    }));
    EXPECT_EQ(moving.flat().environment_image.mean.x, 1.0);
    EXPECT_FALSE(moving.edit([](const SceneParts& parts) {
        parts.environment->to_world = glm::dmat3{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    }));
    EXPECT_EQ(moving.flat().environment_image.records[0].x_axis.z, -1.0F);
    EXPECT_FALSE(moving.edit([](const SceneParts& parts) { parts.environment->image = nullptr; }));
    EXPECT_EQ(moving.flat().features & FEATURE_IMAGE_ENVIRONMENT, 0U);
}

}  // namespace
}  // namespace weft::environment_test
