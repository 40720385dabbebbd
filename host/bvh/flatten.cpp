// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/flatten.h"

#include <algorithm>
#include <cfloat>
#include <memory_resource>
#include <string>
#include <vector>

#include "base/error.h"
#include "bvh/leaves.h"

namespace weft {
namespace {

class Flattener {
  public:
    Flattener(std::span<const shared::float4> positions,
              std::span<const shared::Triangle> triangles, const BvhSettings& settings)
        : positions_(positions),
          triangles_(triangles),
          settings_(settings),
          listed_(triangles.size(), false) {}

    WideBvh run(const BuildTree& tree) {
        if (tree.root == nullptr) {
            bvh_.nodes.push_back(empty_node());
            bvh_.depth = 1;
            bvh_.stack_need = 1;
            return std::move(bvh_);
        }
        BuildInner above;
        const BuildNode* root = tree.root;
        if (root->child_count == 0) {
            above.child_count = 1;
            above.children[0] = tree.root;
            root = &above;
        }
        const Subtree whole = add_node(static_cast<const BuildInner&>(*root));
        bvh_.depth = whole.depth;
        bvh_.stack_need = whole.stack_need;
        bvh_.sah_cost = sah_cost(bvh_);
        return std::move(bvh_);
    }

  private:
    struct Subtree {
        std::uint32_t reference = BVH_EMPTY;
        Box box;
        std::uint32_t depth = 0;
        std::uint32_t stack_need = 1;  // the entry that is the subtree itself
    };

    // Depth is bounded by the limit the tree was built with.
    Subtree add_node(const BuildInner& inner) {
        const std::size_t index = bvh_.nodes.size();
        if (index >= BVH_LEAF)
            throw Error(ExitCode::bad_input, "the scene needs more than 2^31 nodes of its BVH");
        bvh_.nodes.push_back(empty_node());
        Subtree result{static_cast<std::uint32_t>(index), {}, 0, 1};
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < inner.child_count; ++i) {
            const BuildNode& below = *inner.children[i];
            if (below.child_count == 0 && below.piece_count == 0) continue;
            const Subtree child = add_child(below);
            set_child(bvh_.nodes[index], count++, child.box, child.reference);
            result.box.extend(child.box);
            result.depth = std::max(result.depth, child.depth);
            result.stack_need = std::max(result.stack_need, child.stack_need);
        }
        ++result.depth;
        // Popping the node makes room for one; all its children may be hit and pushed, and the
        // neediest of them popped while the others wait.
        result.stack_need += std::max(count, 1U) - 1;
        return result;
    }

    Subtree add_child(const BuildNode& node) {
        if (node.child_count > 0) return add_node(static_cast<const BuildInner&>(node));
        const auto& leaf = static_cast<const BuildLeaf&>(node);
        if (leaf.piece_count <= settings_.max_leaf_triangles)
            return add_leaf({leaf.pieces, leaf.piece_count});
        std::vector<Piece> pieces(leaf.pieces, leaf.pieces + leaf.piece_count);
        const BuildTree subtree = build_balanced_tree(pieces, settings_.max_leaf_triangles);
        return add_child(*subtree.root);
    }

    Subtree add_leaf(std::span<const Piece> pieces) {
        const std::size_t first = leaf_entries(bvh_.leaves);
        Subtree result;
        ids_.clear();
        for (const Piece& piece : pieces) {
            result.box.extend(box_of(piece));
            ids_.push_back(piece.primID);
        }
        // Splits may leave several pieces of one triangle in a leaf.
        std::sort(ids_.begin(), ids_.end());
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
        if (first + ids_.size() > std::size_t{BVH_FIRST_MASK} + 1)
            throw Error(ExitCode::bad_input, "the leaves of the BVH hold more than " +
                                                 std::to_string(BVH_FIRST_MASK) + " entries");
        leaf_.clear();
        for (const std::uint32_t id : ids_) {
            bvh_.has_spatial_splits |= listed_[id];
            listed_[id] = true;
            leaf_.push_back({corners_of(positions_, triangles_[id]), id});
        }
        append_leaf(bvh_.leaves, leaf_);
        result.box = result.box.grown(settings_.padding);
        result.reference = BVH_LEAF | static_cast<std::uint32_t>(ids_.size()) << BVH_COUNT_SHIFT |
                           static_cast<std::uint32_t>(first);
        return result;
    }

    std::span<const shared::float4> positions_;
    std::span<const shared::Triangle> triangles_;
    const BvhSettings& settings_;
    std::vector<bool> listed_;
    std::vector<std::uint32_t> ids_;
    std::vector<LeafTriangle> leaf_;
    WideBvh bvh_;
};

}  // namespace

shared::BvhNode empty_node() noexcept {
    shared::BvhNode node{};
    for (std::size_t slot = 0; slot < node_width; ++slot) {
        for (std::size_t a = 0; a < 3; ++a) {
            node.bounds[2 * a][slot] = FLT_MAX;
            node.bounds[2 * a + 1][slot] = -FLT_MAX;
        }
        node.child[slot] = BVH_EMPTY;
    }
    return node;
}

void set_child(shared::BvhNode& node, std::size_t slot, const Box& box,
               std::uint32_t reference) noexcept {
    for (std::size_t a = 0; a < 3; ++a) {
        node.bounds[2 * a][slot] = box.lower[a];
        node.bounds[2 * a + 1][slot] = box.upper[a];
    }
    node.child[slot] = reference;
}

Box child_box(const shared::BvhNode& node, std::size_t slot) noexcept {
    Box box;
    for (std::size_t a = 0; a < 3; ++a) {
        box.lower[a] = node.bounds[2 * a][slot];
        box.upper[a] = node.bounds[2 * a + 1][slot];
    }
    return box;
}

double sah_cost(const WideBvh& bvh) noexcept {
    if (leaf_entries(bvh.leaves) == 0) return 0.0;
    Box whole;
    for (std::size_t slot = 0; slot < node_width; ++slot)
        whole.extend(child_box(bvh.nodes[0], slot));
    double sum = 0.0;
    for (const shared::BvhNode& node : bvh.nodes) {
        for (std::size_t slot = 0; slot < node_width; ++slot) {
            const std::uint32_t child = node.child[slot];
            if (child == BVH_EMPTY) continue;
            sum += child_box(node, slot).half_area();
        }
    }
    return 1.0 + sum / whole.half_area();
}

WideBvh flatten(const BuildTree& tree, std::span<const shared::float4> positions,
                std::span<const shared::Triangle> triangles, const BvhSettings& settings) {
    return Flattener(positions, triangles, settings).run(tree);
}

}  // namespace weft
