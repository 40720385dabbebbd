// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/split_search.h"

#include <algorithm>
#include <array>

#include "bvh/slabs.h"
#include "bvh/split_triangle.h"

namespace weft {
namespace {

// Slabs of an axis that are searched, as many as Embree's builder takes.
constexpr std::size_t object_slabs = 32;
constexpr std::size_t spatial_slabs = 16;

// Cutting is tried where the sides overlap by this share of the surface, and preferred where it
// costs less than this share of the other; both as in Embree's builder.
constexpr double overlap_share = 0.1;
constexpr double spatial_advantage = 0.99;

// The contents of a slab: the box of its parts, and how many pieces begin and end there.
struct Slab {
    Box box;
    std::size_t begins = 0;
    std::size_t ends = 0;
};

using SlabRow = std::array<Slab, Slabs::max_count>;

// The cheapest place to split a row of slabs, with the boxes of both sides.
struct Cut {
    double cost = std::numeric_limits<double>::infinity();
    std::size_t slab = 0;  // the first of the upper side
    std::size_t pieces = 0;
    Box below, above;
};

Cut cheapest_cut(const SlabRow& row, std::size_t count, std::size_t block) noexcept {
    std::array<Box, Slabs::max_count> above;
    std::array<std::size_t, Slabs::max_count> above_count{};
    Box box;
    std::size_t pieces = 0;
    for (std::size_t k = count; k-- > 1;) {
        box.extend(row[k].box);
        pieces += row[k].ends;
        above[k] = box;
        above_count[k] = pieces;
    }
    const auto blocks = [&](std::size_t n) { return static_cast<double>((n + block - 1) / block); };
    Cut best;
    box = Box{};
    pieces = 0;
    for (std::size_t k = 1; k < count; ++k) {
        box.extend(row[k - 1].box);
        pieces += row[k - 1].begins;
        if (pieces == 0 || above_count[k] == 0) continue;
        const double cost =
            box.half_area() * blocks(pieces) + above[k].half_area() * blocks(above_count[k]);
        if (cost < best.cost) best = {cost, k, pieces + above_count[k], box, above[k]};
    }
    return best;
}

struct ObjectSplit {
    Split split;
    Box overlap;
};

ObjectSplit find_object_split(const PieceSet& set, std::size_t block) noexcept {
    ObjectSplit best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Slabs slabs(set.centres, axis, object_slabs);
        if (slabs.count() < 2) continue;
        SlabRow row;
        for (const Piece& piece : set.pieces) {
            Slab& slab = row[slabs.slab_of(centre_of(piece)[axis])];
            slab.box.extend(box_of(piece));
            ++slab.begins;
            ++slab.ends;
        }
        const Cut cut = cheapest_cut(row, slabs.count(), block);
        if (cut.cost >= best.split.cost) continue;
        best.split = {axis, slabs.plane(cut.slab), false, cut.cost, 0};
        best.overlap = cut.below.common(cut.above);
    }
    return best;
}

// Adds the parts of a piece to the slabs they lie in.
void add_parts(const Piece& piece, const Corners& corners, const Slabs& slabs, std::size_t axis,
               SlabRow& row) noexcept {
    Box rest = box_of(piece);
    std::size_t first = slabs.slab_of(rest.lower[axis]);
    const std::size_t last = slabs.last_slab(first, rest.upper[axis]);
    std::size_t k = first;
    bool begun = false;
    std::size_t end = first;
    for (; k < last && !rest.empty(); ++k) {
        const SplitBoxes parts = split_triangle(corners, rest, axis, slabs.plane(k + 1));
        rest = parts.above;
        if (parts.below.empty()) continue;
        row[k].box.extend(parts.below);
        if (!begun) first = k;
        begun = true;
        end = k;
    }
    if (!rest.empty()) {
        row[k].box.extend(rest);
        if (!begun) first = k;
        end = k;
    }
    ++row[first].begins;
    ++row[end].ends;
}

Split find_spatial_split(const PieceSet& set, std::span<const shared::float4> positions,
                         std::span<const shared::Triangle> triangles, std::size_t block) noexcept {
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Slabs slabs(set.box, axis, spatial_slabs);
        if (slabs.count() < 2) continue;
        SlabRow row;
        for (const Piece& piece : set.pieces)
            add_parts(piece, corners_of(positions, triangles[piece.primID]), slabs, axis, row);
        const Cut cut = cheapest_cut(row, slabs.count(), block);
        if (cut.cost >= best.cost) continue;
        best = {axis, slabs.plane(cut.slab), true, cut.cost, cut.pieces - set.pieces.size()};
    }
    return best;
}

}  // namespace

void PieceSet::add(const Piece& piece) {
    pieces.push_back(piece);
    box.extend(box_of(piece));
    const std::array<float, 3> centre = centre_of(piece);
    centres.extend({centre, centre});
}

Split find_split(const PieceSet& set, std::span<const shared::float4> positions,
                 std::span<const shared::Triangle> triangles, std::size_t block,
                 double overlap_worth_cutting) {
    const auto [object, overlap] = find_object_split(set, block);
    const double shared = overlap.half_area();
    if (set.room == 0 || shared < overlap_worth_cutting ||
        shared < overlap_share * set.box.half_area())
        return object;
    const Split spatial = find_spatial_split(set, positions, triangles, block);
    const bool better = spatial.cost < spatial_advantage * object.cost;
    return better && spatial.added <= set.room ? spatial : object;
}

}  // namespace weft
