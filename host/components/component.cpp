// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/component.h"

#include <algorithm>
#include <array>

namespace weft {

std::span<const Component> components() {
    static const std::array all{direct_component(), indirect_component(), vpl_residual_component()};
    return all;
}

std::uint32_t gather_items_per_launch(const Executor& executor, std::uint32_t list_length) {
    constexpr std::uint32_t rays_per_launch = 1U << 20;
    const std::uint32_t rays_per_item = executor.lanes() * std::max(1U, list_length);
    const std::uint32_t items = std::max(64U, rays_per_launch / rays_per_item);
    // Devices with many lanes take their own, larger chunk.
    return executor.device().is_cpu ? items : 0;
}

}  // namespace weft
