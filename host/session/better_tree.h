// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_BETTER_TREE_H
#define WEFT_SESSION_BETTER_TREE_H

#include <filesystem>
#include <future>
#include <vector>

#include "device/executor.h"

namespace weft {

/// Builds the BVH that a scene has where nobody waits for it, in a thread of its own, and leaves it
/// in the cache of trees, from where TracedGeometry without `soon` takes it. Where the cache cannot
/// be written nothing comes of it.
class BetterTree {
  public:
    /// Copies the geometry, and begins. Throws std::bad_alloc.
    BetterTree(const TracedGeometry& geometry, std::filesystem::path cache);
    /// Waits until it is done.
    ~BetterTree() { wait(); }
    BetterTree(const BetterTree&) = delete;
    BetterTree& operator=(const BetterTree&) = delete;

    [[nodiscard]] bool is_done() const;
    void wait() const { done_.wait(); }

  private:
    std::vector<shared::float4> positions_;
    std::vector<shared::Triangle> triangles_;
    std::future<void> done_;
};

}  // namespace weft

#endif
