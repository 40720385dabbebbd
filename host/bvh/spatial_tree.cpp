// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/spatial_tree.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <new>
#include <utility>

#include "bvh/split_search.h"
#include "bvh/split_triangle.h"

namespace weft {
namespace {

// An overlap smaller than this share of the scene's surface is not worth cutting (Stich et al. take
// 1e-5; Embree's builder takes this).
constexpr double overlap_share_of_scene = 5e-6;

// Subtrees with fewer pieces are built by one thread.
constexpr std::size_t parallel_pieces = 2048;

using Memory = tbb::enumerable_thread_specific<std::pmr::monotonic_buffer_resource>;

class Builder {
  public:
    Builder(std::span<const shared::float4> positions, std::span<const shared::Triangle> triangles,
            const SpatialBuild& request, Memory& memory)
        : positions_(positions), triangles_(triangles), request_(request), memory_(memory) {}

    BuildNode* run(std::span<const Piece> pieces) {
        PieceSet all;
        all.pieces.reserve(pieces.size());
        double area = 0.0;
        for (const Piece& piece : pieces) {
            all.add(piece);
            area += box_of(piece).half_area();
        }
        all.room = request_.room;
        mean_area_ = area / static_cast<double>(pieces.size());
        overlap_worth_cutting_ = overlap_share_of_scene * all.box.half_area();
        return build(std::move(all), 1);
    }

  private:
    // Nodes are filled even where leaves become smaller than allowed: with leaves as large as
    // allowed, fewer nodes were 3 to 5 percent slower in one of two interiors, though their cost
    // was 3 percent lower.
    BuildNode* build(PieceSet set, std::uint32_t depth) {
        if (is_leaf(set, depth)) return leaf(set);
        std::vector<PieceSet> parts;
        parts.reserve(node_width);
        parts.push_back(std::move(set));
        while (parts.size() < node_width) {
            PieceSet* largest = nullptr;
            for (PieceSet& part : parts)
                if (part.pieces.size() > 1 &&
                    (largest == nullptr || part.box.half_area() > largest->box.half_area()))
                    largest = &part;
            if (largest == nullptr) break;
            auto [below, above] = part_in_two(std::move(*largest));
            *largest = std::move(below);
            parts.push_back(std::move(above));
        }
        auto* node = make<BuildInner>();
        node->child_count = static_cast<std::uint32_t>(parts.size());
        std::size_t pieces = 0;
        for (const PieceSet& part : parts) pieces += part.pieces.size();
        const auto build_child = [&](std::size_t i) {
            node->children[i] = build(std::move(parts[i]), depth + 1);
        };
        if (pieces < parallel_pieces)
            for (std::size_t i = 0; i < parts.size(); ++i) build_child(i);
        else
            tbb::parallel_for(std::size_t{0}, parts.size(), build_child);
        return node;
    }

    // Near the greatest depth everything becomes one leaf, which is turned into a balanced subtree
    // later, so levels are kept for that.
    bool is_leaf(const PieceSet& set, std::uint32_t depth) const noexcept {
        std::uint32_t levels = 2;
        for (std::size_t n = set.pieces.size(); n > request_.max_leaf; n /= node_width) ++levels;
        return set.pieces.size() <= request_.max_leaf || depth + levels > request_.max_depth;
    }

    BuildNode* leaf(const PieceSet& set) {
        const std::size_t count = set.pieces.size();
        auto* copies =
            static_cast<Piece*>(memory_.local().allocate(sizeof(Piece) * count, alignof(Piece)));
        std::uninitialized_copy_n(set.pieces.begin(), count, copies);
        auto* made = make<BuildLeaf>();
        made->piece_count = static_cast<std::uint32_t>(count);
        made->pieces = copies;
        return made;
    }

    template <typename Node>
    Node* make() {
        return new (memory_.local().allocate(sizeof(Node), alignof(Node))) Node;
    }

    std::pair<PieceSet, PieceSet> part_in_two(PieceSet set) const {
        const Split split =
            find_split(set, positions_, triangles_, node_width, overlap_worth_cutting_);
        std::pair<PieceSet, PieceSet> sides;
        auto& [below, above] = sides;
        if (split.spatial)
            cut(set, split, below, above);
        else if (std::isfinite(split.cost))
            for (const Piece& piece : set.pieces)
                (centre_of(piece)[split.axis] < split.position ? below : above).add(piece);
        // Centres are nearly equal, or a cut leaves nothing on one side.
        if (below.pieces.empty() || above.pieces.empty()) {
            below = above = PieceSet{};
            const std::size_t half = set.pieces.size() / 2;
            for (std::size_t i = 0; i < set.pieces.size(); ++i)
                (i < half ? below : above).add(set.pieces[i]);
        }
        share_room(set, below, above);
        return sides;
    }

    void cut(const PieceSet& set, const Split& split, PieceSet& below, PieceSet& above) const {
        std::size_t room = set.room;
        for (const Piece& piece : set.pieces) {
            const Box box = box_of(piece);
            const bool reaches_below = box.lower[split.axis] < split.position;
            const bool reaches_above = box.upper[split.axis] > split.position;
            if (!reaches_below || !reaches_above || room == 0) {
                const bool is_below = reaches_below == reaches_above
                                          ? centre_of(piece)[split.axis] < split.position
                                          : reaches_below;
                (is_below ? below : above).add(piece);
                continue;
            }
            const SplitBoxes parts = split_triangle(
                corners_of(positions_, triangles_[piece.primID]), box, split.axis, split.position);
            if (!parts.below.empty()) below.add(with_box(piece, parts.below));
            if (!parts.above.empty()) above.add(with_box(piece, parts.above));
            if (!parts.below.empty() && !parts.above.empty()) --room;
        }
    }

    // Shares the room for cuts by the number of pieces, with more for large ones, which cuts help
    // most.
    void share_room(const PieceSet& set, PieceSet& below, PieceSet& above) const noexcept {
        const std::size_t pieces = below.pieces.size() + above.pieces.size();
        const std::size_t added = pieces - set.pieces.size();
        const std::size_t left = set.room - std::min(set.room, added);
        const double share = weight(below) / (weight(below) + weight(above));
        below.room = std::min(left, static_cast<std::size_t>(share * static_cast<double>(left)));
        above.room = left - below.room;
    }

    // Weight of a set as in Embree's builder: 5 for a small piece, 31 for one much larger than the
    // mean.
    double weight(const PieceSet& set) const noexcept {
        double sum = 0.0;
        for (const Piece& piece : set.pieces) {
            const double size = std::ceil(10.0 * box_of(piece).half_area() / mean_area_);
            sum += 4.0 + std::clamp(size, 1.0, 27.0);
        }
        return sum;
    }

    std::span<const shared::float4> positions_;
    std::span<const shared::Triangle> triangles_;
    const SpatialBuild& request_;
    Memory& memory_;
    double mean_area_ = 0.0;
    double overlap_worth_cutting_ = 0.0;
};

}  // namespace

BuildTree build_spatial_tree(std::span<const Piece> pieces,
                             std::span<const shared::float4> positions,
                             std::span<const shared::Triangle> triangles,
                             const SpatialBuild& request) {
    if (pieces.empty()) return {};
    auto memory = std::make_shared<Memory>();
    BuildNode* root = Builder(positions, triangles, request, *memory).run(pieces);
    return {root, std::move(memory)};
}

}  // namespace weft
