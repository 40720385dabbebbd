// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_SPLIT_SEARCH_H
#define WEFT_BVH_SPLIT_SEARCH_H

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "bvh/pieces.h"

namespace weft {

/// Pieces that a subtree will hold, with the boxes around them and around their centres, and how
/// many pieces cuts may still add to them.
struct PieceSet {
    std::vector<Piece> pieces;
    Box box;
    Box centres;
    std::size_t room = 0;

    /// Appends a piece and grows the boxes.
    void add(const Piece& piece);
};

/// How a set of pieces is split: by their centres, or at a plane that cuts those on both of its
/// sides.
struct Split {
    std::size_t axis = 0;
    float position = 0.0F;  ///< centres here or above are of the upper side; or the plane
    bool spatial = false;
    double cost = std::numeric_limits<double>::infinity();  ///< half area times blocks, summed
    std::size_t added = 0;                                  ///< pieces that cuts are likely to add
};

/// The best split by the surface area heuristic with leaves of `block` pieces: between centres,
/// or, where both sides would overlap much and the set has room, through triangles as well (Stich,
/// Friedrich and Dietrich 2009). `overlap_worth_cutting` is the half area below which an overlap
/// is not cut. A split of infinite cost means that all centres are equal.
[[nodiscard]] Split find_split(const PieceSet& set, std::span<const shared::float4> positions,
                               std::span<const shared::Triangle> triangles, std::size_t block,
                               double overlap_worth_cutting);

}  // namespace weft

#endif
