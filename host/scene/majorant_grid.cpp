// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/majorant_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace weft {
namespace {

constexpr std::uint32_t smallest_block = 4;
constexpr std::uint32_t most_blocks = 64;  // along an axis

/// Voxels [first, last) along an axis.
struct Range {
    std::uint32_t first, last;
};

/// The voxels of a block and the next ones on both sides.
Range voxels_about(std::uint32_t block_index, std::uint32_t block, std::uint32_t size) {
    const std::uint64_t first = std::uint64_t{block_index} * block;
    const std::uint64_t last = std::min<std::uint64_t>(first + block + 1, size);
    return {static_cast<std::uint32_t>(first > 0 ? first - 1 : 0),
            static_cast<std::uint32_t>(last)};
}

float greatest_of(const DensityGrid& grid, const Range& x, const Range& y, const Range& z) {
    float greatest = 0.0F;
    for (std::size_t k = z.first; k < z.last; ++k) {
        for (std::size_t j = y.first; j < y.last; ++j) {
            const float* const row = grid.densities.data() + (k * grid.size[1] + j) * grid.size[0];
            greatest = std::max(greatest, *std::max_element(row + x.first, row + x.last));
        }
    }
    return greatest;
}

}  // namespace

std::uint32_t majorant_block(const GridSize& size) {
    const std::uint64_t longest = *std::max_element(size.begin(), size.end());
    std::uint64_t block = smallest_block;
    while (block * most_blocks < longest) block *= 2;
    return static_cast<std::uint32_t>(block);
}

MajorantGrid make_majorant_grid(const DensityGrid& grid) {
    MajorantGrid majorants;
    if (grid.densities.empty()) return majorants;
    const std::uint32_t block = majorant_block(grid.size);
    majorants.block = block;
    for (std::size_t axis = 0; axis < 3; ++axis)
        majorants.size[axis] = (grid.size[axis] - 1) / block + 1;
    const GridSize& size = majorants.size;
    majorants.bounds.resize(std::size_t{size[0]} * size[1] * size[2]);
    tbb::parallel_for(std::uint32_t{0}, size[2], [&](std::uint32_t k) {
        const Range z = voxels_about(k, block, grid.size[2]);
        float* bound = majorants.bounds.data() + std::size_t{k} * size[1] * size[0];
        for (std::uint32_t j = 0; j < size[1]; ++j) {
            const Range y = voxels_about(j, block, grid.size[1]);
            for (std::uint32_t i = 0; i < size[0]; ++i)
                *bound++ = greatest_of(grid, voxels_about(i, block, grid.size[0]), y, z);
        }
    });
    return majorants;
}

}  // namespace weft
