// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_EDGE_SAMPLES_H
#define WEFT_PIPELINE_EDGE_SAMPLES_H

#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/frame_context.h"
#include "plan/tile_masks.h"

namespace weft {

/// Pixels of all masks in the order of tiles, and row by row within a tile.
[[nodiscard]] std::vector<std::uint32_t> pixels_of(const TileGrid& grid,
                                                   std::span<const TileMask> masks);

/// Anti-aliasing: traces further primary rays through the edge pixels of a frame. Their irradiance
/// is taken from what the components have reconstructed.
class EdgeSamples {
  public:
    EdgeSamples(Executor& executor, std::uint32_t width, std::uint32_t height);

    /// Finds the edge pixels of the frame's G-buffer.
    void find(FrameContext& frame);

    /// Adds the edge pixels to the film, which composition leaves out of it.
    void sample(FrameContext& frame);

    /// Bits of the edge pixels by tile, for compose.cl.
    [[nodiscard]] BufferRef<kinds::EdgeMasks> masks() const { return masks_; }
    /// Number of edge pixels in the last frame.
    [[nodiscard]] std::uint32_t pixels() const { return pixels_; }

  private:
    TileGrid grid_;
    DeviceBuffer<kinds::EdgeMasks> masks_;
    DeviceBuffer<kinds::EdgePixels> list_;
    std::uint32_t pixels_ = 0;
};

}  // namespace weft

#endif
