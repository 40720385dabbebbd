// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_MOVING_BVH_H
#define WEFT_BVH_MOVING_BVH_H

#include <cstddef>
#include <cstdint>
#include <span>

#include "bvh/box.h"
#include "bvh/bvh_cache.h"
#include "bvh/wide_bvh.h"

namespace weft {

/// What the building of a BVH may cost.
enum class BvhEffort : std::uint8_t {
    best,  ///< rays are traced for long: spatial splits are tried
    soon   ///< somebody waits: no spatial splits, unless a cache has the tree with them
};

/// A BVH over triangles of which those from `first_moving` on may move. Its root has two subtrees:
/// one over the triangles that rest, as build_bvh makes it, and behind it one over those that may
/// move, without spatial splits. Where none may move it is the tree of build_bvh alone. It depends
/// only on the triangles as they are, not on where they were.
class MovingBvh {
  public:
    /// The part that rests comes from `cache` where that has it; may be null. `effort` holds for
    /// that part of a scene in which something moves; else it is the best. Rays that graze a
    /// triangle may find it in one tree and not in the other. Throws as build_bvh.
    MovingBvh(std::span<const shared::float4> positions,
              std::span<const shared::Triangle> triangles, std::size_t first_moving,
              const BvhSettings& settings, const BvhCache* cache = nullptr,
              BvhEffort effort = BvhEffort::best);

    /// Builds the root and the moving part anew after the moving triangles have changed, whose
    /// number must not. Where the padding differs the resting part is built anew, too; returns
    /// whether it was. Throws as build_bvh, or Error (exit code 3) where the number has changed;
    /// the BVH stays as it was then.
    bool update(std::span<const shared::float4> positions,
                std::span<const shared::Triangle> triangles, float padding);

    [[nodiscard]] bool moves() const noexcept { return first_moving_ < triangle_count_; }
    [[nodiscard]] const WideBvh& bvh() const noexcept { return bvh_; }

    /// Number of nodes before those of the moving part; updates change only the root among them.
    [[nodiscard]] std::size_t resting_nodes() const noexcept { return resting_nodes_; }
    /// Number of floats of the leaves before those of the moving part, which updates do not change.
    [[nodiscard]] std::size_t resting_floats() const noexcept { return resting_floats_; }

  private:
    // What the root needs of a tree below it.
    struct Part {
        std::uint32_t root = BVH_EMPTY;
        Box box{};
        std::uint32_t depth = 0;
        std::uint32_t stack_need = 1;
        bool has_spatial_splits = false;
        bool from_cache = false;
        double sah_cost = 0.0;
        double build_ms = 0.0;
    };

    void add_resting(WideBvh tree);
    void replace_moving(const WideBvh& tree);
    [[nodiscard]] WideBvh build_moving(std::span<const shared::float4> positions,
                                       std::span<const shared::Triangle> triangles) const;
    [[nodiscard]] static Part part_of(const WideBvh& tree, std::size_t first_node);
    void join(const Part& moving) noexcept;

    std::size_t first_moving_;
    std::size_t triangle_count_;
    BvhSettings settings_;
    BvhEffort effort_;
    Part resting_;
    std::size_t resting_nodes_ = 0;
    std::size_t resting_floats_ = 0;
    WideBvh bvh_;
};

}  // namespace weft

#endif
