// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/moving_bvh.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "bvh/flatten.h"

namespace weft {
namespace {

// The root has at most two children, the second of which waits while the first is traversed.
constexpr std::uint32_t stack_of_root = 1;

Error no_memory() {
    return {ExitCode::out_of_memory, "out of memory while building the BVH"};
}

// Moves the references of a tree behind other `nodes` and leaf `entries`.
shared::BvhNode shifted(shared::BvhNode node, std::uint32_t nodes, std::uint32_t entries) noexcept {
    for (std::uint32_t& child : node.child)
        if (child != BVH_EMPTY) child += is_leaf(child) ? entries : nodes;
    return node;
}

void append_nodes(LargeVector<shared::BvhNode>& nodes, const WideBvh& tree, std::size_t entries) {
    const auto first = static_cast<std::uint32_t>(nodes.size());
    for (const shared::BvhNode& node : tree.nodes)
        nodes.push_back(shifted(node, first, static_cast<std::uint32_t>(entries)));
}

bool is_empty(const WideBvh& tree) noexcept {
    return leaf_entries(tree.leaves) == 0;
}

void check_size(std::size_t nodes, std::size_t entries) {
    if (nodes > BVH_LEAF)
        throw Error(ExitCode::bad_input, "the scene needs more than 2^31 nodes of its BVH");
    if (entries > std::size_t{BVH_FIRST_MASK} + 1)
        throw Error(ExitCode::bad_input, "the leaves of the BVH hold more than " +
                                             std::to_string(BVH_FIRST_MASK) + " entries");
}

// Makes room for `size` values, the first `kept` of which are there. Where that needs new memory,
// it has room for twice as many of those behind them.
template <class T>
void make_room(LargeVector<T>& values, std::size_t kept, std::size_t size) {
    if (size > values.capacity()) values.reserve(size + (size - kept));
}

}  // namespace

MovingBvh::MovingBvh(std::span<const shared::float4> positions,
                     std::span<const shared::Triangle> triangles, std::size_t first_moving,
                     const BvhSettings& settings, const BvhCache* cache, BvhEffort effort)
    : first_moving_(std::min(first_moving, triangles.size())),
      triangle_count_(triangles.size()),
      settings_(settings),
      effort_(effort) {
    const auto build = [&](std::span<const shared::Triangle> part, const BvhSettings& used) {
        return cache != nullptr ? cache->build(positions, part, used)
                                : build_bvh(positions, part, used);
    };
    const auto build_soon = [&](std::span<const shared::Triangle> part, BvhSettings used) {
        std::optional<WideBvh> kept;
        if (cache != nullptr) kept = cache->find(positions, part, used);
        if (kept) return *std::move(kept);
        used.spatial_splits = false;
        return build_bvh(positions, part, used);
    };
    if (!moves()) {
        bvh_ = build(triangles, settings_);
        resting_nodes_ = bvh_.nodes.size();
        resting_floats_ = bvh_.leaves.size();
        return;
    }
    BvhSettings below = settings_;
    below.max_stack -= stack_of_root;
    const auto rests = triangles.first(first_moving_);
    WideBvh resting = effort_ == BvhEffort::soon ? build_soon(rests, below) : build(rests, below);
    const WideBvh moving = build_moving(positions, triangles);
    try {
        add_resting(std::move(resting));
        replace_moving(moving);
    } catch (const std::bad_alloc&) {
        throw no_memory();
    }
}

bool MovingBvh::update(std::span<const shared::float4> positions,
                       std::span<const shared::Triangle> triangles, float padding) {
    if (triangles.size() != triangle_count_)
        throw Error(ExitCode::device, "the BVH was built of " + std::to_string(triangle_count_) +
                                          " triangles and cannot be brought up to date with " +
                                          std::to_string(triangles.size()));
    if (padding != settings_.padding) {
        BvhSettings settings = settings_;
        settings.padding = padding;
        *this = MovingBvh(positions, triangles, first_moving_, settings, nullptr, effort_);
        return true;
    }
    if (!moves()) return false;
    const WideBvh moving = build_moving(positions, triangles);
    try {
        replace_moving(moving);
    } catch (const std::bad_alloc&) {
        throw no_memory();
    }
    return false;
}

WideBvh MovingBvh::build_moving(std::span<const shared::float4> positions,
                                std::span<const shared::Triangle> triangles) const {
    BvhSettings settings = settings_;
    settings.spatial_splits = false;
    settings.max_stack -= stack_of_root;
    return build_bvh(positions, triangles, settings, first_moving_);
}

void MovingBvh::add_resting(WideBvh tree) {
    resting_ = part_of(tree, 1);
    resting_nodes_ = 1 + (is_empty(tree) ? 0 : tree.nodes.size());
    check_size(resting_nodes_, leaf_entries(tree.leaves));
    bvh_.nodes.reserve(resting_nodes_);
    bvh_.nodes.push_back(empty_node());
    if (!is_empty(tree)) append_nodes(bvh_.nodes, tree, 0);
    bvh_.leaves = std::move(tree.leaves);
    resting_floats_ = bvh_.leaves.size() - node_width;
}

void MovingBvh::replace_moving(const WideBvh& tree) {
    const Stopwatch watch;
    const std::size_t added = is_empty(tree) ? 0 : tree.nodes.size();
    const std::size_t entries = resting_floats_ / LEAF_ROWS;
    check_size(resting_nodes_ + added, entries + leaf_entries(tree.leaves));
    // Everything that can fail comes first, so that the tree never mixes old and new parts.
    make_room(bvh_.nodes, resting_nodes_, resting_nodes_ + added);
    make_room(bvh_.leaves, resting_floats_, resting_floats_ + tree.leaves.size());
    Part part = part_of(tree, resting_nodes_);
    bvh_.nodes.resize(resting_nodes_);
    if (added > 0) append_nodes(bvh_.nodes, tree, entries);
    bvh_.leaves.resize(resting_floats_);
    bvh_.leaves.insert(bvh_.leaves.end(), tree.leaves.begin(), tree.leaves.end());
    part.build_ms += watch.total();
    join(part);
}

MovingBvh::Part MovingBvh::part_of(const WideBvh& tree, std::size_t first_node) {
    Part part;
    part.build_ms = tree.build_ms;
    part.from_cache = tree.from_cache;
    if (is_empty(tree)) return part;
    part.root = static_cast<std::uint32_t>(first_node);
    for (std::size_t slot = 0; slot < node_width; ++slot)
        part.box.extend(child_box(tree.nodes[0], slot));
    part.depth = tree.depth;
    part.stack_need = tree.stack_need;
    part.has_spatial_splits = tree.has_spatial_splits;
    part.sah_cost = tree.sah_cost;
    return part;
}

void MovingBvh::join(const Part& moving) noexcept {
    shared::BvhNode root = empty_node();
    Box whole;
    double cost = 0.0;
    std::uint32_t count = 0;
    bvh_.depth = 0;
    bvh_.stack_need = 1;
    for (const Part* part : std::array<const Part*, 2>{&resting_, &moving}) {
        if (part->root == BVH_EMPTY) continue;
        set_child(root, count++, part->box, part->root);
        whole.extend(part->box);
        // Costs are weighted by the surfaces of the parts' boxes, relative to that of the whole.
        cost += part->sah_cost * part->box.half_area();
        bvh_.depth = std::max(bvh_.depth, part->depth);
        bvh_.stack_need = std::max(bvh_.stack_need, part->stack_need);
    }
    ++bvh_.depth;
    bvh_.stack_need += std::max(count, 1U) - 1;
    bvh_.has_spatial_splits = resting_.has_spatial_splits || moving.has_spatial_splits;
    bvh_.sah_cost = count == 0 ? 0.0 : 1.0 + cost / whole.half_area();
    bvh_.build_ms = resting_.build_ms + moving.build_ms;
    bvh_.from_cache = resting_.from_cache;
    bvh_.nodes[0] = root;
}

}  // namespace weft
