// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/cached_pixels.h"

#include "frame/adaptive_sampling.h"
#include "schedule/cache_picks.h"

namespace weft {

CachedPixels::CachedPixels(Executor& executor, std::uint32_t width, std::uint32_t height)
    : grid_{width, height},
      irradiance_(executor.allocate(std::size_t{width} * height * sizeof(shared::float4),
                                    "cached irradiance")),
      missing_(executor.allocate(grid_.tiles() * sizeof(TileMask), "missing pixels")),
      tile_boxes_(
          executor.allocate(grid_.tiles() * 2 * sizeof(shared::float4), "bounds of tiles")) {}

void CachedPixels::begin(FrameContext& frame, const char* component) {
    frame.run_whole([&] {
        frame.run(KernelId::cache_tiles, Stage::tile_bounds, component, false,
                  with_gbuffer(frame.buffers.gbuffer,
                               {tile_boxes_.get(), irradiance_.get(), missing_.get()}),
                  grid_.tiles());
    });
}

void CachedPixels::look_up(FrameContext& frame, const char* component, const RecordStore& store) {
    frame.params.cache_records = store.count();
    frame.run(KernelId::cache_lookup, Stage::cache_lookup, component, true,
              with_gbuffer(frame.buffers.gbuffer,
                           {tile_boxes_.get(), &store.records(), &store.boxes(), &store.used(),
                            irradiance_.get(), missing_.get(), frame.buffers.counters.get()}),
              grid_.tiles());
}

std::vector<std::uint32_t> CachedPixels::picks(Executor& executor, std::uint32_t edge) const {
    return pick_missing(grid_, read_buffer<TileMask>(executor, *missing_, grid_.tiles()), edge);
}

std::vector<std::uint32_t> record_order(FrameContext& frame,
                                        const std::vector<std::uint32_t>& pixels) {
    WorkList list{pixels, {}};
    list.pixels.resize((pixels.size() + PACKET_BLOCK - 1) / PACKET_BLOCK * PACKET_BLOCK,
                       NO_TRIANGLE);
    list.block_sets.resize(list.pixels.size() / PACKET_BLOCK, 0);
    return ordered_round(frame, list).pixels;
}

}  // namespace weft
