// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <compare>
#include <new>
#include <vector>

#include "bvh/build_tree.h"

namespace weft {
namespace {

double doubled_centre(const Piece& piece, std::size_t axis) noexcept {
    const Box box = box_of(piece);
    return double{box.lower[axis]} + double{box.upper[axis]};
}

std::size_t widest_axis(std::span<const Piece> pieces) noexcept {
    std::size_t best = 0;
    double best_width = -1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double low = doubled_centre(pieces[0], axis);
        double high = low;
        for (const Piece& piece : pieces) {
            low = std::min(low, doubled_centre(piece, axis));
            high = std::max(high, doubled_centre(piece, axis));
        }
        if (high - low > best_width) {
            best = axis;
            best_width = high - low;
        }
    }
    return best;
}

// What pieces are ordered by; their place only tells them apart where nothing else does.
struct Key {
    double centre;
    std::uint32_t id;
    std::uint32_t place;
    auto operator<=>(const Key&) const = default;
};

// Moves the lesser half of the pieces to the front.
void halve(std::span<Piece> pieces) {
    const std::size_t axis = widest_axis(pieces);
    std::vector<Key> keys;
    keys.reserve(pieces.size());
    for (const Piece& piece : pieces)
        keys.push_back(
            {doubled_centre(piece, axis), piece.primID, static_cast<std::uint32_t>(keys.size())});
    const auto middle = keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / 2);
    std::nth_element(keys.begin(), middle, keys.end());
    std::vector<Piece> ordered;
    ordered.reserve(pieces.size());
    for (const Key& key : keys) ordered.push_back(pieces[key.place]);
    std::copy(ordered.begin(), ordered.end(), pieces.begin());
}

struct Arena {
    std::pmr::monotonic_buffer_resource memory;
    std::vector<Piece> pieces;
};

}  // namespace

BuildNode* build_balanced_tree(std::span<Piece> pieces, std::uint32_t max_leaf,
                               std::pmr::memory_resource& arena) {
    if (pieces.size() <= max_leaf) {
        auto* leaf = new (arena.allocate(sizeof(BuildLeaf), alignof(BuildLeaf))) BuildLeaf;
        leaf->piece_count = static_cast<std::uint32_t>(pieces.size());
        leaf->pieces = pieces.data();
        return leaf;
    }
    std::vector<std::span<Piece>> parts{pieces};
    while (parts.size() < node_width) {
        const auto largest =
            std::max_element(parts.begin(), parts.end(),
                             [](const auto& a, const auto& b) { return a.size() < b.size(); });
        const std::span<Piece> part = *largest;
        if (part.size() <= max_leaf) break;
        halve(part);
        *largest = part.first(part.size() / 2);
        parts.push_back(part.subspan(part.size() / 2));
    }
    auto* node = new (arena.allocate(sizeof(BuildInner), alignof(BuildInner))) BuildInner;
    for (const std::span<Piece> part : parts)
        node->children[node->child_count++] = build_balanced_tree(part, max_leaf, arena);
    return node;
}

BuildTree build_balanced_tree(std::span<Piece> pieces, std::uint32_t max_leaf) {
    if (pieces.empty()) return {};
    auto arena = std::make_shared<Arena>();
    arena->pieces.assign(pieces.begin(), pieces.end());
    BuildNode* root = build_balanced_tree(arena->pieces, max_leaf, arena->memory);
    return {root, std::move(arena)};
}

}  // namespace weft
