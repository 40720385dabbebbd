// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <compare>
#include <new>
#include <vector>

#include "bvh/build_tree.h"

namespace weft {
namespace {

std::size_t widest_axis(std::span<const Piece> pieces) noexcept {
    Box centres;
    for (const Piece& piece : pieces) {
        const std::array<float, 3> centre = centre_of(piece);
        centres.extend({centre, centre});
    }
    std::array<double, 3> width{};
    for (std::size_t a = 0; a < 3; ++a)
        width[a] = double{centres.upper[a]} - double{centres.lower[a]};
    return static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
}

// The key by which pieces are ordered; their index only decides between equal ones.
struct Key {
    float centre;
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
            {centre_of(piece)[axis], piece.primID, static_cast<std::uint32_t>(keys.size())});
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
