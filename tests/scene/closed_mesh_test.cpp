// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/closed_mesh.h"

#include <gtest/gtest.h>

#include "scene/mesh_edit.h"
#include "scene/shapes.h"

namespace weft::closed_mesh_test {
namespace {

TEST(ClosedMesh, SolidsAreClosedWhateverTheirSeams) {
    // The cube has vertices of its own on each face; those of the sphere meet along a seam.
    EXPECT_TRUE(is_closed(make_cube()));
    EXPECT_TRUE(is_closed(make_sphere()));
    Mesh mirrored = make_sphere();
    mirror_mesh(mirrored);
    EXPECT_TRUE(is_closed(mirrored));
}

TEST(ClosedMesh, SheetsAreNot) {
    EXPECT_FALSE(is_closed(make_rectangle()));
    EXPECT_FALSE(is_closed(make_disk()));
    EXPECT_FALSE(is_closed(Mesh{}));
}

TEST(ClosedMesh, AGapOrATurnedTriangleOpensIt) {
    Mesh gap = make_cube();
    gap.triangles.pop_back();
    EXPECT_FALSE(is_closed(gap));
    Mesh turned = make_cube();
    std::swap(turned.triangles[3][0], turned.triangles[3][1]);
    EXPECT_FALSE(is_closed(turned));
}

TEST(ClosedMesh, TrianglesWithoutAreaDoNotCount) {
    Mesh mesh = make_cube();
    mesh.triangles.push_back({0, 0, 1});
    EXPECT_TRUE(is_closed(mesh));
    Mesh needle;
    needle.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    needle.triangles = {{0, 1, 2}};
    EXPECT_FALSE(is_closed(needle));
    // Negative zero is where zero is.
    Mesh zero = make_cube();
    for (glm::vec3& p : zero.positions) p = glm::vec3(p.x - 1.0F, p.y, p.z);
    for (std::size_t i = 0; i < zero.positions.size(); i += 2)
        if (zero.positions[i].x == 0.0F) zero.positions[i].x = -0.0F;
    EXPECT_TRUE(is_closed(zero));
}

}  // namespace
}  // namespace weft::closed_mesh_test
