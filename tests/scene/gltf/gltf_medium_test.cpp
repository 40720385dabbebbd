// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_medium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/load/load_scene.h"
#include "tests/testing/gltf_builder.h"
#include "tests/testing/vol_bytes.h"

namespace weft::gltf_medium_test {
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

TEST(GltfMedium, MediaEmit) {
    GltfBuilder builder =
        triangle_of({{"WEFT_medium", {{"absorption", {1, 0, 0}}, {"emission", {2, 0.5, 0}}}}});
    builder.json["scenes"][0]["extensions"] = {{"WEFT_medium", {{"absorption", {1, 1, 1}}}}};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.media.size(), 2U);
    EXPECT_EQ(scene.media[0].emission, glm::vec3(2, 0.5F, 0));
    EXPECT_EQ(scene.media[0].sigma_t, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.media[1].emission, glm::vec3(0));
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
}

TEST(GltfMedium, NamesThePlaceOfWrongEmission) {
    const auto error = [](const Json& emission) {
        GltfBuilder builder = triangle_of({{"WEFT_medium", {{"emission", emission}}}});
        try {
            (void)builder.read();
        } catch (const Error& found) {
            EXPECT_EQ(found.code(), ExitCode::bad_input);
            const std::string text = found.what();
            return text.substr(text.find('#'));
        }
        return std::string("none");
    };
    const std::string medium = "#/materials/0/extensions/WEFT_medium";
    EXPECT_EQ(error({1, 2, -3}), medium + ": emission has the value -3, expected 0 to 1e+30");
    EXPECT_EQ(error({1e31, 2, 3}), medium + ": emission has the value 1e+31, expected 0 to 1e+30");
    EXPECT_EQ(error({1, "2", 3}), medium + "/emission/1: is of type string, expected a number");
    for (const Json& other :
         {Json{1, 2}, Json{1, 2, 3, 4}, Json(1), Json("much"), Json::object(), Json(nullptr)})
        EXPECT_EQ(error(other).rfind(medium + "/emission: ", 0), 0U) << other;
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

/// A medium of this density object, with a grid of one voxel beside it.
GltfBuilder smoke_of(const Json& density) {
    GltfBuilder builder =
        triangle_of({{"WEFT_medium", {{"scattering", {3, 1, 0}}, {"density", density}}}});
    builder.files["a b.vol"] = vol_file({1, 1, 2}, {2, 5}, {1, 2, 3, 2, 4, 6});
    return builder;
}

TEST(GltfMedium, MediaHaveGrids) {
    GltfBuilder builder = smoke_of({{"uri", "a%20b.vol"}});
    builder.json["scenes"][0]["extensions"] = {
        {"WEFT_medium",
         {{"absorption", {1, 1, 1}},
          {"density",
           {{"uri", "a b.vol"},
            {"box", {-1, -1, -1, 1, 3, 7}},
            {"matrix", {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}}}}}};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.grids.size(), 1U);
    EXPECT_EQ(scene.grids[0].densities, (std::vector<float>{2, 5}));
    ASSERT_EQ(scene.media.size(), 2U);
    const Medium& smoke = scene.media[0];
    EXPECT_EQ(smoke.type, "heterogeneous");
    EXPECT_EQ(smoke.sigma_t, glm::vec3(3, 1, 0));
    EXPECT_EQ(smoke.grid, 0);
    // Placed by the file's own box.
    EXPECT_EQ(smoke.grid_to_world * glm::dvec4(1, 1, 1, 1), glm::dvec4(2, 4, 6, 1));
    EXPECT_EQ(smoke.grid_to_world * glm::dvec4(0, 0, 0, 1), glm::dvec4(1, 2, 3, 1));
    // By a box and a matrix that exchanges x and y.
    EXPECT_EQ(scene.outer_medium, 1);
    EXPECT_EQ(scene.media[1].grid, 0);
    EXPECT_EQ(scene.media[1].grid_to_world * glm::dvec4(1, 1, 1, 1), glm::dvec4(8, 1, 7, 1));
    EXPECT_EQ(scene.media[1].grid_to_world * glm::dvec4(0, 0, 0, 1), glm::dvec4(4, -1, -1, 1));
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
}

TEST(GltfMedium, RefusesWrongGrids) {
    const auto error = [](const Json& density, const std::string& content = "") {
        GltfBuilder builder = smoke_of(density);
        if (!content.empty()) builder.files["a b.vol"] = content;
        try {
            (void)builder.read();
        } catch (const Error& found) {
            EXPECT_EQ(found.code(), ExitCode::bad_input);
            const std::string text = found.what();
            return text.substr(text.rfind('/', text.find(": ")) + 1);
        }
        return std::string("none");
    };
    EXPECT_NE(error(Json::object()).find("uri"), std::string::npos);
    EXPECT_EQ(error({{"uri", "none.vol"}}).rfind("uri: ", 0), 0U);
    EXPECT_EQ(error({{"uri", "../a b.vol"}}).rfind("uri: reference ", 0), 0U);
    EXPECT_EQ(error({{"uri", "a b.vol"}, {"box", {0, 0, 0, 1, 0, 1}}}),
              "box: reaches from 0 to 0 along y, expected increasing numbers");
    EXPECT_NE(error({{"uri", "a b.vol"}, {"box", {0, 0, 0, 1}}}), "none");
    EXPECT_EQ(
        error({{"uri", "a b.vol"}, {"matrix", {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}),
        "matrix: cannot be inverted, expected one that can");
    EXPECT_EQ(
        error({{"uri", "a b.vol"}, {"matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}),
        "matrix: is not affine, expected 0, 0, 0, 1 as its last row");
    EXPECT_EQ(error({{"uri", "a b.vol"}}, vol_file({1, 2, 1}, {1, -1})),
              "a b.vol: voxel (0, 1, 0) is -1, expected a finite density of at least 0");
    // A file without voxels is clear air.
    GltfBuilder empty = smoke_of({{"uri", "a b.vol"}});
    empty.files["a b.vol"] = vol_header({0, 1, 1});
    EXPECT_TRUE(empty.read().grids.at(0).densities.empty());
}

TEST(GltfMedium, ShippedScenesHoldMedia) {
    const auto medium_of = [](const std::string& file, std::size_t boundaries) {
        Diagnostics diagnostics;
        Scene scene = load_scene(WEFT_SOURCE_DIR "/scenes/" + file, diagnostics);
        EXPECT_TRUE(diagnostics.warnings().empty()) << file;
        EXPECT_EQ(scene.medium_boundaries.size(), boundaries) << file;
        EXPECT_EQ(scene.media.size(), 1U) << file;
        return scene;
    };
    const Scene fog = medium_of("cornell-box-fog.gltf", 1);
    EXPECT_EQ(fog.outer_medium, -1);
    EXPECT_FLOAT_EQ(fog.media.at(0).sigma_t.r, 1.8F);
    const Scene haze = medium_of("shafts.gltf", 1);
    EXPECT_EQ(haze.outer_medium, -1);
    const Scene smoke = medium_of("smoke.gltf", 0);
    EXPECT_EQ(smoke.outer_medium, 0);
    ASSERT_EQ(smoke.grids.size(), 1U);
    const std::vector<float>& densities = smoke.grids[0].densities;
    EXPECT_EQ(densities.size(), 48U * 72U * 48U);
    EXPECT_EQ(*std::min_element(densities.begin(), densities.end()), 0.0F);
    EXPECT_GT(*std::max_element(densities.begin(), densities.end()), 0.5F);
}

}  // namespace
}  // namespace weft::gltf_medium_test
