// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "bvh/coverage.h"
#include "bvh/flatten.h"
#include "bvh/leaves.h"
#include "bvh/pieces.h"
#include "bvh/wide_bvh.h"

namespace weft {
namespace {

bool is_finite(const Box& box) noexcept {
    bool finite = true;
    for (std::size_t a = 0; a < 3; ++a)
        finite = finite && std::isfinite(box.lower[a]) && std::isfinite(box.upper[a]);
    return finite;
}

bool same(const shared::float4& a, const shared::float4& b) noexcept {
    return std::memcmp(&a, &b, 3 * sizeof(float)) == 0;
}

std::string text(const char* what, std::size_t index, const char* problem) {
    return std::string(what) + " " + std::to_string(index) + " " + problem;
}

class Checker {
  public:
    Checker(const WideBvh& bvh, std::span<const shared::float4> positions,
            std::span<const shared::Triangle> triangles, const BvhSettings& settings)
        : bvh_(bvh), positions_(positions), triangles_(triangles), settings_(settings) {}

    std::string run() {
        std::string problem = check_indices();
        if (problem.empty()) problem = check_nodes();
        if (problem.empty()) problem = check_extent();
        if (problem.empty()) problem = check_leaf_triangles();
        if (problem.empty()) problem = check_scene();
        return problem;
    }

  private:
    // A node that is still to be visited, and the box that its parent stores for it.
    struct Visit {
        std::uint32_t node;
        std::uint32_t parent;
        Box box;
    };

    std::string check_indices() const {
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const shared::Triangle& t = triangles_[i];
            if (std::max({t.v0, t.v1, t.v2}) >= positions_.size())
                return text("triangle", i, "has a vertex index out of range");
        }
        return {};
    }

    // Walks from the root; where this finds no error, references are in range and form a tree.
    std::string check_nodes() {
        if (bvh_.nodes.empty()) return "there is no root";
        if (bvh_.nodes.size() > BVH_LEAF) return "there are more nodes than references can name";
        parent_.assign(bvh_.nodes.size(), BVH_EMPTY);
        if (bvh_.leaves.size() != LEAF_ROWS * leaf_entries(bvh_.leaves) + node_width)
            return "the rows of the leaves have a wrong length";
        leaf_box_.assign(leaf_entries(bvh_.leaves), Box{});
        leaf_of_.assign(leaf_entries(bvh_.leaves), BVH_EMPTY);
        const float all = INFINITY;
        std::vector<Visit> open{{0, 0, {{-all, -all, -all}, {all, all, all}}}};
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            if (parent_[visit.node] != BVH_EMPTY)
                return text("node", visit.node, "is reached twice");
            parent_[visit.node] = visit.parent;
            order_.push_back(visit.node);
            std::string problem = check_children(visit, open);
            if (!problem.empty()) return problem;
        }
        for (std::size_t i = 0; i < parent_.size(); ++i)
            if (parent_[i] == BVH_EMPTY) return text("node", i, "is never reached");
        return {};
    }

    std::string check_children(const Visit& visit, std::vector<Visit>& open) {
        const shared::BvhNode& node = bvh_.nodes[visit.node];
        std::size_t count = 0;
        for (std::size_t slot = 0; slot < node_width; ++slot) {
            const std::uint32_t child = node.child[slot];
            const Box box = child_box(node, slot);
            if (child == BVH_EMPTY) {
                const Box never;
                if (box.lower != never.lower || box.upper != never.upper)
                    return text("node", visit.node, "has an empty child that rays can hit");
                continue;
            }
            ++count;
            if (!is_finite(box) || box.empty())
                return text("node", visit.node, "has a child whose box is empty or not finite");
            if (!visit.box.contains(box))
                return text("node", visit.node, "has a child outside its own box");
            if (is_leaf(child)) {
                std::string problem = check_leaf(child, box);
                if (!problem.empty()) return problem;
            } else if (child >= bvh_.nodes.size()) {
                return text("node", visit.node, "refers to a node that does not exist");
            } else {
                open.push_back({child, visit.node, box});
            }
        }
        if (count == 0 && visit.node != 0) return text("node", visit.node, "has no children");
        return {};
    }

    std::string check_leaf(std::uint32_t child, const Box& box) {
        const std::size_t first = leaf_first(child);
        const std::size_t count = leaf_count(child);
        if (count < 1 || count > settings_.max_leaf_triangles)
            return text("the leaf at triangle", first, "has a count out of range");
        if (first + count > leaf_of_.size())
            return text("the leaf at triangle", first, "ends behind the last triangle");
        for (std::size_t i = first; i < first + count; ++i) {
            if (leaf_of_[i] != BVH_EMPTY) return text("leaf triangle", i, "is in two leaves");
            leaf_of_[i] = child;
            leaf_box_[i] = box;
        }
        return {};
    }

    // Checks depth and stack, from the last node of the walk back to the root.
    std::string check_extent() const {
        std::vector<std::uint32_t> depth(bvh_.nodes.size(), 0);
        std::vector<std::uint32_t> need(bvh_.nodes.size(), 1);
        for (auto it = order_.rbegin(); it != order_.rend(); ++it) {
            const auto& children = bvh_.nodes[*it].child;
            const auto empty = std::count(std::begin(children), std::end(children), BVH_EMPTY);
            const auto count = static_cast<std::uint32_t>(node_width) - std::uint32_t(empty);
            ++depth[*it];
            need[*it] += std::max(count, 1U) - 1;
            if (*it == 0) continue;
            const std::uint32_t parent = parent_[*it];
            depth[parent] = std::max(depth[parent], depth[*it]);
            need[parent] = std::max(need[parent], need[*it]);
        }
        if (depth[0] != bvh_.depth) return text("the depth is", depth[0], "not as stated");
        if (need[0] != bvh_.stack_need) return text("the stack need is", need[0], "not as stated");
        if (need[0] > BVH_STACK) return text("the stack need", need[0], "is too large");
        return {};
    }

    std::string check_leaf_triangles() {
        std::vector<std::uint32_t> ids(leaf_of_.size());
        first_box_.assign(triangles_.size() + 1, 0);
        for (std::size_t i = 0; i < leaf_of_.size(); ++i)
            if (leaf_of_[i] == BVH_EMPTY) return text("leaf triangle", i, "is in no leaf");
        for (std::size_t i = 0; i < leaf_of_.size(); ++i) {
            const auto [found, id] =
                leaf_triangle(bvh_.leaves, leaf_of_[i], i - leaf_first(leaf_of_[i]));
            if (id >= triangles_.size()) return text("leaf triangle", i, "has an id out of range");
            const Corners corners = corners_of(positions_, triangles_[id]);
            if (!same(found[0], corners[0]) || !same(found[1], corners[1]) ||
                !same(found[2], corners[2]))
                return text("leaf triangle", i, "differs from the triangle it stands for");
            ids[i] = id;
            ++first_box_[id + 1];
        }
        const bool repeated = std::any_of(first_box_.begin(), first_box_.end(),
                                          [](std::size_t count) { return count > 1; });
        std::partial_sum(first_box_.begin(), first_box_.end(), first_box_.begin());
        std::vector<std::size_t> next(first_box_.begin(), first_box_.end() - 1);
        boxes_.resize(ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i) boxes_[next[ids[i]]++] = leaf_box_[i];
        if (repeated != bvh_.has_spatial_splits)
            return "whether triangles are split is not as stated";
        return {};
    }

    std::string check_scene() const {
        std::atomic<std::size_t> first_wrong{triangles_.size()};
        const auto check = [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t id = range.begin(); id < range.end(); ++id) {
                if (problem_of(id) == nullptr) continue;
                std::size_t least = first_wrong;
                while (id < least && !first_wrong.compare_exchange_weak(least, id)) continue;
                return;
            }
        };
        constexpr std::size_t grain = 4096;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles_.size(), grain), check);
        if (first_wrong == triangles_.size()) return {};
        return text("triangle", first_wrong, problem_of(first_wrong));
    }

    // What is wrong with where a triangle is found, or null.
    const char* problem_of(std::size_t id) const {
        const Corners corners = corners_of(positions_, triangles_[id]);
        const auto boxes =
            std::span(boxes_).subspan(first_box_[id], first_box_[id + 1] - first_box_[id]);
        if (!can_be_hit(corners)) return boxes.empty() ? nullptr : "should have been left out";
        if (boxes.empty()) return "is in no leaf";
        return is_covered(corners, boxes) ? nullptr : "is not covered by the boxes of its leaves";
    }

    bool is_covered(const Corners& corners, std::span<const Box> boxes) const {
        if (boxes.size() == 1) return boxes[0].contains(box_of(corners).grown(settings_.padding));
        // One of the boxes may hold the whole triangle; otherwise they must cover it together,
        // without their padding.
        std::vector<Box> shrunk(boxes.begin(), boxes.end());
        for (Box& box : shrunk) {
            for (std::size_t a = 0; a < 3; ++a) {
                box.lower[a] += settings_.padding;
                box.upper[a] -= settings_.padding;
            }
        }
        return boxes_cover(corners, shrunk);
    }

    const WideBvh& bvh_;
    std::span<const shared::float4> positions_;
    std::span<const shared::Triangle> triangles_;
    const BvhSettings& settings_;
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint32_t> order_;
    std::vector<Box> leaf_box_;
    std::vector<std::uint32_t> leaf_of_;  // reference of the leaf that holds an entry
    // Boxes of the leaves that hold triangle i: boxes_ from first_box_[i] to first_box_[i + 1].
    std::vector<std::size_t> first_box_;
    std::vector<Box> boxes_;
};

}  // namespace

std::string check_bvh(const WideBvh& bvh, std::span<const shared::float4> positions,
                      std::span<const shared::Triangle> triangles, const BvhSettings& settings) {
    return Checker(bvh, positions, triangles, settings).run();
}

}  // namespace weft
