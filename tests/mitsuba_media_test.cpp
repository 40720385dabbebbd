// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/mitsuba_folder.h"

namespace weft {
namespace {

using Strings = std::vector<std::string>;

std::string cube(const std::string& content) {
    return "<shape type=\"cube\">" + content + "</shape>";
}

TEST(MitsubaMedia, NullSurfacesAreInvisibleBoundaries) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        "<medium type=\"homogeneous\" id=\"fog\"><rgb name=\"albedo\" value=\"0.8\"/>"
        "<rgb name=\"sigma_t\" value=\"1,2,3\"/><float name=\"scale\" value=\"0.25\"/>"
        "<phase type=\"hg\"><float name=\"g\" value=\"0.3\"/></phase></medium>"
        "<sensor type=\"perspective\"><ref id=\"fog\"/></sensor>" +
        cube("<transform name=\"to_world\"><scale x=\"3\"/></transform><bsdf type=\"null\"/>"
             "<ref name=\"interior\" id=\"fog\"/>") +
        cube("<bsdf type=\"null\"/><boolean name=\"flip_normals\" value=\"true\"/>"
             "<ref name=\"interior\" id=\"fog\"/>") +
        cube("<bsdf type=\"null\"/>"));
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(scene.materials.empty());
    ASSERT_EQ(scene.media.size(), 1U);
    const Medium& fog = scene.media[0];
    EXPECT_EQ(fog.name, "fog");
    EXPECT_EQ(fog.type, "homogeneous");
    EXPECT_EQ(fog.sigma_t, glm::vec3(1, 2, 3));
    EXPECT_EQ(fog.albedo, glm::vec3(0.8F));
    EXPECT_EQ(fog.scale, 0.25F);
    EXPECT_EQ(fog.anisotropy, 0.3F);
    EXPECT_EQ(scene.camera_medium, 0);
    ASSERT_EQ(scene.medium_boundaries.size(), 2U);
    EXPECT_EQ(scene.medium_boundaries[0].interior, 0);
    EXPECT_EQ(scene.medium_boundaries[0].exterior, -1);
    EXPECT_EQ(scene.medium_boundaries[0].to_world[0][0], 3.0);
    EXPECT_EQ(scene.meshes.at(scene.medium_boundaries[0].mesh).triangles.size(), 12U);
    EXPECT_EQ(scene.medium_boundaries[1].interior, -1);
    EXPECT_EQ(scene.medium_boundaries[1].exterior, 0);
    EXPECT_TRUE(folder.warnings().empty());
}

TEST(MitsubaMedia, DefaultsMatchMitsuba) {
    MitsubaFolder folder;
    const Scene scene =
        folder.read(cube("<bsdf type=\"null\"/><medium name=\"exterior\" type=\"homogeneous\"/>"));
    EXPECT_EQ(scene.media.at(0).sigma_t, glm::vec3(1.0F));
    EXPECT_EQ(scene.media.at(0).albedo, glm::vec3(0.75F));
    EXPECT_EQ(scene.media.at(0).scale, 1.0F);
    EXPECT_EQ(scene.media.at(0).anisotropy, 0.0F);
    EXPECT_EQ(scene.medium_boundaries.at(0).exterior, 0);
    EXPECT_EQ(scene.camera_medium, -1);
}

TEST(MitsubaMedia, AbsorptionAndScatteringBecomeExtinctionAndAlbedo) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        cube("<bsdf type=\"null\"/><medium name=\"interior\" type=\"homogeneous\">"
             "<rgb name=\"sigma_a\" value=\"1,2,0\"/><rgb name=\"sigma_s\" value=\"3,0,0\"/>"
             "</medium>"));
    EXPECT_EQ(scene.media.at(0).sigma_t, glm::vec3(4, 2, 0));
    EXPECT_EQ(scene.media.at(0).albedo, glm::vec3(0.75F, 0, 0));
}

TEST(MitsubaMedia, HeterogeneousMediaKeepTheirGridFile) {
    MitsubaFolder folder;
    folder.folder().write("grids/smoke.vol", "VOL");
    const std::string medium =
        "<bsdf type=\"null\"/><medium name=\"interior\" type=\"heterogeneous\">"
        "<volume name=\"sigma_t\" type=\"gridvolume\">"
        "<string name=\"filename\" value=\"grids/FILE\"/><transform name=\"to_world\">"
        "<translate x=\"2\"/></transform></volume>"
        "<volume name=\"albedo\" type=\"constvolume\"><rgb name=\"value\" value=\"0.9\"/></volume>"
        "<float name=\"scale\" value=\"10\"/></medium>";
    const auto with = [&](const std::string& file) {
        std::string text = cube(medium);
        return text.replace(text.find("FILE"), 4, file);
    };
    const Scene scene = folder.read(with("smoke.vol"));
    const Medium& smoke = scene.media.at(0);
    EXPECT_EQ(smoke.type, "heterogeneous");
    EXPECT_TRUE(std::filesystem::equivalent(smoke.density_file,
                                            folder.folder().path() / "grids/smoke.vol"));
    EXPECT_TRUE(std::filesystem::path(smoke.density_file).is_absolute());
    EXPECT_EQ(smoke.grid_to_world[3][0], 2.0);
    EXPECT_EQ(smoke.albedo, glm::vec3(0.9F));
    EXPECT_EQ(smoke.scale, 10.0F);
    EXPECT_EQ(folder.warnings(),
              Strings{"s.xml:2: media with a density grid are read but not simulated"});
    const std::string missing = folder.error(with("none.vol"));
    EXPECT_EQ(missing.rfind("s.xml:2: file 'grids/none.vol' is missing", 0), 0U) << missing;
}

TEST(MitsubaMedia, MediaBehindOpaqueSurfacesAreNamed) {
    MitsubaFolder folder;
    const Scene scene = folder.read(cube("<medium name=\"interior\" type=\"homogeneous\"/>"));
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_TRUE(scene.medium_boundaries.empty());
    EXPECT_EQ(folder.warnings(), Strings{"s.xml:2: a medium behind an opaque surface is ignored"});
}

TEST(MitsubaMedia, RefusesWrongMedia) {
    MitsubaFolder folder;
    const auto error = [&](const std::string& medium) {
        return folder.error(cube("<bsdf type=\"null\"/>\n" + medium));
    };
    EXPECT_EQ(error("<medium name=\"interior\" type=\"fluffy\"/>"),
              "s.xml:3: medium 'fluffy', expected homogeneous or heterogeneous");
    EXPECT_EQ(error("<medium name=\"interior\" type=\"heterogeneous\"/>"),
              "s.xml:3: heterogeneous medium without a density, expected a <volume "
              "name=\"sigma_t\">");
    EXPECT_EQ(error("<medium name=\"interior\" type=\"homogeneous\">"
                    "<float name=\"albedo\" value=\"2\"/></medium>"),
              "s.xml:3: medium albedo above 1, expected 0 to 1");
    EXPECT_EQ(error("<medium name=\"interior\" type=\"homogeneous\">"
                    "<float name=\"scale\" value=\"-1\"/></medium>"),
              "s.xml:3: negative medium scale, expected a number from 0 on");
    EXPECT_EQ(error("<medium name=\"interior\" type=\"homogeneous\">"
                    "<phase type=\"hg\"><float name=\"g\" value=\"1\"/></phase></medium>"),
              "s.xml:3: g = 1, expected more than -1 and less than 1");
    EXPECT_EQ(error("<bsdf name=\"interior\" type=\"diffuse\"/>"),
              "s.xml:3: a <bsdf> where a <medium> is expected");
}

}  // namespace
}  // namespace weft
