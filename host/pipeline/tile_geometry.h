// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_TILE_GEOMETRY_H
#define WEFT_PIPELINE_TILE_GEOMETRY_H

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/frame_context.h"
#include "plan/tile_masks.h"
#include "plan/work_list.h"

namespace weft {

/// The tiles of an image and the geometry that the G-buffer has in each, for all adaptive
/// components.
class TileGeometry {
  public:
    TileGeometry(Executor& executor, std::uint32_t width, std::uint32_t height);

    /// Launches tile_geometry.cl on a G-buffer and reads its records. `component` is what it is
    /// for; the G-buffer of the image serves all.
    void examine(FrameContext& frame, const GBuffer& gbuffer, const char* component = "");

    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    [[nodiscard]] std::span<const shared::TileRecord> records() const { return records_; }
    [[nodiscard]] BufferRef<kinds::Tiles> buffer() const { return buffer_; }

    /// `round` in the order of ordered_by_place. `masks` are its pixels: since the components of a
    /// frame mostly begin with the same ones, the last order is used again where they are equal.
    [[nodiscard]] const WorkList& ordered(FrameContext& frame, std::span<const TileMask> masks,
                                          const WorkList& round);

  private:
    TileGrid grid_;
    DeviceBuffer<kinds::Tiles> buffer_;
    std::vector<shared::TileRecord> records_;
    std::vector<TileMask> ordered_masks_;
    WorkList ordered_;
};

/// `round` in the order of ordered_by_place, by the positions in the frame's G-buffer.
[[nodiscard]] WorkList ordered_round(FrameContext& frame, const WorkList& round);

}  // namespace weft

#endif
