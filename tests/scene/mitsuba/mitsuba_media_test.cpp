// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/testing/mitsuba_folder.h"
#include "tests/testing/vol_bytes.h"

namespace weft::mitsuba_media_test {
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

/// A box of smoke whose density is grids/`file`.
std::string smoke(const std::string& file, const std::string& more = "") {
    return cube(
        "<bsdf type=\"null\"/><medium name=\"interior\" type=\"heterogeneous\">"
        "<volume name=\"sigma_t\" type=\"gridvolume\">"
        "<string name=\"filename\" value=\"grids/" +
        file + "\"/><transform name=\"to_world\"><scale x=\"4\"/><translate x=\"2\"/></transform>" +
        more +
        "</volume>"
        "<volume name=\"albedo\" type=\"constvolume\"><rgb name=\"value\" value=\"0.9\"/></volume>"
        "<float name=\"scale\" value=\"10\"/>"
        "<phase type=\"hg\"><float name=\"g\" value=\"0.4\"/></phase></medium>");
}

TEST(MitsubaMedia, HeterogeneousMediaHaveGrids) {
    MitsubaFolder folder;
    folder.folder().write("grids/smoke.vol",
                          vol_file({2, 1, 3}, {0, 1, 2, 3, 4, 5}, {1, 2, 3, 2, 4, 6}));
    const Scene scene = folder.read(smoke("smoke.vol") + smoke("smoke.vol"));
    const Medium& medium = scene.media.at(0);
    EXPECT_EQ(medium.type, "heterogeneous");
    EXPECT_EQ(medium.sigma_t, glm::vec3(1.0F));
    EXPECT_EQ(medium.albedo, glm::vec3(0.9F));
    EXPECT_EQ(medium.scale, 10.0F);
    EXPECT_EQ(medium.anisotropy, 0.4F);
    // Read once for both media.
    ASSERT_EQ(scene.grids.size(), 1U);
    EXPECT_EQ(medium.grid, 0);
    EXPECT_EQ(scene.media.at(1).grid, 0);
    EXPECT_EQ(scene.grids[0].size, (GridSize{2, 1, 3}));
    EXPECT_EQ(scene.grids[0].densities, (std::vector<float>{0, 1, 2, 3, 4, 5}));
    // The unit cube is placed, whatever the file's box is.
    EXPECT_EQ(medium.grid_to_world[0][0], 4.0);
    EXPECT_EQ(medium.grid_to_world[3][0], 2.0);
    EXPECT_TRUE(folder.warnings().empty());
}

TEST(MitsubaMedia, GridsMayKeepTheirBox) {
    MitsubaFolder folder;
    folder.folder().write("grids/smoke.vol", vol_file({1, 1, 1}, {1}, {1, 2, 3, 2, 4, 6}));
    const Scene scene = folder.read(smoke("smoke.vol",
                                          "<boolean name=\"use_grid_bbox\" value=\"true\"/>"
                                          "<string name=\"filter_type\" value=\"nearest\"/>\n"
                                          "<string name=\"wrap_mode\" value=\"repeat\"/>"));
    const glm::dmat4& placed = scene.media.at(0).grid_to_world;
    EXPECT_EQ(placed[0][0], 4.0);
    EXPECT_EQ(placed[1][1], 2.0);
    EXPECT_EQ(placed[2][2], 3.0);
    EXPECT_EQ(placed[3], glm::dvec4(6.0, 2.0, 3.0, 1.0));
    EXPECT_EQ(
        folder.warnings(),
        (Strings{"1 volume: filter_type is not supported, densities are trilinear; at s.xml:2",
                 "1 volume: wrap_mode is not supported, coordinates are clamped; at s.xml:2"}));
}

TEST(MitsubaMedia, RefusesBrokenGrids) {
    MitsubaFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    folder.folder().write("grids/nan.vol", vol_file({2, 1, 2}, {0, 1, 2, nan}));
    folder.folder().write("grids/huge.vol", vol_header({65535, 65535, 65535}));
    folder.folder().write("grids/short.vol", vol_file({2, 2, 2}, {1, 1, 1}));
    folder.folder().write("grids/two.vol", vol_header({1, 1, 1}, 2));
    folder.folder().write("grids/bright.vol", vol_file({1, 1, 1}, {1.5F}));
    folder.folder().write("grids/text.vol", "density");
    EXPECT_EQ(folder.error(smoke("none.vol")),
              "s.xml:2: file 'grids/none.vol' is missing, expected a grid volume");
    EXPECT_EQ(folder.error(smoke("nan.vol")),
              "grids/nan.vol: voxel (1, 0, 1) is nan, expected a finite density of at least 0");
    EXPECT_EQ(folder.error(smoke("huge.vol")).rfind("grids/huge.vol: a grid of 65535 x", 0), 0U);
    EXPECT_EQ(folder.error(smoke("short.vol")), "grids/short.vol: the file holds 3 of 8 voxels");
    EXPECT_EQ(folder.error(smoke("two.vol")),
              "grids/two.vol: a grid volume of 2 channels, expected 1 or 3");
    EXPECT_EQ(folder.error(smoke("text.vol")).rfind("grids/text.vol: not a density grid", 0), 0U);
    EXPECT_EQ(folder.error(smoke("../s.xml")).rfind("s.xml:2: reference ", 0), 0U);
    const auto albedo = [&](const std::string& type) {
        return folder.error(
            cube("<bsdf type=\"null\"/>\n<medium name=\"interior\" type=\"" + type +
                 "\"><volume name=\"sigma_t\" type=\"constvolume\"/>\n<volume name=\"albedo\" "
                 "type=\"gridvolume\"><string name=\"filename\" value=\"grids/bright.vol\"/>"
                 "</volume></medium>"));
    };
    EXPECT_EQ(albedo("homogeneous"),
              "s.xml:4: a grid for 'albedo', expected a constant: only the sigma_t and the albedo "
              "of heterogeneous media may vary");
    EXPECT_EQ(albedo("heterogeneous"), "s.xml:4: medium albedo above 1, expected 0 to 1");
}

TEST(MitsubaMedia, AlbedosAndColoursMayHaveGrids) {
    MitsubaFolder folder;
    folder.folder().write("grids/rgb.vol", vol_file({1, 1, 1}, {1, 2, 3}, {0, 0, 0, 1, 1, 1}, 3));
    folder.folder().write("grids/white.vol", vol_file({1, 1, 2}, {1, 0.5F}));
    const Scene scene = folder.read(
        cube("<bsdf type=\"null\"/><medium name=\"interior\" type=\"heterogeneous\">"
             "<volume name=\"sigma_t\" type=\"gridvolume\"><string name=\"filename\" "
             "value=\"grids/rgb.vol\"/></volume><volume name=\"albedo\" type=\"gridvolume\">"
             "<string name=\"filename\" value=\"grids/white.vol\"/><transform name=\"to_world\">"
             "<scale value=\"3\"/></transform></volume></medium>"));
    EXPECT_TRUE(folder.warnings().empty());
    const Medium& medium = scene.media.at(0);
    ASSERT_EQ(scene.grids.size(), 2U);
    EXPECT_EQ(scene.grids.at(static_cast<std::size_t>(medium.grid)).channels, 3U);
    EXPECT_EQ(scene.grids.at(static_cast<std::size_t>(medium.albedo_grid)).channels, 1U);
    EXPECT_EQ(medium.albedo_to_world[1][1], 3.0);
}

TEST(MitsubaMedia, MediaBehindOpaqueSurfacesAreNamed) {
    MitsubaFolder folder;
    const Scene scene = folder.read(cube("<medium name=\"interior\" type=\"homogeneous\"/>"));
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_TRUE(scene.medium_boundaries.empty());
    EXPECT_EQ(folder.warnings(),
              Strings{"1 shape: a medium behind an opaque surface is ignored; at s.xml:2"});
}

TEST(MitsubaMedia, GlassMayHoldAMedium) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        "<medium type=\"homogeneous\" id=\"milk\"/><shape type=\"cube\"/>"
        "<shape type=\"sphere\"><bsdf type=\"dielectric\"/><ref name=\"interior\" id=\"milk\"/>"
        "</shape>");
    EXPECT_TRUE(folder.warnings().empty());
    ASSERT_EQ(scene.instances.size(), 2U);
    ASSERT_EQ(scene.medium_boundaries.size(), 1U);
    EXPECT_EQ(scene.medium_boundaries[0].surface, 1);
    EXPECT_EQ(scene.medium_boundaries[0].interior, 0);
    EXPECT_EQ(scene.medium_boundaries[0].mesh, scene.instances[1].mesh);
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
}  // namespace weft::mitsuba_media_test
