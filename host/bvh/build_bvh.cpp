// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/stopwatch.h"
#include "bvh/embree_tree.h"
#include "bvh/flatten.h"
#include "bvh/pieces.h"
#include "bvh/spatial_tree.h"
#include "bvh/wide_bvh.h"

namespace weft {
namespace {

// The greatest depth that a traversal stack allows. A path of n nodes needs at most
// n (node_width - 1) + 1 stack entries; Embree counts the leaf too and falls back to balanced
// subtrees before it exceeds the depth.
std::uint32_t depth_within(std::uint32_t stack) noexcept {
    return (stack - 1) / static_cast<std::uint32_t>(node_width - 1) + 1;
}

// Stack entries that a balanced tree of 2^27 triangles, each a leaf, may need: it has 9 levels.
constexpr std::uint32_t least_stack = 9 * (node_width - 1) + 1;

// Splits repeat triangles, so they are kept only where they lower the cost to this share.
constexpr double worthwhile_cost = 0.95;

// Pieces that cuts may add, as a share of those there are. Measured SAH costs of five scenes at
// 0.3, 1 and 2: within 2 percent of each other, with 6 to 27 percent of pieces added.
constexpr double split_room = 1.0;

// A build with splits takes eight to twenty times as long as one without, for a cost that may be
// lower by no more than a few percent. So no second build is tried beyond this size.
constexpr std::size_t max_pieces_to_split = 4'000'000;

// Embree works with areas in float, which have to stay finite.
constexpr float max_embree_coordinate = 1e15F;

bool fits_embree(const std::vector<Piece>& pieces) noexcept {
    for (const Piece& piece : pieces) {
        const Box box = box_of(piece);
        for (std::size_t a = 0; a < 3; ++a)
            if (box.lower[a] < -max_embree_coordinate || box.upper[a] > max_embree_coordinate)
                return false;
    }
    return true;
}

void check_settings(const BvhSettings& settings) {
    if (settings.max_leaf_triangles < 1 || settings.max_leaf_triangles > node_width)
        throw Error(ExitCode::usage, "leaves of the BVH may hold " +
                                         std::to_string(settings.max_leaf_triangles) +
                                         " triangles, expected 1 to 8");
    if (!std::isfinite(settings.padding) || settings.padding < 0.0F)
        throw Error(ExitCode::usage, "the padding of the BVH is not finite or negative");
    if (settings.max_stack < least_stack || settings.max_stack > BVH_STACK)
        throw Error(ExitCode::usage, "traversal of the BVH may need " +
                                         std::to_string(settings.max_stack) +
                                         " stack entries, expected " + std::to_string(least_stack) +
                                         " to " + std::to_string(BVH_STACK));
}

WideBvh build_best(std::span<const shared::float4> positions,
                   std::span<const shared::Triangle> triangles, const BvhSettings& settings,
                   std::size_t first) {
    std::vector<Piece> pieces = make_pieces(positions, triangles, first);
    const auto flat = [&](const BuildTree& tree) {
        return flatten(tree, positions, triangles, settings);
    };
    // Very large coordinates are the one case where a tree worse than Embree's is accepted.
    if (!fits_embree(pieces)) return flat(build_balanced_tree(pieces, settings.max_leaf_triangles));

    const std::uint32_t max_depth = depth_within(settings.max_stack);
    const EmbreeBuild request{.max_leaf = settings.max_leaf_triangles, .max_depth = max_depth};
    WideBvh best = flat(build_embree_tree(pieces, request));
    if (settings.spatial_splits && pieces.size() > 1 && pieces.size() <= max_pieces_to_split) {
        const auto room =
            static_cast<std::size_t>(std::ceil(split_room * static_cast<double>(pieces.size())));
        WideBvh split = flat(build_spatial_tree(
            pieces, positions, triangles,
            {.max_leaf = settings.max_leaf_triangles, .max_depth = max_depth, .room = room}));
        if (split.stack_need <= settings.max_stack &&
            split.sah_cost < worthwhile_cost * best.sah_cost)
            best = std::move(split);
    }
    if (best.stack_need > settings.max_stack)
        best = flat(build_balanced_tree(pieces, settings.max_leaf_triangles));
    return best;
}

}  // namespace

WideBvh build_bvh(std::span<const shared::float4> positions,
                  std::span<const shared::Triangle> triangles, const BvhSettings& settings,
                  std::size_t first) {
    check_settings(settings);
    const Stopwatch watch;
    try {
        WideBvh bvh = build_best(positions, triangles, settings, first);
        bvh.build_ms = watch.total();
        return bvh;
    } catch (const std::bad_alloc&) {
        throw Error(ExitCode::out_of_memory, "out of memory while building the BVH");
    }
}

}  // namespace weft
