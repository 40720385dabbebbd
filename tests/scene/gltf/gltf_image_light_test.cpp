// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_image_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/testing/gltf_builder.h"

namespace weft::gltf_image_light_test {
namespace {

using Json = nlohmann::json;

// 1 x 1 pixels of (255, 128, 0, 255) and of (200, 100, 50, 10), and 2 x 1 pixels.
constexpr const char* plain =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP438DwHwAGgAJ/zxIJ8QAAAABJRU5ErkJggg"
    "==";
constexpr const char* bright =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mM4kWLEBQAEvwFp7TMTPAAAAABJRU5ErkJggg"
    "==";
constexpr const char* oblong =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAADklEQVR42mNgZGL+"
    "D8IABjsCC4gY2JMAAAAASUVORK5CYII"
    "=";

/// A triangle in the light of a cube: +x is bright, all else plain.
GltfBuilder builder_of(const Json& changes = Json::object()) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["images"] = {{{"uri", plain}}, {{"uri", bright}}, {{"uri", oblong}}};
    builder.json["extensionsUsed"] = {"EXT_lights_image_based"};
    Json light = {{"specularImageSize", 1}};
    light["specularImages"] = Json::array({Json::array({1, 0, 0, 0, 0, 0})});
    light.update(changes);
    builder.json["extensions"]["EXT_lights_image_based"]["lights"] = Json::array({light});
    builder.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return builder;
}

/// One level of a cube.
Json level(const std::vector<int>& images) {
    return {{"specularImages", Json::array({Json(images)})}};
}

TEST(GltfImageLight, DividesColoursByAlpha) {
    GltfBuilder builder = builder_of({{"intensity", 2.5}, {"name", "hall"}});
    const Scene scene = builder.read();
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
    ASSERT_TRUE(scene.environment && scene.environment->image);
    EXPECT_EQ(scene.environment->radiance, glm::vec3(2.5F));
    EXPECT_EQ(scene.environment->to_world, glm::dmat3(1.0));
    const EnvironmentImage& image = *scene.environment->image;
    EXPECT_EQ(image.name, "hall");
    ASSERT_EQ(image.width, 4u);
    ASSERT_EQ(image.height, 2u);
    float most = 0.0F;
    for (std::size_t i = 0; i < image.radiance.size(); i += 3)
        most = std::max(most, image.radiance[i]);
    EXPECT_GT(most, 5.0F);  // 200 / 10, mixed with what is beside it
    EXPECT_LE(most, 20.0F);
    EXPECT_FLOAT_EQ(image.radiance[3 * 4 + 1], 128.0F / 255.0F);  // the middle of -x, below
}

TEST(GltfImageLight, IsTurnedByItsRotation) {
    const double half = std::sqrt(0.5);
    const Scene scene = builder_of({{"rotation", {0.0, 2.0 * half, 0.0, 2.0 * half}}}).read();
    // A quarter about +y takes +x to -z.
    const glm::dvec3 turned = scene.environment->to_world * glm::dvec3(1.0, 0.0, 0.0);
    EXPECT_LT(glm::length(turned - glm::dvec3(0.0, 0.0, -1.0)), 1e-12);
}

TEST(GltfImageLight, LightsNothingUnlessTheSceneNamesIt) {
    GltfBuilder builder = builder_of();
    builder.json["scenes"][0].erase("extensions");
    EXPECT_FALSE(builder.read().environment.has_value());
}

TEST(GltfImageLight, RefusesWhatIsNoCube) {
    const auto says = [](const Json& changes, const char* text) {
        const std::string error = builder_of(changes).error();
        EXPECT_NE(error.find(text), std::string::npos) << error;
    };
    says({{"specularImages", Json::array()}}, "specularImages: is empty");
    says(level({0, 0, 0}), "specularImages/0: has 3 images, expected 6");
    says(level({0, 0, 0, 2, 0, 0}),
         "specularImages/0/3: is 2 x 1 pixels, expected square images of the same size");
    says(level({0, 0, 7, 0, 0, 0}), "specularImages/0/2");
    says({{"intensity", -1.0}}, "intensity: lies outside of 0 to 1e30");
    says({{"rotation", {0.0, 0.0, 0.0, 0.0}}}, "rotation: is zero");
}

}  // namespace
}  // namespace weft::gltf_image_light_test
