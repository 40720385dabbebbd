// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/majorant_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/testing/density_grid_reference.h"

namespace weft::majorant_grid_test {
namespace {

const std::array<GridSize, 9> sizes = {{{1, 1, 1},
                                        {2, 2, 2},
                                        {4, 4, 4},
                                        {5, 3, 9},
                                        {16, 16, 16},
                                        {17, 1, 33},
                                        {1, 64, 2},
                                        {300, 5, 7},
                                        {3, 2, 1025}}};

TEST(MajorantGrid, HasNoMoreBlocksThanNeedBe) {
    EXPECT_EQ(majorant_block({1, 1, 1}), 4U);
    EXPECT_EQ(majorant_block({256, 256, 256}), 4U);
    EXPECT_EQ(majorant_block({257, 1, 1}), 8U);
    EXPECT_EQ(majorant_block({1, 1, 2048}), 32U);
    EXPECT_EQ(majorant_block({1, 1U << 28, 1}), 1U << 22);
    for (const GridSize& size : sizes) {
        const MajorantGrid majorants = make_majorant_grid(make_random_grid(size, 3));
        EXPECT_EQ(majorants.bounds.size(),
                  std::size_t{majorants.size[0]} * majorants.size[1] * majorants.size[2]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_LE(majorants.size[axis], 64U);
            EXPECT_GE(majorants.size[axis] * majorants.block, size[axis]);
            EXPECT_LT((majorants.size[axis] - 1) * majorants.block, size[axis]);
        }
    }
}

TEST(MajorantGrid, IsEmptyForAnEmptyGrid) {
    const MajorantGrid majorants = make_majorant_grid({});
    EXPECT_EQ(majorants.size, (GridSize{0, 0, 0}));
    EXPECT_TRUE(majorants.bounds.empty());
}

/// The bound of the block of a point of the unit cube.
float bound_at(const DensityGrid& grid, const MajorantGrid& majorants, const glm::dvec3& p) {
    std::size_t index = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
        const double voxel = p[static_cast<int>(axis)] * grid.size[axis];
        const auto block = static_cast<std::size_t>(std::max(voxel, 0.0) / majorants.block);
        index =
            index * majorants.size[axis] + std::min<std::size_t>(block, majorants.size[axis] - 1);
    }
    return majorants.bounds[index];
}

// Points are random, and on the faces and corners of voxels and of blocks and beside them, where
// interpolation reaches into the next block.
TEST(MajorantGrid, IsNowhereBelowTheDensity) {
    std::mt19937 random(7);
    for (const GridSize& size : sizes) {
        const DensityGrid grid = make_random_grid(size, 11);
        const MajorantGrid majorants = make_majorant_grid(grid);
        for (int n = 0; n < 100'000; ++n) {
            glm::dvec3 p;
            for (int axis = 0; axis < 3; ++axis) {
                const std::uint32_t edge = size[static_cast<std::size_t>(axis)];
                double x = static_cast<double>(random()) / 4294967295.0 * edge;
                if (random() % 2 == 0) x = std::round(2.0 * x) / 2.0;
                const double beside[] = {0.0, 0.49, -0.49, 1e-7, -1e-7};
                x += beside[random() % 5];
                p[axis] = std::clamp(x / edge, 0.0, 1.0);
            }
            // What rounding gives is not above the eight voxels by more than itself.
            ASSERT_LE(density_by_definition(grid, p), bound_at(grid, majorants, p) * (1 + 1e-15));
        }
    }
}

// Rounding may take a position into the block next to its own.
TEST(MajorantGrid, HoldsHalfAVoxelBeyondABlock) {
    std::mt19937 random(8);
    for (const GridSize& size : sizes) {
        const DensityGrid grid = make_random_grid(size, 12);
        const MajorantGrid majorants = make_majorant_grid(grid);
        for (int n = 0; n < 100'000; ++n) {
            glm::dvec3 p;
            glm::dvec3 q;
            for (int axis = 0; axis < 3; ++axis) {
                const std::uint32_t edge = size[static_cast<std::size_t>(axis)];
                p[axis] = static_cast<double>(random()) / 4294967296.0;
                const double moved = static_cast<double>(random() % 1999) / 2000.0 - 0.4995;
                q[axis] = std::clamp(p[axis] + moved / edge, 0.0, 1.0);
            }
            ASSERT_LE(density_by_definition(grid, q), bound_at(grid, majorants, p) * (1 + 1e-15));
        }
    }
}

// A bound that is no voxel's, or that of a voxel far away, would hold too, but cost time.
TEST(MajorantGrid, IsTheGreatestOfTheVoxelsAbout) {
    for (const GridSize& size : sizes) {
        const DensityGrid grid = make_random_grid(size, 13);
        const MajorantGrid majorants = make_majorant_grid(grid);
        std::vector<float> expected(majorants.bounds.size(), 0.0F);
        std::size_t voxel = 0;
        const auto touches = [&](std::uint32_t block, std::uint32_t i) {
            const std::int64_t first = std::int64_t{block} * majorants.block;
            return i >= first - 1 && i <= first + majorants.block;
        };
        for (std::uint32_t k = 0; k < size[2]; ++k)
            for (std::uint32_t j = 0; j < size[1]; ++j)
                for (std::uint32_t i = 0; i < size[0]; ++i, ++voxel)
                    for (std::size_t b = 0; b < expected.size(); ++b) {
                        const auto x = static_cast<std::uint32_t>(b % majorants.size[0]);
                        const auto yz = static_cast<std::uint32_t>(b / majorants.size[0]);
                        if (touches(x, i) && touches(yz % majorants.size[1], j) &&
                            touches(yz / majorants.size[1], k))
                            expected[b] = std::max(expected[b], grid.densities[voxel]);
                    }
        EXPECT_EQ(majorants.bounds, expected) << size[0] << ' ' << size[1] << ' ' << size[2];
    }
}

}  // namespace
}  // namespace weft::majorant_grid_test
