// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/better_tree.h"

#include <chrono>
#include <exception>
#include <utility>

#include "base/free_memory.h"
#include "bvh/bvh_cache.h"
#include "bvh/moving_bvh.h"

namespace weft {

BetterTree::BetterTree(const TracedGeometry& geometry, std::filesystem::path cache)
    : positions_(geometry.positions.begin(), geometry.positions.end()),
      triangles_(geometry.triangles.begin(), geometry.triangles.end()) {
    BvhSettings settings;
    settings.padding = geometry.box_padding;
    const auto build = [this, settings, first_moving = geometry.first_moving,
                        folder = std::move(cache)] {
        try {
            const BvhCache trees(folder);
            (void)MovingBvh(positions_, triangles_, first_moving, settings, &trees);
            return_free_memory();
        } catch (const std::exception&) {
            return;  // who needs the tree builds it, and tells why that fails
        }
    };
    // Where there can be no thread, wait() builds it.
    done_ = std::async(std::launch::async | std::launch::deferred, build);
}

bool BetterTree::is_done() const {
    return done_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
}

}  // namespace weft
