// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/testing/scene_builder.h"

namespace weft::flat_scene_test {
namespace {

using test::quad_mesh;
using test::room_mesh;
using test::SceneBuilder;

glm::dvec3 vertex(const FlatScene& flat, std::uint32_t index) {
    const shared::float4& p = flat.positions.at(index);
    return {p.x, p.y, p.z};
}

/// Sum over triangles of the signed volumes to the origin: above 0 for a closed surface whose
/// triangles are counter-clockwise seen from outside.
double signed_volume(const FlatScene& flat) {
    double sum = 0.0;
    for (const shared::Triangle& t : flat.triangles)
        sum += glm::dot(vertex(flat, t.v0), glm::cross(vertex(flat, t.v1), vertex(flat, t.v2)));
    return sum / 6.0;
}

/// The cube [-1,1]^3 with normals inwards, once, with shading normals that point inwards too.
Scene cube_scene(const glm::dmat4& to_world) {
    SceneBuilder builder;
    Mesh cube = room_mesh();
    cube.normals.resize(cube.positions.size());
    for (const auto& t : cube.triangles) {
        const glm::vec3 n = glm::normalize(glm::cross(cube.positions[t[1]] - cube.positions[t[0]],
                                                      cube.positions[t[2]] - cube.positions[t[0]]));
        for (const std::uint32_t i : t) cube.normals[i] = n;
    }
    builder.add(cube, builder.material(glm::vec3(0.5F)), to_world);
    return builder.scene;
}

/// Whether every shading normal points to the side of its triangle's geometric normal.
bool normals_agree(const FlatScene& flat) {
    for (const shared::Triangle& t : flat.triangles) {
        const glm::dvec3 a = vertex(flat, t.v0);
        const glm::dvec3 n = glm::cross(vertex(flat, t.v1) - a, vertex(flat, t.v2) - a);
        for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
            const glm::dvec3 shading(flat.normals.at(3 * v), flat.normals.at(3 * v + 1),
                                     flat.normals.at(3 * v + 2));
            if (!(glm::dot(n, shading) > 0.0)) return false;
        }
    }
    return true;
}

TEST(FlatScene, UnitsArePowersOfTwoAndBringTheLargestToOne) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> exponent(-8.0, 8.0);
    for (int i = 0; i < 200; ++i) {
        const double size = std::pow(10.0, exponent(random));
        const glm::dvec3 move(size * exponent(random), -size, 3.0 * size);
        const FlatScene flat = flatten(cube_scene(test::placement(size, move)));
        int power = 0;
        EXPECT_EQ(std::frexp(flat.units.scale, &power), 0.5) << size;
        EXPECT_NEAR(glm::length(flat.units.centre - move), 0.0, 1e-12 * size);
        EXPECT_GE(flat.extent, 1.0F - 1e-6F);
        EXPECT_LT(flat.extent, 2.0F + 1e-6F);
        EXPECT_NEAR(flat.radius, static_cast<double>(flat.extent) * std::sqrt(3.0) * 1.001, 1e-4);
    }
}

TEST(FlatScene, VerticesThatNoTriangleUsesCountForNothing) {
    // In units of so small a quad the stray vertex would be infinite.
    Mesh mesh = quad_mesh({0.0F, 0.0F, 0.0F}, {1e-30F, 0.0F, 0.0F}, {0.0F, 1e-30F, 0.0F});
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(glm::vec3(0.5F));
    builder.add(mesh, grey);
    const FlatScene alone = flatten(builder.scene);
    builder.scene.meshes[0].positions.emplace_back(1e30F, -1e30F, 1e30F);
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.positions.size(), alone.positions.size() + 1);
    for (const shared::float4& p : flat.positions)
        EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    EXPECT_EQ(flat.extent, alone.extent);
    EXPECT_EQ(flat.radius, alone.radius);
    EXPECT_EQ(flat.units.scale, alone.units.scale);
}

TEST(FlatScene, EmptySceneHasUnitsToo) {
    const FlatScene flat = flatten(Scene{});
    EXPECT_EQ(flat.units.scale, 1.0);
    EXPECT_EQ(flat.extent, 1.0F);
    EXPECT_EQ(flat.radius, 1.0F);
    EXPECT_EQ(flat.mean_reflectance, 0.0);
    EXPECT_TRUE(flat.triangles.empty() && flat.lights.empty());
    EXPECT_EQ(flat.features, 0u);
}

TEST(FlatScene, OnePointHasUnitsToo) {
    SceneBuilder builder;
    builder.add(quad_mesh({5.0F, 5.0F, 5.0F}, glm::vec3(0.0F), glm::vec3(0.0F)),
                builder.material(glm::vec3(0.5F)));
    const FlatScene flat = flatten(builder.scene);
    EXPECT_EQ(flat.units.scale, 1.0);
    EXPECT_EQ(flat.surface_area, 0.0);
    EXPECT_EQ(flat.mean_reflectance, 0.0);
}

TEST(FlatScene, MovingFarAwayChangesNoFloatByMoreThanOneUlp) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> inside(-3.0F, 3.0F);
    SceneBuilder builder;
    const std::uint32_t material = builder.material(glm::vec3(0.5F), glm::vec3(1.0F));
    for (int i = 0; i < 50; ++i) {
        const auto point = [&] {
            return glm::vec3(inside(random), inside(random), inside(random));
        };
        const glm::vec3 corner = point();
        const glm::vec3 u = point();
        builder.add(quad_mesh(corner, u, point()), material);
    }
    builder.light(LightType::point, {0.1, 0.2, 0.3}, glm::vec3(1.0F));
    const FlatScene here = flatten(builder.scene);
    Scene moved = builder.scene;
    const glm::dvec3 far(1e8, -1e8, 7e7);
    for (Instance& instance : moved.instances)
        instance.to_world = glm::translate(glm::dmat4(1.0), far) * instance.to_world;
    for (PunctualLight& light : moved.lights) light.position += far;
    const FlatScene there = flatten(moved);
    ASSERT_EQ(there.positions.size(), here.positions.size());
    EXPECT_EQ(there.units.scale, here.units.scale);
    // One step of floats as large as the scene's half extent, which is in [1, 2).
    constexpr double ulp = 0x1p-23;
    for (std::uint32_t i = 0; i < here.positions.size(); ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(vertex(there, i)[k], vertex(here, i)[k], ulp) << "vertex " << i;
    for (std::size_t l = 0; l < here.lights.size(); ++l) {
        EXPECT_NEAR(there.lights[l].position.x, here.lights[l].position.x, ulp);
        EXPECT_NEAR(there.lights[l].area, here.lights[l].area, 1e-5F * here.lights[l].area);
    }
}

TEST(FlatScene, ScalingByAPowerOfTwoChangesNoFloat) {
    const FlatScene small = flatten(cube_scene(test::placement(1.5, {0.25, 0.5, 0.0})));
    const FlatScene large = flatten(cube_scene(test::placement(1536.0, {256.0, 512.0, 0.0})));
    EXPECT_EQ(large.units.scale * 1024.0, small.units.scale);
    for (std::uint32_t i = 0; i < small.positions.size(); ++i)
        EXPECT_EQ(vertex(small, i), vertex(large, i));
    EXPECT_EQ(small.surface_area, large.surface_area);
}

TEST(FlatScene, MirroredInstancesKeepTheirOutside) {
    const FlatScene plain = flatten(cube_scene(glm::dmat4(1.0)));
    EXPECT_LT(signed_volume(plain), 0.0);
    EXPECT_TRUE(normals_agree(plain));
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 scale(1.0);
        scale[axis] = -2.0;
        const FlatScene mirrored = flatten(cube_scene(glm::scale(glm::dmat4(1.0), scale)));
        EXPECT_LT(signed_volume(mirrored), 0.0) << axis;
        EXPECT_TRUE(normals_agree(mirrored)) << axis;
    }
}

TEST(FlatScene, FlippedNormalsTurnBothSides) {
    for (const double x : {1.0, -1.0}) {
        Scene scene = cube_scene(glm::scale(glm::dmat4(1.0), glm::dvec3(x, 1.0, 1.0)));
        scene.instances[0].flip_normals = true;
        const FlatScene flat = flatten(scene);
        EXPECT_GT(signed_volume(flat), 0.0) << x;
        EXPECT_TRUE(normals_agree(flat)) << x;
    }
}

TEST(FlatScene, NormalsFollowTheInverseTranspose) {
    SceneBuilder builder;
    // The plane x + y = 0 with its normal, scaled along y: then its normal is (2, 1, 0).
    Mesh mesh = quad_mesh({1.0F, -1.0F, 0.0F}, {-2.0F, 2.0F, 0.0F}, {0.0F, 0.0F, 1.0F});
    mesh.normals.assign(mesh.positions.size(), glm::normalize(glm::vec3(1.0F, 1.0F, 0.0F)));
    glm::dmat4 scaling(1.0);
    scaling[1][1] = 2.0;
    builder.add(mesh, builder.material(glm::vec3(0.5F)), scaling);
    // A shear that keeps no right angle either.
    glm::dmat4 shear(1.0);
    shear[1][0] = 1.5;
    builder.add(mesh, 0, shear);
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.normals.size(), 3 * flat.positions.size());
    EXPECT_NEAR(flat.normals[0], 2.0 / std::sqrt(5.0), 1e-6);
    EXPECT_NEAR(flat.normals[1], 1.0 / std::sqrt(5.0), 1e-6);
    EXPECT_NEAR(flat.normals[2], 0.0, 1e-6);
    for (const shared::Triangle& t : flat.triangles) {
        const std::size_t n = 3 * std::size_t{t.v0};
        const glm::dvec3 normal(flat.normals[n], flat.normals[n + 1], flat.normals[n + 2]);
        EXPECT_NEAR(glm::length(normal), 1.0, 1e-6);
        const glm::dvec3 edge = glm::normalize(vertex(flat, t.v1) - vertex(flat, t.v0));
        EXPECT_NEAR(glm::dot(normal, edge), 0.0, 1e-6);
    }
}

TEST(FlatScene, AttributesAreFilledWhereOnlySomeMeshesHaveThem) {
    SceneBuilder builder;
    const std::uint32_t material = builder.material(glm::vec3(0.5F));
    Mesh coloured = quad_mesh(glm::vec3(0.0F), {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F});
    coloured.colours.assign(4, glm::vec3(0.25F));
    builder.add(coloured, material);
    builder.add(room_mesh(), material);
    const FlatScene flat = flatten(builder.scene);
    EXPECT_TRUE(flat.normals.empty());
    EXPECT_TRUE(flat.texture_coordinates.empty());
    ASSERT_EQ(flat.vertex_colours.size(), 3 * flat.positions.size());
    EXPECT_EQ(flat.vertex_colours.front(), 0.25F);
    EXPECT_EQ(flat.vertex_colours.back(), 1.0F);
    EXPECT_EQ(flat.features, static_cast<std::uint32_t>(FEATURE_VERTEX_COLOURS));
}

TEST(FlatScene, InstancesKnowTheirTriangles) {
    SceneBuilder builder;
    const std::uint32_t material = builder.material(glm::vec3(0.5F));
    builder.add(room_mesh(), material);
    builder.add(quad_mesh(glm::vec3(0.0F), {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}), material);
    Instance again = builder.scene.instances[1];
    again.to_world = test::placement(2.0, {1.0, 2.0, 3.0});
    builder.scene.instances.push_back(again);
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.instances.size(), 3u);
    EXPECT_EQ(flat.instances[0].first_triangle, 0u);
    EXPECT_EQ(flat.instances[1].first_triangle, 12u);
    EXPECT_EQ(flat.instances[2].first_triangle, 14u);
    EXPECT_EQ(flat.triangles.size(), 16u);
    for (std::uint32_t t = 0; t < flat.triangles.size(); ++t) {
        EXPECT_EQ(flat.triangles[t].instance, t < 12 ? 0u : t < 14 ? 1u : 2u);
        EXPECT_LT(std::max({flat.triangles[t].v0, flat.triangles[t].v1, flat.triangles[t].v2}),
                  flat.positions.size());
    }
}

/// A quad of area 1 with that material's factor, and one of area 3 that is black.
SceneBuilder reflecting(const glm::vec3& albedo) {
    SceneBuilder builder;
    builder.add(quad_mesh(glm::vec3(0.0F), {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}),
                builder.material(albedo));
    builder.add(quad_mesh(glm::vec3(0.0F), {0.0F, 3.0F, 0.0F}, {0.0F, 0.0F, 1.0F}),
                builder.material(glm::vec3(0.0F)));
    return builder;
}

TEST(FlatScene, MeanReflectanceIsWeightedByArea) {
    EXPECT_NEAR(flatten(reflecting(glm::vec3(0.8F)).scene).mean_reflectance, 0.2, 1e-6);
    EXPECT_NEAR(flatten(reflecting({1.0F, 0.0F, 0.0F}).scene).mean_reflectance, 0.2126 / 4.0, 1e-6);
    EXPECT_EQ(flatten(reflecting(glm::vec3(0.0F)).scene).mean_reflectance, 0.0);
}

TEST(FlatScene, MeanReflectanceSeesTextures) {
    SceneBuilder builder = reflecting(glm::vec3(1.0F));
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    // Linear bytes: 51/255 = 0.2 and 153/255 = 0.6.
    texture.rgba = {51, 51, 51, 255, 153, 153, 153, 255};
    texture.srgb = false;
    builder.scene.textures.push_back(texture);
    set_albedo_texture(builder.scene.materials[0], 0);
    const FlatScene linear = flatten(builder.scene);
    EXPECT_NEAR(linear.mean_reflectance, 0.4 / 4.0, 1e-6);
    EXPECT_TRUE((linear.features & FEATURE_TEXTURES) != 0);
    EXPECT_EQ(linear.texture_coordinates.size(), 2 * linear.positions.size());
    ASSERT_EQ(linear.textures.size(), 1u);
    EXPECT_EQ(linear.textures[0].width, 2u);
    EXPECT_EQ(linear.texels.at(1) & 255u, 153u);
    builder.scene.textures[0].srgb = true;
    // sRGB 0.2 is 0.0331 linear, 0.6 is 0.3185.
    EXPECT_NEAR(flatten(builder.scene).mean_reflectance, 0.5 * (0.033105 + 0.318547) / 4.0, 1e-5);
}

// 3 x 1 texels, then one: their mean.
TEST(FlatScene, TexelsHoldAlphaWhereItIsUsed) {
    SceneBuilder builder = reflecting(glm::vec3(1.0F));
    Texture texture;
    texture.width = 3;
    texture.height = 1;
    texture.rgba = {1, 2, 3, 0, 1, 2, 3, 30, 1, 2, 3, 90};
    texture.srgb = false;
    builder.scene.textures.push_back(texture);
    set_albedo_texture(builder.scene.materials[0], 0);
    const std::vector<std::uint32_t> opaque = flatten(builder.scene).texels;
    const std::uint32_t colour = 0x030201;
    EXPECT_EQ(opaque, std::vector<std::uint32_t>(4, colour));
    builder.scene.textures[0].has_alpha = true;
    const std::vector<std::uint32_t> texels = flatten(builder.scene).texels;
    ASSERT_EQ(texels.size(), 4U);
    const std::array<std::uint32_t, 4> alphas{0, 30, 90, 40};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(texels[i], colour | alphas[i] << 24) << i;
}

TEST(FlatScene, UnusedTexturesCallForNothing) {
    SceneBuilder builder = reflecting(glm::vec3(1.0F));
    builder.scene.textures.push_back({"unused", 1, 1, {1, 2, 3, 4}});
    const FlatScene flat = flatten(builder.scene);
    EXPECT_EQ(flat.features, 0u);
    EXPECT_TRUE(flat.texels.empty() && flat.texture_coordinates.empty());
}

}  // namespace
}  // namespace weft::flat_scene_test
