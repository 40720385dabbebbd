// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/testing/density_grid_reference.h"

#define NATIVE_KERNELS "kernels/media/grid_walk.h"
#include "tests/testing/native_kernels.h"

#include "tests/testing/grid_rays.h"
#include "tests/testing/native_density_grid.h"

// Look-ups and walks of kernels/media/density_grid.h and grid_walk.h against their definitions in
// double precision.
namespace weft::grid_walk_test {
namespace {

const std::array<GridSize, 6> sizes = {
    {{1, 1, 1}, {2, 2, 2}, {5, 3, 9}, {16, 16, 16}, {17, 1, 33}, {3, 2, 300}}};

TEST(GridWalkLookUp, IsTrilinear) {
    std::mt19937 random(1);
    for (const GridSize& size : sizes) {
        const DensityGrid grid = make_random_grid(size, 2);
        const NativeGrid held(grid);
        const native::DensityGrid view = held.view();
        for (int n = 0; n < 20'000; ++n) {
            const native::float3 p = uniform3(random, 0.0F, 1.0F);
            // Voxels are up to 1 apart in density; a position is known to an ulp of its place.
            const double expected = density_by_definition(grid, to_double(p));
            ASSERT_NEAR(native::density_at(&view, p), expected, 1e-4);
        }
    }
}

// At the centres interpolation has no rounding to hide behind.
TEST(GridWalkLookUp, IsTheVoxelAtItsCentre) {
    const DensityGrid grid = make_random_grid({4, 8, 2}, 3);
    const NativeGrid held(grid);
    const native::DensityGrid view = held.view();
    std::size_t index = 0;
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 4; ++i)
                EXPECT_EQ(
                    native::density_at(&view, native::f3((static_cast<float>(i) + 0.5F) / 4.0F,
                                                         (static_cast<float>(j) + 0.5F) / 8.0F,
                                                         (static_cast<float>(k) + 0.5F) / 2.0F)),
                    grid.densities[index++]);
}

TEST(GridWalkLookUp, IsZeroOutsideAndDefinedEverywhere) {
    const NativeGrid held(make_grid({3, 3, 3}, [](auto, auto, auto) { return 0.7; }));
    const native::DensityGrid view = held.view();
    const float above = std::nextafter(1.0F, 2.0F);
    for (const float x : {0.0F, 1.0F, 0.5F, -0.0F, 1e-40F})
        EXPECT_EQ(native::density_at(&view, native::f3(0.5F, x, 0.25F)), 0.7F) << x;
    for (const float x : {above, -1e-40F, 2.0F, -3.0F, 1e30F, infinity, -infinity, std::nanf("")}) {
        EXPECT_EQ(native::density_at(&view, native::f3(x, 0.5F, 0.5F)), 0.0F) << x;
        EXPECT_EQ(native::density_at(&view, native::f3(0.5F, x, 0.5F)), 0.0F) << x;
        EXPECT_EQ(native::density_at(&view, native::f3(0.5F, 0.5F, x)), 0.0F) << x;
    }
}

// Every step is to a neighbour, none goes back, and all of them together are the part inside.
TEST(GridWalk, CoversThePartOfARayThatIsInside) {
    for (const GridSize& size : sizes) {
        const NativeGrid held(make_random_grid(size, 4));
        const native::DensityGrid view = held.view();
        for (const TestRay& ray : test_rays()) {
            native::GridRay inside{};
            const auto [first, last] =
                clip(to_double(ray.origin), to_double(ray.direction), ray.first, ray.last);
            if (native::enter_grid(&view, ray.origin, ray.direction, ray.first, ray.last,
                                   &inside) == 0) {
                // Too short for floats, or without an end.
                EXPECT_TRUE(last - first <= 1e-5 * (1.0 + std::abs(last)) ||
                            last > std::numeric_limits<float>::max());
                continue;
            }
            ASSERT_NEAR(inside.length, last - first, 1e-5 * (1.0 + std::abs(last)));
            native::CellWalk walk = native::start_blocks(&view, &inside);
            EXPECT_EQ(walk.start, 0.0F);
            float end = walk.end;
            std::uint32_t steps = 0;
            while (native::next_cell(&walk) != 0) {
                ASSERT_EQ(walk.start, end);
                ASSERT_GE(walk.end, walk.start);
                end = walk.end;
                ASSERT_LE(++steps, view.record.bx + view.record.by + view.record.bz + 3);
            }
            ASSERT_EQ(end, inside.length);
        }
    }
}

// Positions may be rounded out of their block, but never so far that its bound does not hold.
TEST(GridWalk, BoundsHoldAlongRays) {
    std::mt19937 random(6);
    for (const GridSize& size : sizes) {
        const NativeGrid held(make_random_grid(size, 5));
        const native::DensityGrid view = held.view();
        for (const TestRay& ray : test_rays()) {
            native::GridRay inside{};
            if (native::enter_grid(&view, ray.origin, ray.direction, ray.first, ray.last,
                                   &inside) == 0)
                continue;
            native::CellWalk walk = native::start_blocks(&view, &inside);
            do {
                const float bound = native::walk_bound(&view, &walk);
                for (const float s : {walk.start, walk.end, uniform(random, walk.start, walk.end)})
                    ASSERT_LE(native::density_inside(&view, native::grid_ray_at(&inside, s)),
                              bound * 1.0000005F);
            } while (native::next_cell(&walk) != 0);
        }
    }
}

TEST(GridWalk, RefusesNumbersThatAreNone) {
    const NativeGrid held(make_random_grid({2, 2, 2}, 5));
    const native::DensityGrid view = held.view();
    native::GridRay inside{};
    const native::float3 middle = native::f3(0.5F, 0.5F, 0.5F);
    const native::float3 forward = native::f3(0.0F, 0.0F, 1.0F);
    for (const float bad : {std::nanf(""), infinity, -infinity}) {
        const native::float3 broken = native::f3(0.5F, bad, 0.5F);
        EXPECT_EQ(native::enter_grid(&view, broken, forward, 0.0F, 1.0F, &inside), 0);
        EXPECT_EQ(native::enter_grid(&view, middle, broken, 0.0F, 1.0F, &inside), 0);
    }
    // Never out again: there is no length to speak of.
    const native::float3 still = native::f3(0.0F, 0.0F, 0.0F);
    EXPECT_EQ(native::enter_grid(&view, middle, still, 0.0F, infinity, &inside), 0);
    EXPECT_EQ(native::enter_grid(&view, middle, still, 0.0F, 1.0F, &inside), 1);
    EXPECT_EQ(native::enter_grid(&view, middle, forward, 0.0F, infinity, &inside), 1);
    EXPECT_EQ(native::enter_grid(&view, middle, forward, 1.0F, 0.5F, &inside), 0);
}

}  // namespace
}  // namespace weft::grid_walk_test
