// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bvh/flatten.h"
#include "bvh/leaves.h"
#include "bvh/wide_bvh.h"
#include "tests/testing/bvh_meshes.h"

namespace weft::check_bvh_test {
namespace {

void append_one(LargeVector<float>& leaves, const LeafTriangle& triangle) {
    append_leaf(leaves, {&triangle, 1});
}

void write_entry(WideBvh& bvh, std::uint32_t leaf, std::size_t i, const LeafTriangle& triangle) {
    LargeVector<float> alone = empty_leaves();
    append_one(alone, triangle);
    for (std::size_t row = 0; row < LEAF_ROWS; ++row)
        bvh.leaves[leaf_first(leaf) * LEAF_ROWS + row * leaf_count(leaf) + i] = alone[row];
}

// Breaks a sound BVH in one way and expects the check to name it.
class CheckBvh : public testing::TestWithParam<bool> {
  protected:
    void SetUp() override {
        mesh_ = GetParam() ? test::diagonal_needles(300, 3) : test::random_soup(300, 0.1F, 3);
        settings_.padding = 0.001F;
        settings_.spatial_splits = GetParam();
        sound_ = build_bvh(mesh_.positions, mesh_.triangles, settings_);
        ASSERT_EQ(sound_.has_spatial_splits, GetParam());
        ASSERT_EQ(check(sound_), "");
        for (const std::uint32_t child : sound_.nodes[0].child) ASSERT_NE(child, BVH_EMPTY);
        ASSERT_FALSE(is_leaf(sound_.nodes[0].child[0]));
    }

    [[nodiscard]] std::string check(const WideBvh& bvh) const {
        return check_bvh(bvh, mesh_.positions, mesh_.triangles, settings_);
    }

    void expect(const std::string& problem, const std::function<void(WideBvh&)>& corrupt) const {
        WideBvh bvh = sound_;
        corrupt(bvh);
        EXPECT_NE(check(bvh).find(problem), std::string::npos)
            << "expected '" << problem << "', got '" << check(bvh) << "'";
    }

    // The slot of some node that holds a leaf; `least` is its smallest count.
    struct Slot {
        std::size_t node, slot;
    };
    [[nodiscard]] Slot find_leaf(std::uint32_t least) const {
        for (std::size_t n = 0; n < sound_.nodes.size(); ++n)
            for (std::size_t s = 0; s < node_width; ++s)
                if (is_leaf(sound_.nodes[n].child[s]) &&
                    leaf_count(sound_.nodes[n].child[s]) >= least)
                    return {n, s};
        ADD_FAILURE() << "no leaf of " << least;
        return {0, 0};
    }

    test::BvhMesh mesh_;
    BvhSettings settings_;
    WideBvh sound_;
};

TEST_P(CheckBvh, ReportsBrokenReferences) {
    const Slot at = find_leaf(2);
    const std::uint32_t leaf = sound_.nodes[at.node].child[at.slot];
    expect("there is no root", [](WideBvh& b) { b.nodes.clear(); });
    expect("does not exist",
           [](WideBvh& b) { b.nodes[0].child[0] = static_cast<std::uint32_t>(b.nodes.size()); });
    // A cycle and a node with two parents. Boxes are made to fit, as those are checked first.
    expect("is reached twice", [](WideBvh& b) {
        b.nodes[0].child[0] = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            b.nodes[0].bounds[2 * a][0] = -FLT_MAX;
            b.nodes[0].bounds[2 * a + 1][0] = FLT_MAX;
        }
    });
    expect("is reached twice", [](WideBvh& b) {
        b.nodes[0].child[1] = b.nodes[0].child[0];
        for (std::size_t plane = 0; plane < 6; ++plane)
            b.nodes[0].bounds[plane][1] = b.nodes[0].bounds[plane][0];
    });
    expect("is never reached", [](WideBvh& b) { b.nodes.push_back(b.nodes.back()); });
    expect("count out of range", [&](WideBvh& b) { b.nodes[at.node].child[at.slot] = BVH_LEAF; });
    expect("count out of range", [&](WideBvh& b) {
        b.nodes[at.node].child[at.slot] = leaf | BVH_COUNT_MASK << BVH_COUNT_SHIFT;
    });
    expect("behind the last triangle", [&](WideBvh& b) {
        b.nodes[at.node].child[at.slot] =
            (leaf & ~BVH_FIRST_MASK) | std::uint32_t(leaf_entries(b.leaves) - 1);
    });
    expect("is in two leaves", [&](WideBvh& b) {
        const std::uint32_t other = leaf_first(leaf) == 0 ? 1 : leaf_first(leaf) - 1;
        b.nodes[at.node].child[at.slot] = (leaf & ~BVH_FIRST_MASK) | other;
    });
    expect("is in no leaf",
           [&](WideBvh& b) { b.nodes[at.node].child[at.slot] = leaf - (1U << BVH_COUNT_SHIFT); });
}

TEST_P(CheckBvh, ReportsBrokenBoxes) {
    const Slot at = find_leaf(1);
    expect("empty or not finite",
           [&](WideBvh& b) { b.nodes[at.node].bounds[3][at.slot] = INFINITY; });
    expect("empty or not finite", [&](WideBvh& b) { b.nodes[at.node].bounds[2][at.slot] = NAN; });
    expect("empty or not finite",
           [&](WideBvh& b) { b.nodes[at.node].bounds[0][at.slot] = FLT_MAX; });
    for (std::size_t plane = 0; plane < 6; ++plane) {
        expect("outside its own box", [&](WideBvh& b) {
            float& bound = b.nodes[0].bounds[plane][0];
            bound = std::nextafter(bound, plane % 2 == 0 ? 1e9F : -1e9F);
        });
    }
    expect("an empty child that rays can hit",
           [&](WideBvh& b) { b.nodes[at.node].child[at.slot] = BVH_EMPTY; });
}

TEST_P(CheckBvh, ReportsLeafBoxesThatAreTooSmall) {
    // Any leaf box shrunk by less than the padding, on the side where its triangles reach it.
    const Slot at = find_leaf(1);
    expect("is not covered", [&](WideBvh& b) {
        for (std::size_t a = 0; a < 3; ++a) {
            b.nodes[at.node].bounds[2 * a][at.slot] += 0.5F * settings_.padding;
            b.nodes[at.node].bounds[2 * a + 1][at.slot] -= 0.5F * settings_.padding;
        }
    });
}

TEST_P(CheckBvh, ReportsWrongTriangles) {
    const Slot at = find_leaf(1);
    const std::uint32_t leaf = sound_.nodes[at.node].child[at.slot];
    const auto change = [&](const char* problem, auto&& corrupt) {
        LeafTriangle triangle = leaf_triangle(sound_.leaves, leaf, 0);
        corrupt(triangle);
        expect(problem, [&](WideBvh& b) { write_entry(b, leaf, 0, triangle); });
    };
    change("id out of range", [](LeafTriangle& t) { t.id = 300; });
    change("differs from", [](LeafTriangle& t) { t.corners[1].y += 1.0F; });
    change("differs from", [](LeafTriangle& t) { std::swap(t.corners[0], t.corners[1]); });
    expect("is in no leaf", [](WideBvh& b) { append_one(b.leaves, {}); });
    expect("wrong length", [](WideBvh& b) { b.leaves.pop_back(); });
    expect("split is not as stated",
           [](WideBvh& b) { b.has_spatial_splits = !b.has_spatial_splits; });
}

TEST_P(CheckBvh, ReportsIndicesOutOfRange) {
    test::BvhMesh mesh = mesh_;
    mesh.triangles[17].v1 = static_cast<std::uint32_t>(mesh.positions.size());
    EXPECT_EQ(check_bvh(sound_, mesh.positions, mesh.triangles, settings_),
              "triangle 17 has a vertex index out of range");
}

TEST_P(CheckBvh, ReportsAMissingTriangleAndOneTooMany) {
    test::BvhMesh more = mesh_;
    more.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(check_bvh(sound_, more.positions, more.triangles, settings_),
              "triangle 300 is in no leaf");
    // The leaf copies move with it, so only its area gives it away.
    test::BvhMesh flat = mesh_;
    WideBvh bvh = sound_;
    flat.positions[7] = flat.positions[6];
    for (const shared::BvhNode& node : bvh.nodes) {
        for (const std::uint32_t child : node.child) {
            for (std::uint32_t i = 0; is_leaf(child) && i < leaf_count(child); ++i) {
                LeafTriangle triangle = leaf_triangle(bvh.leaves, child, i);
                if (triangle.id != 2) continue;
                triangle.corners[1] = flat.positions[7];
                write_entry(bvh, child, i, triangle);
            }
        }
    }
    EXPECT_EQ(check_bvh(bvh, flat.positions, flat.triangles, settings_),
              "triangle 2 should have been left out");
}

TEST_P(CheckBvh, ReportsWrongDepthAndStack) {
    expect("the depth is", [](WideBvh& b) { ++b.depth; });
    expect("the stack need is", [](WideBvh& b) { --b.stack_need; });
}

INSTANTIATE_TEST_SUITE_P(CheckBvh, CheckBvh, testing::Bool(), [](const auto& information) {
    return information.param ? "WithSplits" : "WithoutSplits";
});

// Nodes in a chain of eight children each need seven entries a level.
TEST(CheckBvhStack, RefusesMoreThanTheKernelsHold) {
    test::BvhMesh mesh;
    WideBvh bvh;
    Box box;
    const std::uint32_t levels = 23;
    for (std::uint32_t i = 0; i <= 7 * levels; ++i) {
        mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        append_one(bvh.leaves, {{mesh.positions[0], mesh.positions[1], mesh.positions[2]}, i});
    }
    box.extend({{0, 0, 0}, {1, 1, 0}});
    box = box.grown(0.0F);
    for (std::uint32_t level = 0; level < levels; ++level) {
        shared::BvhNode node{};
        for (std::uint32_t slot = 0; slot < 8; ++slot) {
            for (std::size_t a = 0; a < 3; ++a) {
                node.bounds[2 * a][slot] = box.lower[a];
                node.bounds[2 * a + 1][slot] = box.upper[a];
            }
            node.child[slot] = BVH_LEAF | 1U << BVH_COUNT_SHIFT | (7 * level + slot);
        }
        if (level + 1 < levels) node.child[7] = level + 1;
        bvh.nodes.push_back(node);
    }
    bvh.depth = levels;
    bvh.stack_need = 7 * levels + 1;
    ASSERT_GT(bvh.stack_need, std::uint32_t{BVH_STACK});
    EXPECT_EQ(check_bvh(bvh, mesh.positions, mesh.triangles, {}),
              "the stack need 162 is too large");
}

}  // namespace
}  // namespace weft::check_bvh_test
