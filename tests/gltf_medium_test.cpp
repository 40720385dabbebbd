// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_medium.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/gltf_builder.h"

namespace weft {
namespace {

using Json = nlohmann::json;

/// A triangle whose material has these extensions.
GltfBuilder triangle_of(const Json& extensions) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.primitive()["material"] = 0;
    builder.json["materials"] = {
        {{"name", "ink"}, {"extensions", extensions}},
    };
    return builder;
}

TEST(GltfMedium, MaterialsBecomeBoundaries) {
    GltfBuilder builder = triangle_of(
        {{"WEFT_medium",
          {{"scattering", {3, 1, 0}}, {"absorption", {1, 1, 0}}, {"anisotropy", 0.5}}}});
    builder.json["extensionsUsed"] = {"WEFT_medium"};
    const Scene scene = builder.read();
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(scene.materials.empty());
    ASSERT_EQ(scene.media.size(), 1U);
    EXPECT_EQ(scene.media[0].name, "ink");
    EXPECT_EQ(scene.media[0].sigma_t, glm::vec3(4, 2, 0));
    EXPECT_EQ(scene.media[0].albedo, glm::vec3(0.75F, 0.5F, 0));
    EXPECT_EQ(scene.media[0].anisotropy, 0.5F);
    ASSERT_EQ(scene.medium_boundaries.size(), 1U);
    EXPECT_EQ(scene.medium_boundaries[0].interior, 0);
    EXPECT_EQ(scene.medium_boundaries[0].exterior, -1);
    EXPECT_EQ(scene.outer_medium, -1);
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
}

TEST(GltfMedium, VolumesAddTheirAttenuation) {
    GltfBuilder builder =
        triangle_of({{"WEFT_medium", Json::object()},
                     {"KHR_materials_volume",
                      {{"attenuationDistance", 2}, {"attenuationColor", {1, 0.36787944117, 0}}}}});
    const Scene scene = builder.read();
    ASSERT_EQ(scene.media.size(), 1U);
    EXPECT_EQ(scene.media[0].sigma_t.r, 0.0F);
    EXPECT_NEAR(scene.media[0].sigma_t.g, 0.5F, 1e-6F);
    EXPECT_GT(scene.media[0].sigma_t.b, 30.0F);
    EXPECT_LT(scene.media[0].sigma_t.b, 40.0F);
    EXPECT_EQ(scene.media[0].albedo, glm::vec3(0));
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
}

TEST(GltfMedium, VolumesAloneStaySurfaces) {
    GltfBuilder builder = triangle_of({{"KHR_materials_volume", {{"attenuationDistance", 2}}}});
    const Scene scene = builder.read();
    EXPECT_TRUE(scene.media.empty());
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_FALSE(builder.diagnostics.warnings().empty());
}

TEST(GltfMedium, ScenesHaveFog) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["scenes"][0]["extensions"] = {{"WEFT_medium", {{"scattering", {1, 1, 1}}}}};
    const Scene scene = builder.read();
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.outer_medium, 0);
    ASSERT_EQ(scene.media.size(), 1U);
    EXPECT_EQ(scene.media[0].name, "fog");
    EXPECT_EQ(scene.media[0].sigma_t, glm::vec3(1));
    EXPECT_EQ(scene.media[0].albedo, glm::vec3(1));
}

TEST(GltfMedium, RefusesWrongValues) {
    const auto error = [](const Json& medium, const Json& volume = Json::object()) {
        GltfBuilder builder =
            triangle_of({{"WEFT_medium", medium}, {"KHR_materials_volume", volume}});
        try {
            (void)builder.read();
        } catch (const Error& found) {
            const std::string text = found.what();
            return text.substr(text.find(": ") + 2);
        }
        return std::string("none");
    };
    EXPECT_EQ(error({{"scattering", {1, -2, 1}}}),
              "scattering has the coefficient -2, expected 0 to 1e+30");
    EXPECT_EQ(error({{"absorption", {1, 1e31, 1}}}),
              "absorption has the coefficient 1e+31, expected 0 to 1e+30");
    EXPECT_EQ(error({{"anisotropy", -1}}),
              "anisotropy is -1, expected more than -1 and less than 1");
    EXPECT_EQ(error(Json::object(), {{"attenuationDistance", 0}}),
              "attenuationDistance is 0, expected more than 0");
    EXPECT_EQ(error(Json::object(), {{"attenuationDistance", 1}, {"attenuationColor", {1, 2, 1}}}),
              "attenuationColor has the value 2, expected 0 to 1");
    EXPECT_NE(error({{"scattering", {1, 1}}}), "none");
    EXPECT_NE(error({{"scattering", "much"}}), "none");
}

}  // namespace
}  // namespace weft
