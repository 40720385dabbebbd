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

#define NATIVE_KERNELS "kernels/media/grid_depth.h"
#include "tests/testing/native_kernels.h"

#include "tests/testing/grid_rays.h"
#include "tests/testing/native_density_grid.h"

// Exact integrals of kernels/media/grid_depth.h against closed forms and sums in double precision.
namespace weft::grid_depth_test {
namespace {

const std::array<GridSize, 6> sizes = {
    {{1, 1, 1}, {2, 2, 2}, {5, 3, 9}, {16, 16, 16}, {17, 1, 33}, {3, 2, 300}}};

TEST(GridDepth, IsTheIntegralAlongRays) {
    for (const GridSize& size : sizes) {
        const DensityGrid grid = make_random_grid(size, 6);
        const NativeGrid held(grid);
        const native::DensityGrid view = held.view();
        const std::vector<TestRay> rays = test_rays();
        for (std::size_t n = 0; n < rays.size(); n += 29) {
            const glm::dvec3 o = to_double(rays[n].origin);
            const glm::dvec3 d = to_double(rays[n].direction);
            const auto [first, last] = clip(o, d, rays[n].first, rays[n].last);
            if (!(last - first < 1e10)) continue;
            constexpr int steps = 4000;
            double sum = 0.0;
            for (int i = 0; i < steps; ++i) {
                const double t = first + (i + 0.5) / steps * (last - first);
                sum += density_by_definition(grid, glm::clamp(o + t * d, 0.0, 1.0));
            }
            const double expected = sum * (last - first) / steps;
            const float depth = native::grid_depth(&view, rays[n].origin, rays[n].direction,
                                                   rays[n].first, rays[n].last);
            // The midpoint rule errs by about (ray / steps)^2 at each of the voxels it passes.
            EXPECT_NEAR(depth, expected, 1e-4 * (last - first) + 1e-6 * std::abs(last)) << n;
        }
    }
}

// A density that is linear along x, of depth a + b x integrated.
TEST(GridDepth, OfALinearSlabIsItsClosedForm) {
    constexpr std::uint32_t voxels = 64;
    const DensityGrid grid = make_grid({voxels, 2, 3}, [](std::uint32_t i, auto, auto) {
        return 0.25 + 2.0 * (i + 0.5) / voxels;
    });
    const NativeGrid held(grid);
    const native::DensityGrid view = held.view();
    // Within half a voxel of the faces the grid is constant by definition.
    const double a = 0.5 / voxels;
    const auto depth_to = [&](double x) {
        const double inner = std::clamp(x, a, 1.0 - a);
        return 0.25 * x + 2.0 * a * std::min(x, a) + inner * inner - a * a +
               2.0 * (1.0 - a) * std::max(0.0, x - (1.0 - a));
    };
    for (const float x : {0.001F, 0.01F, 0.3F, 0.5F, 0.77F, 0.999F, 1.0F}) {
        const float along = native::grid_depth(&view, native::f3(0.0F, 0.4F, 0.6F),
                                               native::f3(1.0F, 0.0F, 0.0F), 0.0F, x);
        EXPECT_NEAR(along, depth_to(x), 1e-6 * depth_to(x)) << x;
        const float back = native::grid_depth(&view, native::f3(x, 1.0F, 0.0F),
                                              native::f3(-0.5F, 0.0F, 0.0F), 0.0F, infinity);
        EXPECT_NEAR(back, 2.0 * depth_to(x), 2e-6 * depth_to(x)) << x;
    }
}

TEST(GridDepth, StopsWhereItsTargetIsReached) {
    std::mt19937 random(8);
    const NativeGrid held(make_random_grid({16, 9, 12}, 9));
    const native::DensityGrid view = held.view();
    for (int n = 0; n < 500; ++n) {
        const native::float3 origin = uniform3(random, -1.0F, 2.0F);
        const native::float3 direction = uniform3(random, 0.0F, 1.0F) - origin;
        native::GridRay ray{};
        if (native::enter_grid(&view, origin, direction, 0.0F, 2.0F, &ray) == 0) continue;
        float stop = -1.0F;
        const float whole = native::density_integral(&view, &ray, 0.0F, infinity, &stop);
        EXPECT_EQ(stop, ray.length);
        const float target = whole * uniform(random, 0.001F, 0.999F);
        ASSERT_EQ(native::density_integral(&view, &ray, 0.0F, target, &stop), target);
        native::GridRay part = ray;
        part.length = stop;
        float end = 0.0F;
        const float reached = native::density_integral(&view, &part, 0.0F, infinity, &end);
        EXPECT_NEAR(reached, target, 3e-6 * whole);
        const float rest = native::density_integral(&view, &ray, stop, infinity, &end);
        EXPECT_NEAR(reached + rest, whole, 3e-6 * whole);
    }
}

TEST(GridDepth, IsNeverNaN) {
    const float most = std::numeric_limits<float>::max();
    const std::array<float, 5> values = {0.0F, most, 1e-45F, 1.0F, 1e30F};
    const NativeGrid held(make_grid({9, 5, 5}, [&](std::uint32_t i, std::uint32_t j, auto k) {
        return values[(i + j + k) % values.size()];
    }));
    const native::DensityGrid view = held.view();
    for (const TestRay& ray : test_rays()) {
        const float depth =
            native::grid_depth(&view, ray.origin, ray.direction, ray.first, ray.last);
        ASSERT_GE(depth, 0.0F);
    }
}

}  // namespace
}  // namespace weft::grid_depth_test
