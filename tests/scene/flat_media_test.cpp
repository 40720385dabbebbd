// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_media.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "scene/flat_scene.h"
#include "tests/testing/scene_builder.h"

namespace weft::flat_media_test {
namespace {

/// The cube [-1,1]^3 with normals outwards.
Mesh cube_mesh() {
    Mesh cube = test::room_mesh();
    for (auto& t : cube.triangles) std::swap(t[1], t[2]);
    return cube;
}

/// Media of extinction 1, 2, ...
Scene scene_of(int media) {
    Scene scene;
    scene.source = "s.xml";
    scene.meshes.push_back(cube_mesh());
    scene.meshes.push_back(test::room_mesh());
    for (int i = 0; i < media; ++i) {
        scene.media.emplace_back();
        scene.media.back().sigma_t = glm::vec3(static_cast<float>(i + 1));
    }
    return scene;
}

void place(Scene& scene, double size, const glm::dvec3& move, int interior, int exterior = -1,
           std::uint32_t mesh = 0) {
    scene.medium_boundaries.push_back({mesh, test::placement(size, move), interior, exterior});
}

TEST(FlatMedia, SurfacesThatAreBoundariesKnowWhichAndMayBeEmptied) {
    Scene scene = scene_of(2);
    scene.materials.emplace_back();
    place(scene, 2.0, {0, 0, 0}, 0);
    place(scene, 1.0, {0, 0, 0}, 1);
    scene.instances.push_back({"glass", 0, 0, test::placement(2.0, {0, 0, 0})});
    scene.medium_boundaries[0].surface = 0;
    const FlatMedia media = flatten_media(scene, {});
    ASSERT_EQ(media.surfaces.size(), 1U);
    EXPECT_EQ(media.surfaces[0].instance, 0U);
    EXPECT_EQ(media.surfaces[0].number, 1U) << "the larger one";
    EXPECT_FALSE(media.surfaces[0].inwards);
    empty_surfaces(scene);
    ASSERT_EQ(scene.medium_boundaries.size(), 1U);
    EXPECT_EQ(scene.medium_boundaries[0].interior, 1);
}

TEST(FlatMedia, NothingWhereMediaAreClearOrUnused) {
    Scene scene = scene_of(1);
    EXPECT_FALSE(flatten(scene).media.present());
    place(scene, 1.0, {0, 0, 0}, 0);
    EXPECT_TRUE(flatten(scene).media.present());
    scene.media[0].scale = 0.0F;
    EXPECT_FALSE(flatten(scene).media.present());
    scene.media[0].scale = 1.0F;
    // A grid without voxels, one of voxels of 0, and one of others.
    scene.media[0].grid = 0;
    scene.grids.emplace_back();
    EXPECT_FALSE(flatten(scene).media.present());
    scene.grids[0].size = {1, 1, 2};
    scene.grids[0].densities = {0.0F, 0.0F};
    EXPECT_FALSE(flatten(scene).media.present());
    scene.grids[0].densities = {0.0F, 1e-30F};
    EXPECT_TRUE(flatten(scene).media.present());
}

TEST(FlatMedia, ExtinctionIsPerKernelUnit) {
    Scene scene = scene_of(1);
    scene.media[0].scale = 3.0F;
    place(scene, 100.0, {1e6, 0, 0}, 0);
    const FlatScene flat = flatten(scene);
    ASSERT_TRUE(flat.media.present());
    EXPECT_EQ(flat.units.scale, 0x1p-6);
    EXPECT_EQ(flat.media.records[0].sigma_t.x, 3.0F * 64.0F);
    EXPECT_EQ(flat.media.records[0].albedo.x, 0.75F);
    // An extinction beyond floats stays one.
    scene.media[0].sigma_t = glm::vec3(3e38F);
    scene.media[0].scale = 1.0F;
    EXPECT_TRUE(std::isfinite(flatten(scene).media.records[0].sigma_t.x));
}

TEST(FlatMedia, EmissionIsPerKernelUnit) {
    Scene scene = scene_of(1);
    place(scene, 100.0, {1e6, 0, 0}, 0);
    scene.media[0].sigma_t = glm::vec3(0.0F);
    EXPECT_FALSE(flatten(scene).media.present());
    scene.media[0].emission = {0.0F, 3.0F, 0.0F};
    scene.media[0].scale = 0.0F;
    FlatMedia media = flatten(scene).media;
    ASSERT_TRUE(media.present());
    EXPECT_EQ(media.records[0].emission.y, 3.0F * 64.0F);
    // From one face to the other.
    EXPECT_GE(media.radiance, 3.0 * 200.0);
    EXPECT_LE(media.radiance, 4.0 * 3.0 * 200.0);
    // For the greatest density; a grid of zeros is nothing.
    scene.media[0].grid = 0;
    scene.grids.push_back({{1, 1, 2}, {0.5F, 4.0F}});
    const FlatScene flat = flatten(scene);
    EXPECT_EQ(static_cast<double>(flat.media.records.at(0).emission.y) * flat.units.scale, 12.0);
    scene.grids[0].densities = {0.0F, 0.0F};
    EXPECT_FALSE(flatten(scene).media.present());
    // An extinction beyond floats takes nothing from the radiance of what is opaque.
    scene.media[0].grid = -1;
    scene.media[0].sigma_t = glm::vec3(3e38F);
    scene.media[0].scale = 1.0F;
    scene.media[0].emission = glm::vec3(6e37F);
    media = flatten(scene).media;
    EXPECT_FLOAT_EQ(media.records[0].emission.x / media.records[0].sigma_t.x, 0.2F);
    EXPECT_NEAR(media.radiance, 0.2, 1e-6);
}

TEST(FlatMedia, LightWithoutEndIsAnError) {
    const auto error = [](const Scene& scene) {
        try {
            (void)flatten(scene);
        } catch (const Error& found) {
            EXPECT_EQ(found.code(), ExitCode::bad_input);
            return std::string(found.what());
        }
        return std::string("none");
    };
    const std::string refused =
        "s.xml: medium 'glow' fills space without end and emits in a channel in which it has no "
        "extinction, expected a boundary, a grid or absorption";
    Scene scene = scene_of(2);
    scene.media[1].name = "glow";
    scene.media[1].sigma_t = {1.0F, 0.0F, 1.0F};
    scene.media[1].emission = {1.0F, 2.0F, 0.0F};
    place(scene, 1.0, {0, 0, 0}, 1);
    EXPECT_EQ(error(scene), "none");
    scene.outer_medium = 1;
    EXPECT_EQ(error(scene), refused);
    // Also where it follows from the camera's medium, or the largest boundary.
    scene.outer_medium = -1;
    scene.medium_boundaries.clear();
    scene.camera_medium = 1;
    EXPECT_EQ(error(scene), refused);
    scene.camera_medium = -1;
    place(scene, 1.0, {0, 0, 0}, 0, 1);
    EXPECT_EQ(error(scene), refused);
    // With an extinction, where it does not emit, and in a grid there is an end to it.
    scene.media[1].emission = {1.0F, 0.0F, 0.0F};
    EXPECT_EQ(error(scene), "none");
    scene.media[1].emission = glm::vec3(1.0F);
    scene.media[1].sigma_t = glm::vec3(0.1F);
    EXPECT_EQ(error(scene), "none");
    scene.media[1].sigma_t = glm::vec3(0.0F);
    scene.media[1].grid = 0;
    scene.grids.push_back({{1, 1, 1}, {1.0F}});
    EXPECT_EQ(error(scene), "none");
}

TEST(FlatMedia, SmallerBoundariesComeFirst) {
    Scene scene = scene_of(3);
    place(scene, 5.0, {0, 0, 0}, 0, 2);
    place(scene, 1.0, {0, 0, 0}, 1);
    place(scene, 2.0, {0, 0, 0}, -1);
    const FlatMedia media = flatten(scene).media;
    EXPECT_EQ(media.space.boundaries, 3U);
    EXPECT_EQ(media.space.interior[0], 1U);
    EXPECT_EQ(media.space.interior[1], NO_MEDIUM);
    EXPECT_EQ(media.space.interior[2], 0U);
    EXPECT_EQ(media.space.outside, 2U);
    const KernelUnits units = flatten(scene).units;
    const auto around = [&](const glm::dvec3& p) {
        return boundaries_around(media, units.point(p));
    };
    EXPECT_EQ(around({0.1, 0.2, 0.3}), 7U);
    EXPECT_EQ(around({1.5, 0.2, 0.3}), 6U);
    EXPECT_EQ(around({0.1, -4.9, 0.3}), 4U);
    EXPECT_EQ(around({0.1, -5.1, 0.3}), 0U);
    EXPECT_EQ(around({1e9, 1e9, 1e9}), 0U);
}

TEST(FlatMedia, NormalsThatPointInwardsSwapTheSides) {
    for (const std::uint32_t mesh : {0U, 1U})
        for (const double size : {1.0, -1.0}) {
            Scene scene = scene_of(2);
            place(scene, size, {3, 0, 0}, 0, 1, mesh);
            const FlatScene flat = flatten(scene);
            const bool inwards = mesh == 1;
            EXPECT_EQ(flat.media.space.interior[0], inwards ? 1U : 0U);
            EXPECT_EQ(flat.media.space.outside, inwards ? 0U : 1U);
            EXPECT_EQ(boundaries_around(flat.media, flat.units.point({3.1, 0, 0})), 1U);
            for (std::size_t i = 0; i < flat.media.triangles.size(); ++i) {
                const shared::float4& p = flat.media.positions[flat.media.triangles[i].v0];
                const shared::float4& n = flat.media.normals[i];
                EXPECT_GT(p.x * n.x + p.y * n.y + p.z * n.z, 0.0F);
                EXPECT_EQ(std::bit_cast<std::uint32_t>(n.w), 0U);
            }
        }
}

TEST(FlatMedia, WhatSurroundsEverything) {
    Scene scene = scene_of(3);
    scene.camera_medium = 1;
    EXPECT_EQ(flatten(scene).media.space.outside, 1U);  // no boundary at all
    place(scene, 1.0, {0, 0, 0}, 0, 2);
    scene.cameras.push_back(test::look_at({0, 0, 5}, {0, 0, 0}, 1.0));
    EXPECT_EQ(flatten(scene).media.space.outside, 1U);
    // Inside of a boundary the camera's medium is the boundary's business.
    scene.cameras[0] = test::look_at({0, 0, 0.5}, {0, 0, 0}, 1.0);
    EXPECT_EQ(flatten(scene).media.space.outside, 2U);
    scene.outer_medium = 0;
    EXPECT_EQ(flatten(scene).media.space.outside, 0U);
}

TEST(FlatMedia, TooManyBoundariesAreAnError) {
    Scene scene = scene_of(1);
    for (int i = 0; i < 33; ++i) place(scene, 1.0, {3.0 * i, 0, 0}, 0);
    try {
        (void)flatten(scene);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()), "s.xml: 33 boundaries of media, expected at most 32");
    }
}

}  // namespace
}  // namespace weft::flat_media_test
