// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/density_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/limits.h"
#include "tests/testing/density_grid_reference.h"

namespace weft::density_grid_test {
namespace {

std::string error_of(const DensityGrid& grid) {
    try {
        validate_density_grid(grid, "smoke.vol");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(DensityGrid, CountsVoxels) {
    EXPECT_EQ(checked_voxel_count({2, 3, 5}, "g"), 30U);
    EXPECT_EQ(checked_voxel_count({1, 1, 1}, "g"), 1U);
    EXPECT_EQ(checked_voxel_count({1U << 28, 1, 1}, "g"), limits::max_grid_voxels);
}

// Without voxels there is nothing that could be too many, whatever the other edges say.
TEST(DensityGrid, MayBeEmpty) {
    EXPECT_EQ(checked_voxel_count({0, 0, 0}, "g"), 0U);
    EXPECT_EQ(checked_voxel_count({0, 7, 7}, "g"), 0U);
    EXPECT_EQ(checked_voxel_count({1U << 31, 1U << 31, 0}, "g"), 0U);
    EXPECT_NO_THROW(validate_density_grid({}, "g"));
    EXPECT_EQ(greatest_density({}), 0.0F);
}

TEST(DensityGrid, RefusesTooManyVoxelsWithoutOverflow) {
    const std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
    for (const GridSize& size : {GridSize{most, most, most}, GridSize{1U << 28, 2, 1},
                                 GridSize{1, 1, most}, GridSize{1U << 22, 1U << 21, 1U << 21},
                                 GridSize{65536, 65536, 1}, GridSize{2097152, 2097152, 4194304}})
        EXPECT_THROW((void)checked_voxel_count(size, "g"), Error) << size[0];
}

TEST(DensityGrid, RefusesAnotherNumberOfDensities) {
    DensityGrid grid = make_random_grid({2, 3, 4}, 1);
    grid.densities.pop_back();
    EXPECT_EQ(error_of(grid), "smoke.vol: 23 densities for a grid of 2 x 3 x 4 voxels");
    grid.densities.clear();
    EXPECT_EQ(error_of(grid), "smoke.vol: 0 densities for a grid of 2 x 3 x 4 voxels");
}

TEST(DensityGrid, NamesTheFirstVoxelThatIsNoDensity) {
    const float infinity = std::numeric_limits<float>::infinity();
    DensityGrid grid = make_random_grid({3, 4, 5}, 1);
    EXPECT_EQ(error_of(grid), "no error");
    const std::string expected = ", expected a finite density of at least 0";
    grid.densities[(4 * 4 + 3) * 3 + 2] = -0.5F;
    EXPECT_EQ(error_of(grid), "smoke.vol: voxel (2, 3, 4) is -0.5" + expected);
    grid.densities[(1 * 4 + 0) * 3 + 2] = -infinity;
    EXPECT_EQ(error_of(grid), "smoke.vol: voxel (2, 0, 1) is -inf" + expected);
    grid.densities[1] = infinity;
    EXPECT_EQ(error_of(grid), "smoke.vol: voxel (1, 0, 0) is inf" + expected);
    grid.densities[0] = std::nanf("");
    EXPECT_EQ(error_of(grid), "smoke.vol: voxel (0, 0, 0) is nan" + expected);
}

TEST(DensityGrid, TakesEveryFiniteDensity) {
    const float denormal = std::numeric_limits<float>::denorm_min();
    const float greatest = std::numeric_limits<float>::max();
    DensityGrid grid;
    grid.size = {4, 1, 1};
    grid.densities = {0.0F, -0.0F, denormal, greatest};
    EXPECT_EQ(error_of(grid), "no error");
    EXPECT_EQ(greatest_density(grid), greatest);
}

}  // namespace
}  // namespace weft::density_grid_test
