// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_COMPONENTS_SOFT_SHADOWS_H
#define WEFT_COMPONENTS_SOFT_SHADOWS_H

#include <cstdint>
#include <memory>
#include <vector>

#include "frame/adaptive_sampling.h"
#include "schedule/shadow_states.h"

namespace weft {

/// Light of area lights with adaptive sampling: full density only in penumbrae and where something
/// may lie between, rays only to lights that are neither all seen nor all hidden.
class SoftShadows {
  public:
    SoftShadows(Executor& executor, const FlatScene& scene, const TileGrid& grid,
                const LevelSettings& settings, std::uint32_t features);

    /// Slots of the irradiance that `sample` makes.
    [[nodiscard]] std::uint32_t slots() const { return sampling_.slots(); }
    [[nodiscard]] const AdaptiveSampling& sampling() const { return sampling_; }

    /// Irradiance by slot, into the frame's direct irradiance.
    void sample(FrameContext& frame);
    /// Irradiance by pixel.
    void reconstruct(FrameContext& frame);

  private:
    void gather(FrameContext& frame, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] std::vector<Level> least_levels(FrameContext& frame);

    AdaptiveSampling sampling_;
    std::uint32_t groups_;
    std::unique_ptr<Buffer> light_boxes_, packet_shadows_, block_shadows_, tile_shadows_;
    std::vector<ShadowState> states_;         ///< by tile; none before they are known
    std::vector<std::uint32_t> block_words_;  ///< of all rounds so far
};

/// Lower corner, upper corner and plane (unit normal, offset; 0 where it is not flat, or shines to
/// both sides) of every area light, kernel units.
[[nodiscard]] std::vector<shared::float4> light_boxes(const FlatScene& scene);

}  // namespace weft

#endif
