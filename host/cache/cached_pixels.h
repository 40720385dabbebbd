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

/// The irradiance of pixels, looked up in records, and which of them lack it. Stages belong to the
/// component that is named.
class CachedPixels {
  public:
    CachedPixels(Executor& executor, std::uint32_t width, std::uint32_t height);

    /// All pixels that reflect light lack it.
    void begin(FrameContext& frame, const char* component);
    /// Adds what the records of a store give to all pixels.
    void look_up(FrameContext& frame, const char* component, const RecordStore& store);
    /// Pixels that are to become records in a round with squares of that edge; see pick_missing.
    [[nodiscard]] std::vector<std::uint32_t> picks(Executor& executor, std::uint32_t edge) const;

    /// By pixel, float4: mean irradiance, and the weight of the records that gave it.
    [[nodiscard]] BufferRef<kinds::ReconstructedLight> irradiance() const { return irradiance_; }

  private:
    TileGrid grid_;
    DeviceBuffer<kinds::ReconstructedLight> irradiance_;
    DeviceBuffer<kinds::MissingPixels> missing_;
    DeviceBuffer<kinds::TileBounds> tile_boxes_;
};

/// Pixels in the order in which records of them are made fastest, in whole blocks.
[[nodiscard]] std::vector<std::uint32_t> record_order(FrameContext& frame,
                                                      const std::vector<std::uint32_t>& pixels);

}  // namespace weft

#endif
