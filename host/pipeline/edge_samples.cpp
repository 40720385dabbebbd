// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/edge_samples.h"

#include <bit>
#include <cmath>

namespace weft {

std::vector<std::uint32_t> pixels_of(const TileGrid& grid, std::span<const TileMask> masks) {
    std::vector<std::uint32_t> pixels;
    for (std::uint32_t tile = 0; tile < masks.size(); ++tile) {
        const std::uint32_t left = tile % grid.columns() * TILE_EDGE;
        const std::uint32_t top = tile / grid.columns() * TILE_EDGE;
        for (TileMask rest = masks[tile]; rest != 0; rest &= rest - 1) {
            const auto bit = static_cast<std::uint32_t>(std::countr_zero(rest));
            pixels.push_back((top + bit / TILE_EDGE) * grid.width + left + bit % TILE_EDGE);
        }
    }
    return pixels;
}

EdgeSamples::EdgeSamples(Executor& executor, std::uint32_t width, std::uint32_t height)
    : grid_{width, height},
      masks_(allocate<kinds::EdgeMasks>(executor, 2 * grid_.tiles(), "edge masks")),
      list_(allocate<kinds::EdgePixels>(executor, std::size_t{width} * height, "edge pixels")) {}

void EdgeSamples::find(FrameContext& frame) {
    frame.run(Stage::edge_detection, "",
              kernels::edge_masks{.surfaces = view(frame.buffers.gbuffer),
                                  .instances = frame.scene_buffers.geometry.instances,
                                  .masks = masks_},
              {grid_.tiles()});
    const std::vector<std::uint32_t> words =
        read_buffer(frame.executor, masks_, std::size_t{2} * grid_.tiles());
    std::vector<TileMask> masks;
    masks.reserve(grid_.tiles());
    for (std::size_t i = 0; i < words.size(); i += 2)
        masks.push_back(TileMask{words[i + 1]} << 32 | words[i]);
    const std::vector<std::uint32_t> pixels = pixels_of(grid_, masks);
    pixels_ = static_cast<std::uint32_t>(pixels.size());
    write_buffer(frame.executor, list_, pixels);
}

void EdgeSamples::sample(FrameContext& frame) {
    const FrameBuffers& buffers = frame.buffers;
    const shared::RenderParams& params = frame.params;
    // Rays that share a pixel share the area that a texture lookup covers.
    const std::uint32_t samples = params.sampling.edge_samples;
    const float share = std::sqrt(static_cast<float>(samples) + 1.0F);
    const std::uint32_t pixels_per_item =
        shared::edge_pixels_of_item(frame.executor.lanes(), samples);
    frame.run(Stage::edge_samples, "",
              kernels::edge_samples{.scene = *frame.scene_buffers.traced,
                                    .geometry = view(frame.scene_buffers.geometry),
                                    .environment = view(frame.scene_buffers.environment),
                                    .surfaces = view(buffers.gbuffer),
                                    .composed = buffers.composed(),
                                    .edge_pixel_count = pixels_,
                                    .texture_angle = params.camera.texture_angle / share,
                                    .slots = buffers.slots,
                                    .edge_pixels = list_,
                                    .film_high = buffers.film_high,
                                    .film_low = buffers.film_low,
                                    .nonfinite = buffers.nonfinite,
                                    .counters = buffers.counters},
              {(pixels_ + pixels_per_item - 1) / pixels_per_item});
}

}  // namespace weft
