// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/testing/scene_builder.h"

// Tangents of meshes whose textures lie on them in known ways. In all of them +v falls: a texture
// stands upright where v falls along y.
namespace weft::tangents_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

MeshTangents tangents_of(const Mesh& mesh) {
    return make_tangents(mesh, mesh.uvs);
}

void expect_tangent(const glm::vec4& tangent, const glm::dvec3& along, float side,
                    double tolerance = 1e-6) {
    EXPECT_NEAR(glm::length(glm::dvec3(tangent) - along), 0.0, tolerance)
        << tangent.x << ' ' << tangent.y << ' ' << tangent.z;
    EXPECT_EQ(tangent.w, side);
}

/// A square of four quads in z = 0 with normals to +z.
Mesh plane(const std::function<glm::vec2(const glm::vec3&)>& uv) {
    Mesh mesh = test::quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2);
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    mesh.uvs.clear();
    for (const glm::vec3& p : mesh.positions) mesh.uvs.push_back(uv(p));
    return mesh;
}

TEST(Tangents, OfPlanesGoWhereUGrows) {
    struct Case {
        std::function<glm::vec2(const glm::vec3&)> uv;
        glm::dvec3 along;
        float side;
    };
    const std::vector<Case> cases{
        {[](const glm::vec3& p) { return glm::vec2(p.x, -p.y); }, {1, 0, 0}, 1.0F},
        {[](const glm::vec3& p) { return glm::vec2(7 * p.x, 3 - 0.5F * p.y); }, {1, 0, 0}, 1.0F},
        {[](const glm::vec3& p) { return glm::vec2(p.y, p.x); }, {0, 1, 0}, 1.0F},
        {[](const glm::vec3& p) { return glm::vec2(-p.x, -p.y); }, {-1, 0, 0}, -1.0F},
        {[](const glm::vec3& p) { return glm::vec2(p.x, p.y); }, {1, 0, 0}, -1.0F},
        // Sheared: along the line of equal v.
        {[](const glm::vec3& p) { return glm::vec2(p.x, p.x - p.y); },
         glm::normalize(glm::dvec3(1, 1, 0)), 1.0F}};
    for (const Case& c : cases) {
        const Mesh mesh = plane(c.uv);
        const MeshTangents made = tangents_of(mesh);
        EXPECT_EQ(made.triangles, mesh.triangles);
        EXPECT_TRUE(made.copies.empty());
        ASSERT_EQ(made.tangents.size(), mesh.positions.size());
        for (const glm::vec4& tangent : made.tangents) expect_tangent(tangent, c.along, c.side);
    }
}

TEST(Tangents, AreSplitWhereATextureIsMirrored) {
    // u grows away from x = 0 to both sides.
    const Mesh mesh = plane([](const glm::vec3& p) { return glm::vec2(std::abs(p.x), -p.y); });
    const MeshTangents made = tangents_of(mesh);
    // The three vertices of the seam are there twice.
    ASSERT_EQ(made.copies.size(), 3U);
    ASSERT_EQ(made.tangents.size(), mesh.positions.size() + 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const bool right = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]).x > 0.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = made.triangles[i][k];
            const std::uint32_t source = vertex < mesh.positions.size()
                                             ? vertex
                                             : made.copies[vertex - mesh.positions.size()];
            EXPECT_EQ(source, mesh.triangles[i][k]);
            expect_tangent(made.tangents[vertex], {right ? 1.0 : -1.0, 0, 0}, right ? 1.0F : -1.0F);
        }
    }
}

TEST(Tangents, AreWeightedByTheAnglesOfCorners) {
    // At the origin a corner of 90 degrees, where u grows along x, and one of 45 degrees, where it
    // grows along x + y.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 0}, {1, 0}, {0, -1}, {-1, -2}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const MeshTangents made = tangents_of(mesh);
    EXPECT_TRUE(made.copies.empty());
    const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1, 1, 0));
    expect_tangent(made.tangents[0], glm::normalize(2.0 * glm::dvec3(1, 0, 0) + 1.0 * diagonal),
                   1.0F);
    expect_tangent(made.tangents[1], {1, 0, 0}, 1.0F);
    expect_tangent(made.tangents[3], diagonal, 1.0F);
}

TEST(Tangents, LieAcrossTheShadingNormal) {
    Mesh mesh = plane([](const glm::vec3& p) { return glm::vec2(p.x, -p.y); });
    const glm::dvec3 leaning = glm::normalize(glm::dvec3(0.6, 0.3, 1.0));
    mesh.normals.assign(mesh.positions.size(), glm::vec3(leaning));
    const glm::dvec3 expected =
        glm::normalize(glm::dvec3(1, 0, 0) - glm::dot(leaning, glm::dvec3(1, 0, 0)) * leaning);
    for (const glm::vec4& tangent : tangents_of(mesh).tangents)
        expect_tangent(tangent, expected, 1.0F);
}

/// A sphere about the origin, whose texture goes once around it, from the pole +y downwards. The
/// first and the last column have the same places, but are vertices of their own.
Mesh globe(std::uint32_t columns, std::uint32_t rows) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i) {
            const double u = double(i % columns) / columns;
            const double v = double(j) / rows;
            // Counter-clockwise seen from above.
            const glm::vec3 p(std::sin(pi * v) * std::cos(2 * pi * u), std::cos(pi * v),
                              -std::sin(pi * v) * std::sin(2 * pi * u));
            mesh.positions.push_back(p);
            mesh.normals.push_back(p);
            mesh.uvs.emplace_back(double(i) / columns, v);
        }
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = j * (columns + 1) + i;
            const std::uint32_t c = a + columns + 1;
            mesh.triangles.push_back({a, c, c + 1});
            mesh.triangles.push_back({a, c + 1, a + 1});
        }
    return mesh;
}

TEST(Tangents, OfAGlobeGoEast) {
    const Mesh mesh = globe(64, 32);
    const MeshTangents made = tangents_of(mesh);
    EXPECT_TRUE(made.copies.empty());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p(mesh.positions[i]);
        ASSERT_NEAR(glm::length(glm::vec3(made.tangents[i])), 1.0F, 1e-6F);
        ASSERT_EQ(made.tangents[i].w, 1.0F);
        // At the poles each vertex is of one column. At the seam a vertex has triangles on one side
        // alone, whose u grows along their chords: half a column off.
        const double height = std::abs(p.y);
        if (height > 0.95) continue;
        const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), p));
        ASSERT_LT(glm::length(glm::dvec3(made.tangents[i]) - east), 0.02 / (1.0 - height)) << i;
    }
}

TEST(Tangents, OfFacesWithSeamsAreTheirOwn) {
    // Two faces of a cube that share an edge, with normals and textures of their own.
    Mesh mesh;
    mesh.positions = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
                      {1, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}};
    for (int i = 0; i < 8; ++i)
        mesh.normals.push_back(i < 4 ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0));
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    const MeshTangents made = tangents_of(mesh);
    EXPECT_TRUE(made.copies.empty());
    for (std::size_t i = 0; i < 8; ++i)
        expect_tangent(made.tangents[i], i < 4 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, -1), 1.0F);
    // Without normals every face has its own, and shared corners are split.
    mesh.normals.clear();
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 5, 6}, {1, 6, 2}};
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}, {1, 1}, {2, 1}, {2, 0}, {1, 0}};
    const MeshTangents split = tangents_of(mesh);
    EXPECT_EQ(split.copies, (std::vector<std::uint32_t>{1, 2}));
    for (std::size_t i = 0; i < 4; ++i)
        for (const std::uint32_t vertex : split.triangles[i])
            expect_tangent(split.tangents[vertex],
                           i < 2 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, -1), 1.0F);
}

TEST(Tangents, DoNotDependOnHowVerticesAreShared) {
    const Mesh mesh = globe(12, 6);
    const MeshTangents shared = tangents_of(mesh);
    Mesh apart;
    for (const auto& triangle : mesh.triangles) {
        const auto base = static_cast<std::uint32_t>(apart.positions.size());
        for (const std::uint32_t vertex : triangle) {
            apart.positions.push_back(mesh.positions[vertex]);
            apart.normals.push_back(mesh.normals[vertex]);
            apart.uvs.push_back(mesh.uvs[vertex]);
        }
        apart.triangles.push_back({base, base + 1, base + 2});
    }
    const MeshTangents made = tangents_of(apart);
    EXPECT_TRUE(made.copies.empty());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(made.tangents[3 * i + k], shared.tangents[shared.triangles[i][k]]);
}

TEST(Tangents, OfTrianglesWithoutTextureAreThoseOfTheirNeighbours) {
    // The second triangle has no area in the texture: where it touches the first, it shares its
    // tangents; the corner that is its own has any.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0.5F, 0.5F}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const MeshTangents made = tangents_of(mesh);
    EXPECT_TRUE(made.copies.empty());
    for (std::size_t i = 0; i < 3; ++i) expect_tangent(made.tangents[i], {1, 0, 0}, 1.0F);
    EXPECT_NEAR(glm::length(glm::vec3(made.tangents[3])), 1.0F, 1e-6F);
    EXPECT_EQ(made.tangents[3].z, 0.0F);
}

TEST(Tangents, OfWhatHasNoTextureAreUnitVectorsAcrossTheNormal) {
    const auto expect_any = [](const Mesh& mesh, const MeshTangents& made) {
        ASSERT_EQ(made.tangents.size(), mesh.positions.size() + made.copies.size());
        for (std::size_t i = 0; i < made.tangents.size(); ++i) {
            const glm::vec4& tangent = made.tangents[i];
            EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0F, 1e-5F) << i;
            EXPECT_TRUE(tangent.w == 1.0F || tangent.w == -1.0F);
        }
    };
    Mesh mesh = globe(8, 4);
    expect_any(mesh, make_tangents(mesh, {}));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_NEAR(glm::dot(glm::vec3(make_tangents(mesh, {}).tangents[i]), mesh.normals[i]), 0.0F,
                    1e-5F);
    // Numbers that are none, and normals without a direction.
    for (std::size_t i = 0; i < mesh.uvs.size(); i += 3) mesh.uvs[i] = {nan, nan};
    mesh.uvs[4].x = std::numeric_limits<float>::infinity();
    mesh.normals[7] = glm::vec3(0.0F);
    mesh.normals[8] = glm::vec3(nan);
    mesh.positions[10] = mesh.positions[9];
    expect_any(mesh, tangents_of(mesh));
    // All at one place.
    mesh.positions.assign(mesh.positions.size(), glm::vec3(1.0F));
    expect_any(mesh, tangents_of(mesh));
    mesh.normals.clear();
    expect_any(mesh, tangents_of(mesh));
    // Nothing at all, and a vertex that no triangle uses.
    expect_any({}, make_tangents({}, {}));
    Mesh lonely;
    lonely.positions = {{0, 0, 0}};
    expect_any(lonely, make_tangents(lonely, {}));
}

TEST(Tangents, OfTrianglesOfOneLineAreThoseOfTheVertex) {
    // A triangle two of whose corners are at one place is left out, and its corners take the
    // tangents of those that they are welded to.
    Mesh mesh = plane([](const glm::vec3& p) { return glm::vec2(p.x, -p.y); });
    mesh.triangles.push_back({0, 1, 1});
    const MeshTangents made = tangents_of(mesh);
    EXPECT_TRUE(made.copies.empty());
    for (const glm::vec4& tangent : made.tangents) expect_tangent(tangent, {1, 0, 0}, 1.0F);
}

TEST(Tangents, FansOfManyTrianglesEnd) {
    // One vertex of 200,000 triangles: groups are followed without recursion.
    Mesh mesh;
    constexpr std::uint32_t count = 200'000;
    mesh.positions.push_back(glm::vec3(0.0F));
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2.0 * pi * i / count;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        mesh.triangles.push_back({0, i + 1, (i + 1) % count + 1});
    }
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x, -p.y);
    const MeshTangents made = tangents_of(mesh);
    EXPECT_TRUE(made.copies.empty());
    expect_tangent(made.tangents[0], {1, 0, 0}, 1.0F, 1e-3);
}

}  // namespace
}  // namespace weft::tangents_test
