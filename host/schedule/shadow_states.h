// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCHEDULE_SHADOW_STATES_H
#define WEFT_SCHEDULE_SHADOW_STATES_H

#include <cstdint>
#include <span>
#include <vector>

#include "schedule/tile_masks.h"
#include "schedule/work_list.h"

namespace weft {

/// What is to be done about each group of area lights: bit g of `trace` asks for rays, bit g of
/// `open` says that all of it is seen; neither says that nothing of it is. Of the groups to trace,
/// those in `penumbra` are seen in part by every sample.
struct ShadowState {
    std::uint16_t trace = 0;
    std::uint16_t open = 0;
    std::uint16_t penumbra = 0;

    bool operator==(const ShadowState&) const = default;
};

/// Groups of `lights` area lights whose shadows are told apart.
[[nodiscard]] std::uint32_t shadow_groups(std::uint32_t lights);

/// The state in which rays are traced to all groups.
[[nodiscard]] ShadowState traced_state(std::uint32_t groups);

/// The state of every tile from what its first samples saw: rays where a light is seen by some and
/// not by others, or by all but with something that may lie between; none where nothing can, or
/// where nobody saw it.
[[nodiscard]] std::vector<ShadowState> shadow_states(std::span<const shared::TileShadows> tiles,
                                                     std::uint32_t groups);

/// The least level of every tile: full where rays are traced, because a shadow of any size may lie
/// between samples; middle inside penumbrae, which change slowly.
[[nodiscard]] std::vector<Level> shadow_levels(std::span<const ShadowState> states);

/// For every block of the list the word that soft_shadows.cl reads: what its pixels' tiles agree
/// on, and rays where they do not.
[[nodiscard]] std::vector<std::uint32_t> block_shadows(const TileGrid& grid, const WorkList& list,
                                                       std::span<const ShadowState> states,
                                                       std::uint32_t groups);

}  // namespace weft

#endif
