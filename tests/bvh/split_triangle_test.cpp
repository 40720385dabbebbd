// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/split_triangle.h"

#include <gtest/gtest.h>

#include "bvh/coverage.h"
#include "bvh/pieces.h"
#include "tests/testing/bvh_meshes.h"

namespace weft::split_triangle_test {
namespace {

Corners corners(const test::BvhMesh& mesh, std::size_t index) {
    return corners_of(mesh.positions, mesh.triangles[index]);
}

test::BvhMesh right_triangle() {
    test::BvhMesh mesh;
    mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 2});
    return mesh;
}

bool holds(const Box& box, const Point& p) {
    for (std::size_t a = 0; a < 3; ++a)
        if (p[a] < double{box.lower[a]} || p[a] > double{box.upper[a]}) return false;
    return true;
}

TEST(SplitTriangle, BoxesAreTight) {
    const Corners c = corners(right_triangle(), 0);
    const auto [below, above] = split_triangle(c, box_of(c), 0, 0.25F);
    EXPECT_EQ(below.lower, (std::array<float, 3>{0, 0, 0}));
    EXPECT_EQ(below.upper, (std::array<float, 3>{0.25F, 1, 2}));
    EXPECT_EQ(above.lower, (std::array<float, 3>{0.25F, 0, 0}));
    EXPECT_EQ(above.upper[0], 1.0F);
    EXPECT_GE(above.upper[1], 0.75F);
    EXPECT_LE(above.upper[1], 0.7500003F);
    EXPECT_GE(above.upper[2], 1.5F);
    EXPECT_LE(above.upper[2], 1.5000006F);
}

TEST(SplitTriangle, APlaneBesideTheTriangleLeavesOneHalfEmpty) {
    const Corners c = corners(right_triangle(), 0);
    Box piece = box_of(c);
    piece.extend({{-1, -1, -1}, {3, 3, 3}});
    EXPECT_TRUE(split_triangle(c, piece, 0, -0.5F).below.empty());
    EXPECT_TRUE(split_triangle(c, piece, 0, 2.0F).above.empty());
    EXPECT_EQ(split_triangle(c, piece, 0, 2.0F).below.upper, box_of(c).upper);
}

TEST(SplitTriangle, HalvesHoldEveryPointAndStayInsideThePiece) {
    test::BvhMesh mesh = test::random_soup(200, 3.0F, 5);
    const test::BvhMesh needles = test::diagonal_needles(200, 5);
    for (std::size_t i = 0; i < 200; ++i) {
        const Corners c = corners(needles, i);
        mesh.add({c[0].x, c[0].y, c[0].z}, {c[1].x, c[1].y, c[1].z}, {c[2].x, c[2].y, c[2].z});
    }
    test::Uniform uniform(9);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Corners c = corners(mesh, i);
        Box piece = box_of(c);
        // Three cuts in a row, keeping one half, as a builder would.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float position = uniform(piece.lower[axis], piece.upper[axis]);
            const auto [below, above] = split_triangle(c, piece, axis, position);
            EXPECT_TRUE(below.empty() || piece.contains(below));
            EXPECT_TRUE(above.empty() || piece.contains(above));
            EXPECT_LE(below.upper[axis], position);
            EXPECT_GE(above.lower[axis], position);
            for (int k = 0; k < 300; ++k) {
                const double u = uniform(0.0F, 1.0F);
                const double v = k % 3 == 0 ? 0.0 : (1.0 - u) * double{uniform(0.0F, 1.0F)};
                const double w = 1.0 - u - v;
                const Point p{u * double{c[0].x} + v * double{c[1].x} + w * double{c[2].x},
                              u * double{c[0].y} + v * double{c[1].y} + w * double{c[2].y},
                              u * double{c[0].z} + v * double{c[1].z} + w * double{c[2].z}};
                if (!holds(piece, p)) continue;
                ++inside;
                EXPECT_TRUE(holds(p[axis] < double{position} ? below : above, p));
            }
            piece = below.empty() || (i % 2 == 0 && !above.empty()) ? above : below;
        }
    }
    EXPECT_GT(inside, 50000U);
}

TEST(SplitTriangle, CoverageSeesGapsAndOverlooksNone) {
    const Corners c = corners(right_triangle(), 0);
    const Box whole = box_of(c);
    EXPECT_TRUE(boxes_cover(c, {whole}));
    EXPECT_FALSE(boxes_cover(c, {}));
    Box smaller = whole;
    smaller.upper[2] = 1.999999F;
    EXPECT_FALSE(boxes_cover(c, {smaller}));
    const auto [below, above] = split_triangle(c, whole, 0, 0.25F);
    EXPECT_TRUE(boxes_cover(c, {below, above}));
    EXPECT_TRUE(boxes_cover(c, {above, below}));
    EXPECT_FALSE(boxes_cover(c, {below}));
    EXPECT_FALSE(boxes_cover(c, {above}));
    Box gap = above;
    gap.lower[0] = 0.250001F;
    EXPECT_FALSE(boxes_cover(c, {below, gap}));
}

}  // namespace
}  // namespace weft::split_triangle_test
