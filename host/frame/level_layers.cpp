// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/level_layers.h"

#include <utility>

namespace weft {

void add_level_layers(const std::string& component, const LevelScheduler& scheduler, Image& image) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    Layer level{component + ".level", "Y", std::vector<float>(pixels)};
    Layer samples{component + ".samples", "Y", std::vector<float>(pixels)};
    const TileGrid grid{image.width, image.height};
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const std::size_t tile = std::size_t{y / TILE_EDGE} * grid.columns() + x / TILE_EDGE;
            const std::uint32_t bit = TILE_EDGE * (y % TILE_EDGE) + x % TILE_EDGE;
            const std::size_t pixel = std::size_t{y} * image.width + x;
            level.values[pixel] = static_cast<float>(scheduler.levels()[tile]);
            samples.values[pixel] = static_cast<float>(scheduler.sampled()[tile] >> bit & 1U);
        }
    image.layers.push_back(std::move(level));
    image.layers.push_back(std::move(samples));
}

}  // namespace weft
