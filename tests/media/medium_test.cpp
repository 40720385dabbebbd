// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/testing/closed_forms.h"

#define NATIVE_KERNELS "kernels/media/medium.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// kernels/media/medium.h against closed forms. Estimates have fixed seeds; they may be off by 5
// standard errors, which a correct one is with a probability of 6e-7.
namespace weft::medium_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double limit = 5.0;

/// Optical depths from 1e-8 to 1e3, each as several products.
template <class Check>
void for_depths(const Check& check) {
    for (int i = 0; i <= 1100; ++i) {
        const double depth = std::pow(10.0, -8.0 + 0.01 * i);
        for (const double length : {1e-6, 0.37, 1.0, 13.7, 4e5}) {
            const auto sigma = static_cast<float>(depth / length);
            check(sigma, static_cast<float>(length),
                  static_cast<double>(sigma) * static_cast<double>(static_cast<float>(length)));
        }
    }
}

TEST(Medium, TransmittanceOfSlabs) {
    for_depths([](float sigma, float length, double depth) {
        const double expected = std::exp(-depth);
        const double found = native::transmittance1(sigma, length);
        if (expected >= static_cast<double>(std::numeric_limits<float>::min())) {
            ASSERT_NEAR(found, expected, 1e-6 * expected) << sigma << ' ' << length;
        } else {
            ASSERT_GE(found, 0.0);
            ASSERT_NEAR(found, expected, 0x1p-149) << sigma << ' ' << length;
        }
    });
}

TEST(Medium, OpacityAndLightOfSlabs) {
    for_depths([](float sigma, float length, double depth) {
        const double opacity = -std::expm1(-depth);
        ASSERT_NEAR(native::opacity1(sigma, length), opacity, 1e-6 * opacity) << depth;
        // An emitting and absorbing slab: L = (q / sigma) (1 - exp(-sigma d)), q = 1.
        const double light = opacity / static_cast<double>(sigma);
        ASSERT_NEAR(native::lit_length1(sigma, length), light, 1e-6 * light) << depth;
    });
}

TEST(Medium, SlabsAtTheEndsOfTheRange) {
    const float most = std::numeric_limits<float>::max();
    const float least = std::numeric_limits<float>::denorm_min();
    for (const float sigma : {0.0F, least, 1e-30F, 1.0F, 1e30F, most})
        for (const float length : {0.0F, least, 1e-30F, 1.0F, 1e30F, most}) {
            const double depth = static_cast<double>(sigma) * static_cast<double>(length);
            const double transmittance = native::transmittance1(sigma, length);
            EXPECT_NEAR(transmittance, std::exp(-depth), 1e-6) << sigma << ' ' << length;
            EXPECT_NEAR(native::opacity1(sigma, length), -std::expm1(-depth), 1e-6);
            const double lit = native::lit_length1(sigma, length);
            EXPECT_TRUE(std::isfinite(lit) && lit >= 0.0 && lit <= static_cast<double>(length));
        }
    EXPECT_EQ(native::transmittance1(0.0F, most), 1.0F);
}

constexpr std::array anisotropies{0.0F,  1e-30F, 1e-7F, -1e-4F, 1e-3F,   0.1F,
                                  -0.3F, 0.5F,   0.9F,  -0.99F, 0.9999F, -0.9999F};

/// Sum of f(cos, weight) over the sphere, in steps that are fine where the function peaks.
template <class Function>
double over_sphere(float g, const Function& f) {
    constexpr int steps = 200'000;
    const double gap = std::pow(1.0 - std::abs(static_cast<double>(g)), 2.0);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        // 1 - |cos| = gap (exp(x) - 1), so that 1 - cos + gap grows evenly in its logarithm.
        const double range = std::log1p(2.0 / gap);
        const double x = (i + 0.5) / steps * range;
        const double less = gap * std::expm1(x);
        const double weight = 2.0 * pi * gap * std::exp(x) * range / steps;
        sum += f(less, weight);
    }
    return sum;
}

/// Direction whose cosine with +z is g's sign times 1 - `less`.
native::float3 turned(float g, double less) {
    const double sine = std::sqrt(std::max(0.0, less * (2.0 - less)));
    const double cosine = 1.0 - less;
    return native::f3(static_cast<float>(sine), 0.0F,
                      static_cast<float>(g < 0.0F ? -cosine : cosine));
}

TEST(Medium, PhaseFunctionIsNormalisedAndHasItsMeanCosine) {
    const native::float3 along = native::f3(0.0F, 0.0F, 1.0F);
    for (const float g : anisotropies) {
        double cosines = 0.0;
        const double total = over_sphere(g, [&](double less, double weight) {
            const double p = static_cast<double>(native::phase_function(g, along, turned(g, less)));
            cosines += weight * p * (1.0 - less) * (g < 0.0F ? -1.0 : 1.0);
            return weight * p;
        });
        // Floats of directions near the pole are 6e-8 apart, beside a peak of (1 - |g|)^2.
        const double slack = std::abs(g) > 0.999F ? 2e-3 : 2e-6;
        EXPECT_NEAR(total, 1.0, slack) << g;
        EXPECT_NEAR(cosines, static_cast<double>(g), slack) << g;
    }
}

TEST(Medium, SampledDirectionsHaveThePdfOfThePhaseFunction) {
    const native::float3 along = native::normalize3(native::f3(0.3F, -0.8F, 0.5F));
    native::Random random = native::make_random(1, 2, 3);
    for (const float g : anisotropies) {
        constexpr int count = 40'000;
        std::vector<double> cosines;
        for (int i = 0; i < count; ++i) {
            const float u = native::next_random(&random);
            const float v = native::next_random(&random);
            float pdf = 0.0F;
            const native::float3 to = native::scatter_direction(g, along, u, v, &pdf);
            ASSERT_NEAR(static_cast<double>(native::length3(to)), 1.0, 1e-6);
            const double found = static_cast<double>(native::phase_function(g, along, to));
            // Of the sampled direction's rounding, which a peak of (1 - |g|)^2 magnifies.
            const double slack = std::abs(g) > 0.999F ? 0.2 : (std::abs(g) > 0.98F ? 1e-2 : 1e-4);
            ASSERT_NEAR(found / static_cast<double>(pdf), 1.0, slack) << g << ' ' << u;
            cosines.push_back(static_cast<double>(native::dot3(to, along)));
        }
        const test::Estimate mean = test::estimate(cosines);
        EXPECT_NEAR(mean.mean, static_cast<double>(g), limit * mean.error + 1e-6) << g;
    }
}

TEST(Medium, SampledDirectionsInvertTheDistribution) {
    // cos of the known inverse, in double; where it cancels, the test would be less exact.
    const native::float3 along = native::f3(0.0F, 0.0F, 1.0F);
    for (const double g : {-0.9, -0.5, 0.3, 0.75, 0.95})
        for (int i = 0; i < 1000; ++i) {
            const float u = static_cast<float>(i) / 1000.0F;
            float pdf = 0.0F;
            const native::float3 to =
                native::scatter_direction(static_cast<float>(g), along, u, 0.0F, &pdf);
            const double t = (1.0 - g * g) / (1.0 - g + 2.0 * g * static_cast<double>(u));
            EXPECT_NEAR(static_cast<double>(to.z), (1.0 + g * g - t * t) / (2.0 * g), 2e-5) << g;
        }
}

TEST(Medium, ExtremeAnisotropyStaysFinite) {
    const native::float3 along = native::f3(0.0F, 0.6F, 0.8F);
    const float last = std::nextafter(1.0F, 0.0F);
    for (const float g : {last, -last})
        for (const float u : {0.0F, 1e-7F, 0.25F, 0.5F, 0.99999994F}) {
            float pdf = 0.0F;
            const native::float3 to = native::scatter_direction(g, along, u, 0.3F, &pdf);
            EXPECT_TRUE(native::is_finite3(to)) << g << ' ' << u;
            EXPECT_TRUE(std::isfinite(pdf) && pdf > 0.0F) << g << ' ' << u;
            EXPECT_TRUE(std::isfinite(native::phase_function(g, along, to)));
            EXPECT_TRUE(std::isfinite(native::phase_function(g, along, along)));
        }
}

TEST(Medium, FreePathsOfAllChannelsTogetherAreUnbiased) {
    // The transmittance of a slab, and what is scattered inside, for channels of which some are
    // clear or opaque.
    native::Random random = native::make_random(4, 5, 6);
    for (const native::float3 sigma :
         {native::f3(1.0F, 1.0F, 1.0F), native::f3(0.1F, 1.0F, 10.0F), native::f3(0.0F, 2.0F, 1e4F),
          native::f3(1e-20F, 0.5F, 1e20F)}) {
        std::array<std::vector<double>, 3> passed;
        for (int i = 0; i < 100'000; ++i) {
            native::float3 ratio = native::f3(1.0F, 1.0F, 1.0F);
            // Two segments, so that ratios are carried on.
            bool through = true;
            for (const float length : {0.3F, 0.7F}) {
                const float choice = native::next_random(&random);
                const float u = native::next_random(&random);
                if (native::free_path(sigma, ratio, choice, u) < length) {
                    through = false;
                    break;
                }
                const native::float3 transmittance = native::beer_transmittance(sigma, length);
                ASSERT_GT(native::update_ratio(&ratio, transmittance), 0.0F);
                ASSERT_LE(native::max_component(ratio), 3.001F);
            }
            passed[0].push_back(through ? static_cast<double>(ratio.x) : 0.0);
            passed[1].push_back(through ? static_cast<double>(ratio.y) : 0.0);
            passed[2].push_back(through ? static_cast<double>(ratio.z) : 0.0);
        }
        const std::array<float, 3> by_channel{sigma.x, sigma.y, sigma.z};
        for (std::size_t c = 0; c < 3; ++c) {
            const test::Estimate found = test::estimate(passed.at(c));
            EXPECT_NEAR(found.mean, std::exp(-static_cast<double>(by_channel.at(c))),
                        limit * found.error + 1e-6)
                << c;
        }
    }
}

/// Airlight of a point light (Sun et al. 2005, here as sampled): free paths, or equi-angular.
test::Estimate airlight(bool angular, double beta, double intensity, double to_light, double gamma,
                        double depth) {
    native::Random random = native::make_random(7, 8, 9);
    const native::float3 origin = native::f3(0.1F, -0.2F, 0.3F);
    const native::float3 along = native::f3(0.0F, 0.0F, 1.0F);
    const native::float3 light =
        origin + native::f3(static_cast<float>(to_light * std::sin(gamma)), 0.0F,
                            static_cast<float>(to_light * std::cos(gamma)));
    const auto length = static_cast<float>(depth);
    const auto sigma = static_cast<float>(beta);
    const native::AngularView view = native::angular_view(origin, along, length, light);
    std::vector<double> values;
    for (int i = 0; i < 400'000; ++i) {
        const float u = native::next_random(&random);
        const float t = angular ? native::angular_sample(view, length, u)
                                : native::free_path(native::f3(sigma, sigma, sigma),
                                                    native::f3(1.0F, 1.0F, 1.0F), 0.5F, u);
        if (!angular && t >= length) {
            values.push_back(0.0);
            continue;
        }
        const double pdf = angular ? static_cast<double>(native::angular_pdf(view, t))
                                   : beta * std::exp(-beta * static_cast<double>(t));
        const double d = static_cast<double>(native::length3(light - (origin + along * t)));
        values.push_back(beta * std::exp(-beta * (static_cast<double>(t) + d)) * intensity /
                         (4.0 * pi * d * d) / pdf);
    }
    return test::estimate(values);
}

TEST(Medium, AirlightByBothEstimators) {
    for (const bool angular : {false, true}) {
        const test::Estimate found = airlight(angular, 0.3, 2.0, 1.5, 0.9, 4.0);
        EXPECT_NEAR(found.mean, 0.03389058698, limit * found.error) << angular;
        EXPECT_LT(found.error, 0.003 * 0.03389058698) << angular;
    }
}

TEST(Medium, AngularPdfIsThatOfItsSamples) {
    // Its integral is 1, wherever the light is: beside, before, behind, far away, on the ray.
    const native::float3 origin = native::f3(0.0F, 0.0F, 0.0F);
    const native::float3 along = native::f3(1.0F, 0.0F, 0.0F);
    for (const native::float3 light :
         {native::f3(1.0F, 0.5F, 0.0F), native::f3(-2.0F, 0.1F, 0.0F), native::f3(9.0F, 0.0F, 1.0F),
          native::f3(1e4F, 1e5F, 0.0F), native::f3(1.0F, 1e-3F, 0.0F)})
        for (const float length : {0.5F, 3.0F, 100.0F}) {
            const native::AngularView view = native::angular_view(origin, along, length, light);
            constexpr int count = 100'000;
            double sum = 0.0;
            for (int i = 0; i < count; ++i) {
                // Intervals between consecutive samples must have the probability 1 / count.
                const auto u = static_cast<float>(i) / count;
                const auto next = static_cast<float>(i + 1) / count;
                const double a = native::angular_sample(view, length, u);
                const double b = native::angular_sample(view, length, next);
                ASSERT_LE(a, b + 1e-6 * b);
                const float middle = native::angular_sample(view, length, 0.5F * (u + next));
                sum += (b - a) * static_cast<double>(native::angular_pdf(view, middle));
            }
            EXPECT_NEAR(sum, 1.0, 2e-3) << light.x << ' ' << light.y << ' ' << length;
        }
}

TEST(Medium, LightsOnTheRayAreFinite) {
    const native::float3 origin = native::f3(0.0F, 0.0F, 0.0F);
    const native::float3 along = native::f3(1.0F, 0.0F, 0.0F);
    for (const float at : {-1.0F, 0.0F, 1e-30F, 1.0F, 5.0F})
        for (const float length : {1e-20F, 2.0F, 3e38F}) {
            const native::AngularView view =
                native::angular_view(origin, along, length, native::f3(at, 0.0F, 0.0F));
            for (const float u : {0.0F, 0.5F, 0.99999994F}) {
                const float t = native::angular_sample(view, length, u);
                EXPECT_TRUE(t >= 0.0F && t <= length) << at << ' ' << length;
                const float pdf = native::angular_pdf(view, t);
                EXPECT_TRUE(std::isfinite(pdf) && pdf >= 0.0F) << at << ' ' << length;
            }
        }
}

}  // namespace
}  // namespace weft::medium_test
