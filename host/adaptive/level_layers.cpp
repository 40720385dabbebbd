// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_layers.h"

#include <cmath>
#include <limits>
#include <utility>

namespace weft {

namespace {

/// Errors by tile as a layer; those that are not finite become the largest float.
Layer error_layer(const std::string& name, std::span<const float> errors, const TileGrid& grid) {
    Layer layer{name, "Y", std::vector<float>(std::size_t{grid.width} * grid.height)};
    constexpr float largest = std::numeric_limits<float>::max();
    for (std::uint32_t y = 0; y < grid.height; ++y)
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const float error = errors[std::size_t{y / TILE_EDGE} * grid.columns() + x / TILE_EDGE];
            layer.values[std::size_t{y} * grid.width + x] = std::isfinite(error) ? error : largest;
        }
    return layer;
}

}  // namespace

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
    image.layers.push_back(
        error_layer(component + ".error", scheduler.errors(Level::coarse), grid));
    image.layers.push_back(
        error_layer(component + ".error_middle", scheduler.errors(Level::middle), grid));
}

}  // namespace weft
