// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/cached_pixels.h"

#include <bit>

#include "adaptive/adaptive_sampling.h"
#include "cache/cache_picks.h"

namespace weft {
namespace {

std::size_t pixels_in(const std::vector<TileMask>& masks) {
    std::size_t count = 0;
    for (const TileMask mask : masks) count += static_cast<std::size_t>(std::popcount(mask));
    return count;
}

}  // namespace

CachedPixels::CachedPixels(Executor& executor, std::uint32_t width, std::uint32_t height)
    : grid_{width, height},
      irradiance_(allocate<kinds::ReconstructedLight>(executor, std::size_t{width} * height,
                                                      "cached irradiance")),
      missing_(allocate<kinds::MissingPixels>(executor, 2 * grid_.tiles(), "missing pixels")),
      tile_boxes_(allocate<kinds::TileBounds>(executor, 2 * grid_.tiles(), "bounds of tiles")) {}

void CachedPixels::begin_frame(FrameContext& frame, const char* component) {
    first_missing_ = 0;
    begin(frame, component);
}

void CachedPixels::begin(FrameContext& frame, const char* component) {
    frame.run_whole([&] {
        frame.run(Stage::tile_bounds, component,
                  kernels::cache_tiles{.surfaces = view(frame.buffers.gbuffer),
                                       .tile_boxes = tile_boxes_,
                                       .filtered = irradiance_,
                                       .missing = missing_},
                  {grid_.tiles()});
    });
}

void CachedPixels::look_up(FrameContext& frame, const char* component, const RecordStore& store) {
    frame.run(Stage::cache_lookup, component,
              kernels::cache_lookup{.scene = frame.scene_buffers.seen_by_light(),
                                    .surfaces = view(frame.buffers.gbuffer),
                                    .record_count = store.count(),
                                    .tile_boxes = tile_boxes_,
                                    .records = store.records(),
                                    .boxes = store.boxes(),
                                    .used = store.used(),
                                    .filtered = irradiance_,
                                    .missing = missing_,
                                    .counters = frame.buffers.counters},
              {grid_.tiles()});
}

std::vector<TileMask> CachedPixels::missing(Executor& executor) const {
    return read_buffer<TileMask>(executor, *missing_, grid_.tiles());
}

std::vector<std::uint32_t> CachedPixels::picks(Executor& executor, std::uint32_t edge) {
    const std::vector<TileMask> masks = missing(executor);
    if (first_missing_ == 0) first_missing_ = pixels_in(masks);
    return pick_missing(grid_, masks, edge);
}

double CachedPixels::lit_share(Executor& executor) const {
    if (first_missing_ == 0) return 0.0;
    const std::size_t left = pixels_in(missing(executor));
    return 1.0 - static_cast<double>(left) / static_cast<double>(first_missing_);
}

std::vector<std::uint32_t> record_order(FrameContext& frame,
                                        const std::vector<std::uint32_t>& pixels) {
    WorkList list{pixels, {}};
    list.pixels.resize((pixels.size() + PACKET_BLOCK - 1) / PACKET_BLOCK * PACKET_BLOCK,
                       INVALID_INDEX);
    list.block_sets.resize(list.pixels.size() / PACKET_BLOCK, 0);
    return ordered_round(frame, list).pixels;
}

}  // namespace weft
