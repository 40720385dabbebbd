// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_SLABS_H
#define WEFT_BVH_SLABS_H

#include <array>
#include <cstddef>

#include "bvh/box.h"

namespace weft {

/// Equal slabs of a box along one axis, separated by planes that are floats. Each value lies in one
/// slab, and greater values in no lower one.
class Slabs {
  public:
    static constexpr std::size_t max_count = 32;

    /// `count` is at most max_count. Where the slabs would be too thin to be told apart there is
    /// one alone.
    Slabs(const Box& box, std::size_t axis, std::size_t count) noexcept;

    [[nodiscard]] std::size_t count() const noexcept { return count_; }

    /// The plane below slab `k`, for k from 1 to count() - 1.
    [[nodiscard]] float plane(std::size_t k) const noexcept { return planes_[k]; }

    /// The slab of a value; a value on a plane lies above it.
    [[nodiscard]] std::size_t slab_of(float value) const noexcept;

    /// The last slab that an interval from slab `first` up to `upper` reaches; a slab that only its
    /// end touches does not count.
    [[nodiscard]] std::size_t last_slab(std::size_t first, float upper) const noexcept;

  private:
    std::array<float, max_count> planes_{};
    double origin_ = 0.0;
    double scale_ = 0.0;
    std::size_t count_ = 1;
};

}  // namespace weft

#endif
