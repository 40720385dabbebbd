// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace weft::shapes_test {
namespace {

using Point = std::tuple<float, float, float>;

Point key(const glm::vec3& p) {
    return {p.x, p.y, p.z};
}

/// Undirected edges by position, with the number of times each direction is used.
std::map<std::pair<Point, Point>, int> edges_of(const Mesh& mesh) {
    std::map<std::pair<Point, Point>, int> edges;
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i)
            ++edges[{key(mesh.positions[triangle[i]]), key(mesh.positions[triangle[(i + 1) % 3]])}];
    }
    return edges;
}

bool is_closed(const Mesh& mesh) {
    const auto edges = edges_of(mesh);
    for (const auto& [edge, uses] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        if (uses != 1 || back == edges.end() || back->second != 1) return false;
    }
    return !edges.empty();
}

glm::dvec3 area_vector(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const glm::dvec3 a(mesh.positions[triangle[0]]);
    return 0.5 * glm::cross(glm::dvec3(mesh.positions[triangle[1]]) - a,
                            glm::dvec3(mesh.positions[triangle[2]]) - a);
}

double area(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& triangle : mesh.triangles) sum += glm::length(area_vector(mesh, triangle));
    return sum;
}

/// By the divergence theorem; positive when triangles face outwards.
double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& triangle : mesh.triangles)
        sum += glm::dot(glm::dvec3(mesh.positions[triangle[0]]), area_vector(mesh, triangle)) / 3.0;
    return sum;
}

void expect_consistent(const Mesh& mesh) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (const auto& triangle : mesh.triangles) {
        EXPECT_GT(glm::length(area_vector(mesh, triangle)), 1e-5);
        for (const std::uint32_t vertex : triangle) {
            ASSERT_LT(vertex, mesh.positions.size());
            EXPECT_NEAR(glm::length(mesh.normals[vertex]), 1.0F, 1e-6F);
            EXPECT_GT(glm::dot(area_vector(mesh, triangle), glm::dvec3(mesh.normals[vertex])), 0.0);
        }
    }
}

/// The texture coordinates where a ray from `origin` along `direction` meets the mesh from its
/// front.
glm::vec2 uv_on_ray(const Mesh& mesh, const glm::dvec3& origin, const glm::dvec3& direction) {
    for (const auto& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle[0]]);
        const glm::dvec3 ab = glm::dvec3(mesh.positions[triangle[1]]) - a;
        const glm::dvec3 ac = glm::dvec3(mesh.positions[triangle[2]]) - a;
        const double determinant = -glm::dot(direction, glm::cross(ab, ac));
        if (determinant <= 0.0) continue;
        const glm::dvec3 side = glm::cross(origin - a, direction);
        const double b = glm::dot(ac, side) / determinant;
        const double c = -glm::dot(ab, side) / determinant;
        if (b < -1e-9 || c < -1e-9 || b + c > 1.0 + 1e-9) continue;
        return glm::vec2((1.0 - b - c) * glm::dvec2(mesh.uvs[triangle[0]]) +
                         b * glm::dvec2(mesh.uvs[triangle[1]]) +
                         c * glm::dvec2(mesh.uvs[triangle[2]]));
    }
    ADD_FAILURE() << "the ray misses the mesh";
    return glm::vec2(-1.0F);
}

void expect_uv(const Mesh& mesh, const glm::dvec3& origin, const glm::dvec3& direction,
               const glm::vec2& expected, float tolerance) {
    const glm::vec2 uv = uv_on_ray(mesh, origin, direction);
    EXPECT_NEAR(uv.x, expected.x, tolerance);
    EXPECT_NEAR(uv.y, expected.y, tolerance);
}

TEST(Shapes, RectangleFacesUpWithAreaFour) {
    const Mesh mesh = make_rectangle();
    expect_consistent(mesh);
    EXPECT_DOUBLE_EQ(area(mesh), 4.0);
    for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(Shapes, RectangleUvGrowsWithXAndY) {
    const Mesh mesh = make_rectangle();
    expect_uv(mesh, {-0.9, -0.9, 3}, {0, 0, -1}, {0.05F, 0.05F}, 1e-6F);
    expect_uv(mesh, {0.9, -0.9, 3}, {0, 0, -1}, {0.95F, 0.05F}, 1e-6F);
    expect_uv(mesh, {-0.9, 0.9, 3}, {0, 0, -1}, {0.05F, 0.95F}, 1e-6F);
}

TEST(Shapes, CubeIsClosedAndOutward) {
    const Mesh mesh = make_cube();
    expect_consistent(mesh);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(mesh.triangles.size(), 12U);
    EXPECT_EQ(mesh.positions.size(), 24U);
    EXPECT_DOUBLE_EQ(area(mesh), 24.0);
    EXPECT_DOUBLE_EQ(volume(mesh), 8.0);
}

// Texture coordinates of this and the following shapes were read off Mitsuba 3.9.
TEST(Shapes, CubeUvMatchesMitsubaOnEveryFace) {
    const Mesh mesh = make_cube();
    expect_uv(mesh, {3, 0.3, 0.2}, {-1, 0, 0}, {0.65F, 0.4F}, 1e-6F);
    expect_uv(mesh, {-3, 0.3, 0.2}, {1, 0, 0}, {0.65F, 0.6F}, 1e-6F);
    expect_uv(mesh, {0.3, 3, 0.2}, {0, -1, 0}, {0.35F, 0.4F}, 1e-6F);
    expect_uv(mesh, {0.3, -3, 0.2}, {0, 1, 0}, {0.6F, 0.65F}, 1e-6F);
    expect_uv(mesh, {0.3, 0.2, 3}, {0, 0, -1}, {0.6F, 0.65F}, 1e-6F);
    expect_uv(mesh, {0.3, 0.2, -3}, {0, 0, 1}, {0.4F, 0.65F}, 1e-6F);
}

TEST(Shapes, SphereIsClosedOutwardAndOfTheRightSize) {
    const Mesh mesh = make_sphere();
    expect_consistent(mesh);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(mesh.triangles.size(), 5040U);
    EXPECT_NEAR(area(mesh), 4.0 * std::numbers::pi, 0.005 * 4.0 * std::numbers::pi);
    EXPECT_NEAR(volume(mesh), 4.0 / 3.0 * std::numbers::pi, 0.005 * 4.0 / 3.0 * std::numbers::pi);
    EXPECT_LT(volume(mesh), 4.0 / 3.0 * std::numbers::pi);
}

TEST(Shapes, SphereVerticesLieOnTheSphereAndAreTheirNormals) {
    const Mesh mesh = make_sphere();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::dvec3(mesh.positions[i])), 1.0, 1e-7);
        EXPECT_EQ(mesh.positions[i], mesh.normals[i]);
    }
}

TEST(Shapes, SphereUvMatchesMitsuba) {
    const Mesh mesh = make_sphere();
    expect_uv(mesh, {3, 0.3, 0.2}, {-1, 0, 0}, {0.04952651F, 0.43590575F}, 5e-4F);
    expect_uv(mesh, {-3, 0.3, 0.2}, {1, 0, 0}, {0.4504735F, 0.43590575F}, 5e-4F);
    expect_uv(mesh, {0.3, 3, 0.2}, {0, -1, 0}, {0.20047349F, 0.43590575F}, 5e-4F);
    expect_uv(mesh, {0.3, -3, 0.2}, {0, 1, 0}, {0.7995265F, 0.43590575F}, 5e-4F);
    expect_uv(mesh, {0.3, 0.2, 3}, {0, 0, -1}, {0.09358355F, 0.11741273F}, 1e-3F);
    expect_uv(mesh, {0.3, 0.2, -3}, {0, 0, 1}, {0.09358355F, 0.8825873F}, 1e-3F);
}

TEST(Shapes, DiskHasAreaPiAndASingleRim) {
    const Mesh mesh = make_disk();
    expect_consistent(mesh);
    EXPECT_EQ(mesh.triangles.size(), 128U);
    EXPECT_NEAR(area(mesh), std::numbers::pi, 0.001 * std::numbers::pi);
    const auto edges = edges_of(mesh);
    std::size_t open = 0;
    for (const auto& [edge, uses] : edges) {
        EXPECT_EQ(uses, 1);
        if (!edges.contains({edge.second, edge.first})) ++open;
    }
    EXPECT_EQ(open, 128U);
}

TEST(Shapes, DiskUvMatchesMitsuba) {
    const Mesh mesh = make_disk();
    // At the centre v is off by up to half a segment, at the rim by nothing.
    constexpr float half_segment = 0.5F / 128.0F;
    expect_uv(mesh, {0.3, 0.2, 3}, {0, 0, -1}, {0.36055514F, 0.09358355F}, half_segment);
    expect_uv(mesh, {0.0, 0.5, 3}, {0, 0, -1}, {0.5F, 0.25F}, half_segment);
    expect_uv(mesh, {0.0, -0.5, 3}, {0, 0, -1}, {0.5F, 0.75F}, half_segment);
}

}  // namespace
}  // namespace weft::shapes_test
