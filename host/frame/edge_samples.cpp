// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/edge_samples.h"

#include <bit>
#include <cmath>
#include <utility>

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
      masks_(executor.allocate(grid_.tiles() * sizeof(TileMask), "edge masks")),
      list_(executor.allocate(std::size_t{width} * height * sizeof(std::uint32_t), "edge pixels")) {
}

void EdgeSamples::find(FrameContext& frame) {
    // The third buffer of the geometry is that of instances.
    Buffer* const instances = frame.scene_buffers.geometry.at(2).get();
    frame.run(KernelId::edge_masks, Stage::edge_detection, "", false,
              with_gbuffer(frame.buffers, {instances, masks_.get()}), grid_.tiles());
    const auto words =
        read_buffer<std::uint32_t>(frame.executor, *masks_, std::size_t{2} * grid_.tiles());
    std::vector<TileMask> masks;
    masks.reserve(grid_.tiles());
    for (std::size_t i = 0; i < words.size(); i += 2)
        masks.push_back(TileMask{words[i + 1]} << 32 | words[i]);
    const std::vector<std::uint32_t> pixels = pixels_of(grid_, masks);
    pixels_ = static_cast<std::uint32_t>(pixels.size());
    write_buffer<std::uint32_t>(frame.executor, *list_, pixels);
}

void EdgeSamples::sample(FrameContext& frame) {
    const FrameBuffers& buffers = frame.buffers;
    // Rays that share a pixel share what a texture lookup covers.
    const float share = std::sqrt(static_cast<float>(frame.params.edge_samples) + 1.0F);
    const float whole_pixel =
        std::exchange(frame.params.texture_angle, frame.params.texture_angle / share);
    frame.params.list_length = pixels_;
    const std::uint32_t pixels_per_item =
        shared::edge_pixels_of_item(frame.executor.lanes(), frame.params.edge_samples);
    frame.run(
        KernelId::edge_samples, Stage::edge_samples, "", true,
        with_geometry(
            frame.scene_buffers,
            with_gbuffer(buffers,
                         with_irradiance(
                             buffers, {list_.get(), buffers.film_high.get(), buffers.film_low.get(),
                                       buffers.nonfinite.get(), buffers.counters.get()}))),
        (pixels_ + pixels_per_item - 1) / pixels_per_item);
    frame.params.texture_angle = whole_pixel;
}

}  // namespace weft
