// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/split_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "bvh/build_tree.h"
#include "bvh/slabs.h"
#include "bvh/split_triangle.h"
#include "tests/testing/bvh_meshes.h"

namespace weft::split_search_test {
namespace {

using test::BvhMesh;

constexpr double infinite = std::numeric_limits<double>::infinity();

PieceSet all_pieces(const BvhMesh& mesh, std::size_t room) {
    PieceSet set;
    for (const Piece& piece : make_pieces(mesh.positions, mesh.triangles)) set.add(piece);
    set.room = room;
    return set;
}

struct Side {
    Box box;
    std::size_t count = 0;
    void add(const Box& part) {
        if (part.empty()) return;
        box.extend(part);
        ++count;
    }
    [[nodiscard]] double cost() const {
        return box.half_area() * static_cast<double>((count + node_width - 1) / node_width);
    }
};

double cost_of(const Side& below, const Side& above) {
    return below.count == 0 || above.count == 0 ? infinite : below.cost() + above.cost();
}

// The cheapest of all planes, by sorting every piece to the sides of each.
double cheapest_object_split(const PieceSet& set) {
    double best = infinite;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Slabs slabs(set.centres, axis, 32);
        for (std::size_t k = 1; k < slabs.count(); ++k) {
            Side below;
            Side above;
            for (const Piece& piece : set.pieces)
                (centre_of(piece)[axis] < slabs.plane(k) ? below : above).add(box_of(piece));
            best = std::min(best, cost_of(below, above));
        }
    }
    return best;
}

double cheapest_spatial_split(const PieceSet& set, const BvhMesh& mesh) {
    double best = infinite;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Slabs slabs(set.box, axis, 16);
        for (std::size_t k = 1; k < slabs.count(); ++k) {
            const float plane = slabs.plane(k);
            Side below;
            Side above;
            for (const Piece& piece : set.pieces) {
                const Box box = box_of(piece);
                if (box.upper[axis] <= plane) {
                    below.add(box);
                } else if (box.lower[axis] >= plane) {
                    above.add(box);
                } else {
                    const Corners corners =
                        corners_of(mesh.positions, mesh.triangles[piece.primID]);
                    const SplitBoxes parts = split_triangle(corners, box, axis, plane);
                    below.add(parts.below);
                    above.add(parts.above);
                }
            }
            best = std::min(best, cost_of(below, above));
        }
    }
    return best;
}

TEST(SplitSearch, FindsWhatTryingEveryPlaneFinds) {
    std::size_t spatial = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        const BvhMesh mesh =
            seed % 2 == 0 ? test::random_soup(60, 0.5F, seed) : test::diagonal_needles(60, seed);
        const PieceSet set = all_pieces(mesh, 1000);
        const double object = cheapest_object_split(set);
        const double cut = cheapest_spatial_split(set, mesh);
        const Split without = find_split(set, mesh.positions, mesh.triangles, node_width, infinite);
        EXPECT_FALSE(without.spatial);
        EXPECT_DOUBLE_EQ(without.cost, object);
        const Split split = find_split(set, mesh.positions, mesh.triangles, node_width, 0.0);
        if (!split.spatial) {
            EXPECT_DOUBLE_EQ(split.cost, object);
            continue;
        }
        ++spatial;
        // Boxes of parts that are cut one after another are rounded more often than those cut once.
        EXPECT_NEAR(split.cost, cut, 1e-5 * cut);
        EXPECT_LT(split.cost, object);
    }
    EXPECT_GE(spatial, 15U);
}

TEST(SplitSearch, NothingIsCutWithoutRoom) {
    const BvhMesh mesh = test::diagonal_needles(60, 1);
    PieceSet set = all_pieces(mesh, 1000);
    const Split split = find_split(set, mesh.positions, mesh.triangles, node_width, 0.0);
    ASSERT_TRUE(split.spatial);
    ASSERT_GT(split.added, 0U);
    set.room = split.added - 1;
    EXPECT_FALSE(find_split(set, mesh.positions, mesh.triangles, node_width, 0.0).spatial);
}

}  // namespace
}  // namespace weft::split_search_test
