// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "tests/testing/density_grid_reference.h"

#define NATIVE_KERNELS "kernels/media/grid_tracking.h"
#include "tests/testing/native_kernels.h"

#include "tests/testing/grid_rays.h"
#include "tests/testing/native_density_grid.h"

// Delta and ratio tracking against closed forms and exact integrals. Means are compared by their
// z-value and distributions of collisions by that of Kolmogorov and Smirnov; the probability of a
// value as large as the one found must be above 1e-4 over all of this file's comparisons together
// (Sidak 1967, for 100 of them, more than there are: 1e-6 each, two-sided). Seeds are fixed.
namespace weft::grid_tracking_test {
namespace {

constexpr double z_limit = 4.9;
constexpr double ks_limit = 2.7;  // 2 exp(-2 x^2) = 1e-6
constexpr std::uint32_t many = 200'000;
// A transmittance is a product of up to GRID_TENTATIVE factors, each rounded to 2^-24.
constexpr double rounding = GRID_TENTATIVE * 0x1p-24;

struct Line {
    native::float3 origin, direction;
    float last = infinity;
};

/// A mean and its standard deviation.
struct Estimate {
    double mean = 0.0, deviation = 0.0;
    bool sound = true;  ///< every sample was in [0, 1]
};

Estimate estimate(std::uint32_t samples, const std::function<double(native::Random&)>& sample) {
    double sum = 0.0;
    double squares = 0.0;
    Estimate result;
    for (std::uint32_t n = 0; n < samples; ++n) {
        native::Random random = native::make_random(17, 4, n);
        const double value = sample(random);
        result.sound = result.sound && value >= 0.0 && value <= 1.0;
        sum += value;
        squares += value * value;
    }
    result.mean = sum / samples;
    result.deviation =
        std::sqrt(std::max(squares / samples - result.mean * result.mean, 0.0) / samples);
    return result;
}

void expect_mean(const Estimate& estimate, double expected) {
    EXPECT_TRUE(estimate.sound);
    EXPECT_GT(estimate.deviation, 0.0);
    EXPECT_LT(std::abs(estimate.mean - expected),
              z_limit * estimate.deviation + rounding * expected)
        << estimate.mean << ", expected " << expected;
}

/// Ratio tracking's transmittance of each channel is exp(-sigma depth).
void expect_ratio_tracking(const native::DensityGrid& grid, const Line& line, native::float3 sigma,
                           double depth, std::uint32_t samples = many) {
    for (int channel = 0; channel < 3; ++channel) {
        const auto part = [&](native::float3 v) {
            return channel == 0 ? v.x : (channel == 1 ? v.y : v.z);
        };
        expect_mean(
            estimate(samples,
                     [&](native::Random& random) -> double {
                         return part(native::grid_transmittance(&grid, line.origin, line.direction,
                                                                0.0F, line.last, sigma, &random));
                     }),
            std::exp(-static_cast<double>(part(sigma)) * depth));
    }
}

/// Delta tracking of a medium of one extinction for all channels, whose ratio stays 1 to the bit.
int grey_collision(const native::DensityGrid* grid, native::float3 origin, native::float3 direction,
                   float first, float last, float sigma, native::Random* random, float* t,
                   float* density) {
    native::float3 ratio = native::f3(1.0F, 1.0F, 1.0F);
    const int collided =
        native::grid_collision(grid, origin, direction, first, last,
                               native::f3(sigma, sigma, sigma), &ratio, random, t, density);
    EXPECT_TRUE(ratio.x == 1.0F && ratio.y == 1.0F && ratio.z == 1.0F);
    return collided;
}

/// Delta tracking collides with probability 1 - T(last), at t of the distribution 1 - T(t), where
/// T(t) is exp(-sigma depth(t)).
void expect_delta_tracking(const native::DensityGrid& grid, const Line& line, float sigma,
                           const std::function<double(double)>& depth,
                           std::uint32_t samples = many) {
    std::vector<double> collided;  // 1 - T(t) of each
    const double all = -std::expm1(-sigma * depth(line.last));
    expect_mean(estimate(samples,
                         [&](native::Random& random) {
                             float t = -1.0F;
                             float density = -1.0F;
                             if (grey_collision(&grid, line.origin, line.direction, 0.0F, line.last,
                                                sigma, &random, &t, &density) == 0) {
                                 EXPECT_EQ(t, line.last);
                                 return 0.0;
                             }
                             EXPECT_TRUE(density > 0.0F && t >= 0.0F && t <= line.last);
                             collided.push_back(-std::expm1(-sigma * depth(t)) / all);
                             return 1.0;
                         }),
                all);
    std::sort(collided.begin(), collided.end());
    double distance = 0.0;
    const auto count = static_cast<double>(collided.size());
    for (std::size_t i = 0; i < collided.size(); ++i) {
        const auto rank = static_cast<double>(i);
        distance = std::max({distance, std::abs(collided[i] - rank / count),
                             std::abs(collided[i] - (rank + 1.0) / count)});
    }
    EXPECT_LT(distance * std::sqrt(count), ks_limit);
}

constexpr std::uint32_t slab_voxels = 64;

/// Density 2 x along x, but constant within half a voxel of the faces.
DensityGrid linear_slab() {
    return make_grid({slab_voxels, 3, 2},
                     [](std::uint32_t i, auto, auto) { return 2.0 * (i + 0.5) / slab_voxels; });
}

/// The integral of the slab's density from 0 to x.
double slab_depth(double x) {
    const double a = 0.5 / slab_voxels;
    const double inner = std::clamp(x, a, 1.0 - a);
    return 2.0 * a * std::min(x, a) + inner * inner - a * a +
           2.0 * (1.0 - a) * std::max(0.0, x - (1.0 - a));
}

TEST(GridTracking, LinearSlabIsItsClosedForm) {
    const NativeGrid held(linear_slab());
    const native::DensityGrid view = held.view();
    for (const float sigma : {0.1F, 5.0F}) {
        const Line across{native::f3(0.0F, 0.3F, 0.6F), native::f3(1.0F, 0.0F, 0.0F), 1.0F};
        expect_ratio_tracking(view, across, native::f3(sigma, 0.5F * sigma, 0.01F * sigma),
                              slab_depth(1.0));
        expect_delta_tracking(view, across, sigma, slab_depth);
        // Against the axis from the middle, at half the speed, along an edge of the cube.
        const Line back{native::f3(0.5F, 1.0F, 0.0F), native::f3(-0.5F, 0.0F, 0.0F), 1.0F};
        expect_delta_tracking(view, back, sigma, [](double t) {
            return 2.0 * (slab_depth(0.5) - slab_depth(0.5 - 0.5 * t));
        });
    }
}

TEST(GridTracking, ConstantGridIsTheHomogeneousMedium) {
    const NativeGrid held(make_grid({9, 9, 9}, [](auto, auto, auto) { return 0.5; }));
    const native::DensityGrid view = held.view();
    const Line diagonal{native::f3(-1.0F, -1.0F, -1.0F), native::f3(1.0F, 1.0F, 1.0F), 4.0F};
    expect_ratio_tracking(view, diagonal, native::f3(2.0F, 0.2F, 4.0F), 0.5);
    expect_delta_tracking(view, diagonal, 3.0F,
                          [](double t) { return 0.5 * std::clamp(t - 1.0, 0.0, 1.0); });
    // From the same random number even the same collision, since each tentative one is real.
    for (std::uint32_t n = 0; n < 1000; ++n) {
        native::Random random = native::make_random(1, 2, n);
        native::Random same = random;
        float t = 0.0F;
        float density = 0.0F;
        const double flight = native::random_depth(&same) / (0.5 * 3.0);
        if (grey_collision(&view, diagonal.origin, diagonal.direction, 0.0F, 4.0F, 3.0F, &random,
                           &t, &density) != 0) {
            EXPECT_NEAR(t, 1.0 + flight, 1e-6);
            EXPECT_EQ(density, 0.5F);
        } else {
            EXPECT_GE(flight, 1.0 - 1e-6);
        }
    }
}

TEST(GridTracking, RandomGridsAgreeWithTheirIntegrals) {
    for (const GridSize& size : {GridSize{1, 1, 1}, {2, 5, 3}, {33, 17, 20}}) {
        const NativeGrid held(make_random_grid(size, 3));
        const native::DensityGrid view = held.view();
        const native::float3 origin = native::f3(0.1F, -0.2F, 1.3F);
        const Line line{origin, native::f3(0.8F, 0.9F, 0.4F) - origin, 2.0F};
        const auto depth = [&](double t) -> double {
            return native::grid_depth(&view, line.origin, line.direction, 0.0F,
                                      static_cast<float>(t));
        };
        expect_ratio_tracking(view, line, native::f3(4.0F, 8.0F, 1.0F), depth(2.0));
        expect_delta_tracking(view, line, 8.0F, depth);
    }
}

// Bounds that are a million or a thousand times what is there: after GRID_TENTATIVE tentative
// collisions, near the start of the ray or in its middle, what happens behind must be just as
// right.
TEST(GridTracking, EnormousBoundsNeitherBiasNorHang) {
    for (const float contrast : {1e6F, 1e3F}) {
        const auto density = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            return j == 0 && k == 0 ? 1.0 : (1.0 + 0.1 * (i % 7)) / contrast;
        };
        const NativeGrid held(make_grid({32, 8, 8}, density));
        const native::DensityGrid view = held.view();
        // In blocks of the dense voxels at first, then in clear ones.
        const Line line{native::f3(0.0F, 0.3F, 0.3F), native::f3(1.0F, 0.3F, 0.3F), 1.0F};
        const auto depth = [&](double t) -> double {
            return native::grid_depth(&view, line.origin, line.direction, 0.0F,
                                      static_cast<float>(t));
        };
        constexpr std::uint32_t few = 5000;
        const native::float3 sigma = native::f3(contrast, 0.3F * contrast, 0.1F * contrast);
        expect_ratio_tracking(view, line, sigma, depth(1.0), few);
        expect_delta_tracking(view, line, contrast, depth, few);
    }
}

TEST(GridTracking, NothingCollidesWithNothing) {
    const NativeGrid empty(make_grid({5, 5, 5}, [](auto, auto, auto) { return 0.0; }));
    const NativeGrid dense(make_grid({5, 5, 5}, [](auto, auto, auto) { return 1.0; }));
    const native::DensityGrid nothing = empty.view();
    const native::DensityGrid something = dense.view();
    native::Random random = native::make_random(1, 1, 1);
    for (const TestRay& ray : test_rays()) {
        float t = 0.0F;
        float density = 1.0F;
        EXPECT_EQ(grey_collision(&nothing, ray.origin, ray.direction, ray.first, ray.last, 1e30F,
                                 &random, &t, &density),
                  0);
        EXPECT_EQ(t, ray.last);
        EXPECT_EQ(density, 0.0F);
        EXPECT_EQ(grey_collision(&something, ray.origin, ray.direction, ray.first, ray.last, 0.0F,
                                 &random, &t, &density),
                  0);
        for (const auto& [grid, sigma] : {std::pair{nothing, 1e30F}, {something, 0.0F}}) {
            const native::float3 passed =
                native::grid_transmittance(&grid, ray.origin, ray.direction, ray.first, ray.last,
                                           native::f3(sigma, sigma, sigma), &random);
            EXPECT_TRUE(passed.x == 1.0F && passed.y == 1.0F && passed.z == 1.0F);
        }
    }
}

TEST(GridTracking, NothingPassesADenseGrid) {
    const float most = std::numeric_limits<float>::max();
    const NativeGrid held(make_random_grid({8, 8, 8}, 5));
    const native::DensityGrid view = held.view();
    for (const float sigma : {1e9F, 1e20F, most}) {
        for (std::uint32_t n = 0; n < 100; ++n) {
            native::Random random = native::make_random(1, n, 1);
            const native::float3 origin = native::f3(-0.3F, 0.4F, 0.2F);
            const native::float3 direction = native::f3(1.0F, 0.1F, 0.2F);
            float t = 0.0F;
            float density = 0.0F;
            ASSERT_EQ(grey_collision(&view, origin, direction, 0.0F, infinity, sigma, &random, &t,
                                     &density),
                      1);
            // The first density is that of random voxels, down to 1e-8 and less.
            EXPECT_NEAR(t, 0.3F, 0.1F);
            const native::float3 passed = native::grid_transmittance(
                &view, origin, direction, 0.0F, infinity, native::f3(sigma, sigma, 0.0F), &random);
            EXPECT_TRUE(passed.x == 0.0F && passed.y == 0.0F && passed.z == 1.0F);
        }
    }
}

/// Delta tracking of all channels: weighted by the ratio, channel i collides before t with
/// probability 1 - exp(-sigma_i depth(t)) and passes with the rest; no weight is above 3.
void expect_spectral_tracking(const native::DensityGrid& grid, const Line& line,
                              native::float3 sigma, const std::function<double(double)>& depth,
                              std::uint32_t samples) {
    const auto part = [](native::float3 v, int channel) {
        return static_cast<double>(channel == 0 ? v.x : (channel == 1 ? v.y : v.z));
    };
    const float middle = 0.5F * line.last;
    for (int channel = 0; channel < 3; ++channel)
        for (const bool early : {true, false}) {
            const auto sample = [&](native::Random& random) {
                native::float3 ratio = native::f3(1.0F, 1.0F, 1.0F);
                float t = 0.0F;
                float density = 0.0F;
                const bool collided =
                    native::grid_collision(&grid, line.origin, line.direction, 0.0F, line.last,
                                           sigma, &ratio, &random, &t, &density) != 0;
                const bool counts = early ? collided && t <= middle : !collided;
                // Scaled to what `estimate` expects.
                return counts ? part(ratio, channel) / 3.0 * (1.0 - 1e-5) : 0.0;
            };
            const double depth_there = part(sigma, channel) * depth(early ? middle : line.last);
            const double expected = early ? -std::expm1(-depth_there) : std::exp(-depth_there);
            if (expected == 0.0) {
                EXPECT_EQ(estimate(samples, sample).mean, 0.0);
                continue;
            }
            expect_mean(estimate(samples, sample), expected / 3.0 * (1.0 - 1e-5));
        }
}

TEST(GridTracking, ChannelsShareTheirCollisions) {
    const NativeGrid random_grid(make_random_grid({33, 17, 20}, 3));
    const NativeGrid slab(linear_slab());
    const native::DensityGrid uneven = random_grid.view();
    const native::DensityGrid linear = slab.view();
    const native::float3 origin = native::f3(0.1F, -0.2F, 1.3F);
    const Line line{origin, native::f3(0.8F, 0.9F, 0.4F) - origin, 2.0F};
    const Line across{native::f3(0.0F, 0.3F, 0.6F), native::f3(1.0F, 0.0F, 0.0F), 1.0F};
    for (const native::float3& sigma :
         {native::f3(4.0F, 8.0F, 1.0F), native::f3(1.0F, 0.1F, 3.0F)}) {
        expect_spectral_tracking(
            uneven, line, sigma,
            [&](double t) -> double {
                return native::grid_depth(&uneven, line.origin, line.direction, 0.0F,
                                          static_cast<float>(t));
            },
            many);
        expect_spectral_tracking(linear, across, sigma, slab_depth, many);
    }
    // Beyond GRID_TENTATIVE, where channels share a depth that is integrated.
    const NativeGrid sparse(make_grid({32, 8, 8}, [](std::uint32_t i, auto j, auto k) {
        return j == 0 && k == 0 ? 1.0 : (1.0 + 0.1 * (i % 7)) * 1e-4;
    }));
    const native::DensityGrid mostly_clear = sparse.view();
    const Line through{native::f3(0.0F, 0.3F, 0.3F), native::f3(1.0F, 0.3F, 0.3F), 1.0F};
    expect_spectral_tracking(
        mostly_clear, through, native::f3(1e4F, 3e3F, 2e4F),
        [&](double t) -> double {
            return native::grid_depth(&mostly_clear, through.origin, through.direction, 0.0F,
                                      static_cast<float>(t));
        },
        5000);
}

TEST(GridTracking, ChannelsMayBeClearOrOpaque) {
    const NativeGrid held(make_grid({5, 5, 5}, [](auto, auto, auto) { return 1.0; }));
    const native::DensityGrid view = held.view();
    const Line across{native::f3(0.0F, 0.3F, 0.6F), native::f3(1.0F, 0.0F, 0.0F), 1.0F};
    const auto depth = [](double t) { return t; };
    expect_spectral_tracking(view, across, native::f3(0.0F, 1.0F, 5.0F), depth, many);
}

// Whatever the ray, the density and the extinction, results are numbers within their ranges.
TEST(GridTracking, IsAlwaysDefined) {
    const float most = std::numeric_limits<float>::max();
    const std::array<float, 5> values = {0.0F, most, 1e-45F, 1.0F, 1e30F};
    const NativeGrid held(make_grid({9, 5, 5}, [&](std::uint32_t i, std::uint32_t j, auto k) {
        return values[(i + j + k) % values.size()];
    }));
    const native::DensityGrid view = held.view();
    const auto in_range = [](float share) { return share >= 0.0F && share <= 1.0F; };
    std::uint32_t n = 0;
    for (const TestRay& ray : test_rays()) {
        const std::array<float, 6> sigmas = {0.0F, 1e-45F, 1e-30F, 1.0F, 1e10F, most};
        const float sigma = sigmas[n % sigmas.size()];
        native::Random random = native::make_random(3, n++, 1);
        float t = 0.0F;
        float density = -1.0F;
        const int collided = grey_collision(&view, ray.origin, ray.direction, ray.first, ray.last,
                                            sigma, &random, &t, &density);
        ASSERT_TRUE(t <= ray.last && (collided == 0 || t >= ray.first));
        ASSERT_TRUE(density >= 0.0F && density <= most);
        const native::float3 passed =
            native::grid_transmittance(&view, ray.origin, ray.direction, ray.first, ray.last,
                                       native::f3(sigma, 0.0F, 1e-3F * sigma), &random);
        ASSERT_TRUE(in_range(passed.x) && in_range(passed.y) && in_range(passed.z));
    }
}

}  // namespace
}  // namespace weft::grid_tracking_test
