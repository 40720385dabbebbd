// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_CACHED_PIXELS_H
#define WEFT_CACHE_CACHED_PIXELS_H

#include <cstdint>
#include <vector>

#include "cache/record_store.h"
#include "pipeline/frame_context.h"
#include "plan/tile_masks.h"

namespace weft {

/// Keeps the irradiance of pixels as looked up in records, and which pixels still lack it. Stages
/// count for the `component` that is passed.
class CachedPixels {
  public:
    CachedPixels(Executor& executor, std::uint32_t width, std::uint32_t height);

    /// Begins a frame: all pixels that reflect light lack irradiance.
    void begin_frame(FrameContext& frame, const char* component);
    /// Starts over in a frame: again they all do.
    void begin(FrameContext& frame, const char* component);
    /// Looks up all pixels in the records of a store and adds the irradiance that these give.
    void look_up(FrameContext& frame, const char* component, const RecordStore& store);
    /// Pixels of which a round with squares of that edge makes records; see pick_missing.
    [[nodiscard]] std::vector<std::uint32_t> picks(Executor& executor, std::uint32_t edge);
    /// Share of the pixels missing at the frame's first call of `picks` that have irradiance now; 0
    /// before it.
    [[nodiscard]] double lit_share(Executor& executor) const;

    /// By pixel, float4: mean irradiance, and the weight of the records that gave it.
    [[nodiscard]] BufferRef<kinds::ReconstructedLight> irradiance() const { return irradiance_; }

  private:
    [[nodiscard]] std::vector<TileMask> missing(Executor& executor) const;

    TileGrid grid_;
    std::size_t first_missing_ = 0;  ///< pixels; 0 before the frame's first `picks`
    DeviceBuffer<kinds::ReconstructedLight> irradiance_;
    DeviceBuffer<kinds::MissingPixels> missing_;
    DeviceBuffer<kinds::TileBounds> tile_boxes_;
};

/// Pixels in the order in which records of them are made fastest, padded to whole blocks.
[[nodiscard]] std::vector<std::uint32_t> record_order(FrameContext& frame,
                                                      const std::vector<std::uint32_t>& pixels);

}  // namespace weft

#endif
