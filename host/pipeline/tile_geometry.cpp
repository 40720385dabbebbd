// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tile_geometry.h"

#include <algorithm>
#include <cstddef>

#include "plan/work_order.h"

namespace weft {

TileGeometry::TileGeometry(Executor& executor, std::uint32_t width, std::uint32_t height)
    : grid_{width, height}, buffer_(allocate<kinds::Tiles>(executor, grid_.tiles(), "tiles")) {}

void TileGeometry::examine(FrameContext& frame, const GBuffer& gbuffer, const char* component) {
    frame.run(Stage::tile_geometry, component,
              kernels::tile_geometry{.surfaces = view(gbuffer), .tiles = buffer_}, {grid_.tiles()});
    records_ = read_buffer(frame.executor, buffer_, grid_.tiles());
    ordered_masks_.clear();
}

const WorkList& TileGeometry::ordered(FrameContext& frame, std::span<const TileMask> masks,
                                      const WorkList& round) {
    if (!std::equal(masks.begin(), masks.end(), ordered_masks_.begin(), ordered_masks_.end())) {
        ordered_ = ordered_round(frame, round);
        ordered_masks_.assign(masks.begin(), masks.end());
    }
    return ordered_;
}

WorkList ordered_round(FrameContext& frame, const WorkList& round) {
    WorkList ordered;
    frame.executor.with_mapped(
        *frame.buffers.gbuffer.gb_position, Access::read, [&](std::span<std::byte> bytes) {
            const std::span positions(reinterpret_cast<const shared::float4*>(bytes.data()),
                                      frame.pixels());
            ordered = ordered_by_place(round, positions, frame.params.scene.extent);
        });
    return ordered;
}

}  // namespace weft
