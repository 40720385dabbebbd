// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "selftest/chi_square.h"

#define NATIVE_KERNELS "kernels/path/path_lights.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// Random numbers and samplers against the distributions they promise: a million samples in
// 64 x 128 bins each, by chi-square. The probability of a value as large as the one found must be
// above 1e-4 over all of this file's comparisons together (Sidak 1967, for 50 of them, more than
// there are: 2e-6 each, 4.75 standard deviations of the normal variable of Wilson and Hilferty
// 1931). Seeds are fixed. Values that are as much too small are found as well, but for sequences,
// which are too even on purpose.
namespace {

using weft::selftest::Histogram;
using weft::selftest::normal_of;
using weft::selftest::turn;

constexpr std::uint32_t samples = 1'000'000;
constexpr std::size_t rows = Histogram::rows;
constexpr std::size_t columns = Histogram::columns;
constexpr double limit = 4.75;

void expect_uniform(const Histogram& histogram, const std::string& what) {
    EXPECT_LT(std::abs(histogram.normal()), limit) << what;
}

/// Counts where `place` puts the points that a sampler makes of two random numbers.
void expect_sampler(const std::string& what,
                    const std::function<void(float u, float v, Histogram&)>& count) {
    Histogram histogram;
    native::Random random = native::make_random(1, 2, 3);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float u = native::next_random(&random);
        const float v = native::next_random(&random);
        count(u, v, histogram);
    }
    expect_uniform(histogram, what);
}

double length_of(native::float3 v) {
    return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

TEST(SamplerChiSquare, TheTestSeesWhatIsWrong) {
    // The median moved by 1.7 % is already too much.
    Histogram biased;
    Histogram fair;
    native::Random random = native::make_random(1, 2, 3);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const double u = static_cast<double>(native::next_random(&random));
        const double v = static_cast<double>(native::next_random(&random));
        fair.add(u, v);
        biased.add(std::pow(u, 1.05), v);
    }
    EXPECT_LT(std::abs(fair.normal()), limit);
    EXPECT_GT(biased.normal(), limit);
    // The normal variable of known quantiles: chi-square of 100 degrees exceeds 135.807 with
    // probability 0.01, of 8191 degrees about its mean with 0.5 - 1 / (3 sqrt(pi 8191)).
    EXPECT_NEAR(normal_of(135.807, 100), 2.3263, 2e-3);
    EXPECT_NEAR(normal_of(8191.0 - 2.0 / 3.0, 8191), 0.0, 1e-3);
}

TEST(SamplerChiSquare, PairsOfOneGenerator) {
    for (const std::uint32_t lag : {1U, 2U, 3U, 10U}) {
        native::Random ahead = native::make_random(4, 5, 6);
        native::Random behind = ahead;
        for (std::uint32_t i = 0; i < lag; ++i) (void)native::next_random(&ahead);
        Histogram histogram;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const float u = native::next_random(&behind);
            histogram.add(static_cast<double>(u), static_cast<double>(native::next_random(&ahead)));
        }
        expect_uniform(histogram, "lag " + std::to_string(lag));
    }
}

/// The k-th number of a generator.
float draw(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample, std::uint32_t k) {
    native::Random random = native::make_random(seed, pixel, sample);
    for (std::uint32_t i = 0; i < k; ++i) (void)native::next_random(&random);
    return native::next_random(&random);
}

TEST(SamplerChiSquare, GeneratorsOfSamplesPixelsAndSeeds) {
    // As path tracing uses them: few numbers of very many generators with neighbouring numbers.
    Histogram within[3], samples_apart[2], pixels_apart[2], seeds_apart[2];
    for (std::uint32_t i = 0; i < samples; ++i) {
        const std::uint32_t pixel = i % 1000;
        const std::uint32_t sample = i / 1000;
        const auto u = [&](std::uint32_t k) {
            return static_cast<double>(draw(0, pixel, sample, k));
        };
        for (std::uint32_t k = 0; k < 3; ++k) within[k].add(u(k), u(k + 1));
        for (std::uint32_t k = 0; k < 2; ++k) {
            samples_apart[k].add(u(k), static_cast<double>(draw(0, pixel, sample + 1000, k)));
            pixels_apart[k].add(u(k), static_cast<double>(draw(0, pixel + 1000, sample, k)));
            seeds_apart[k].add(u(k), static_cast<double>(draw(1, pixel, sample, k)));
        }
    }
    for (std::uint32_t k = 0; k < 3; ++k)
        expect_uniform(within[k], "numbers " + std::to_string(k) + " and the next");
    for (std::uint32_t k = 0; k < 2; ++k) {
        expect_uniform(samples_apart[k], "samples, number " + std::to_string(k));
        expect_uniform(pixels_apart[k], "pixels, number " + std::to_string(k));
        expect_uniform(seeds_apart[k], "seeds, number " + std::to_string(k));
    }
}

TEST(SamplerChiSquare, NeighboursAreIndependent) {
    Histogram samples_apart, pixels_apart, seeds_apart, exchanged;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const std::uint32_t a = 2 * (i % 1000);
        const std::uint32_t b = i / 1000;
        samples_apart.add(static_cast<double>(draw(3, b, a, 0)),
                          static_cast<double>(draw(3, b, a + 1, 0)));
        pixels_apart.add(static_cast<double>(draw(3, a, b, 0)),
                         static_cast<double>(draw(3, a + 1, b, 0)));
        seeds_apart.add(static_cast<double>(draw(a, b, 7, 0)),
                        static_cast<double>(draw(a + 1, b, 7, 0)));
        // The numbers of a pixel and a sample must not be exchangeable either.
        exchanged.add(static_cast<double>(draw(3, a, b + 2000, 0)),
                      static_cast<double>(draw(3, b + 2000, a, 0)));
    }
    expect_uniform(samples_apart, "samples");
    expect_uniform(pixels_apart, "pixels");
    expect_uniform(seeds_apart, "seeds");
    expect_uniform(exchanged, "pixel and sample exchanged");
}

TEST(SamplerChiSquare, LowBitsAreRandomToo) {
    native::Random random = native::make_random(8, 9, 10);
    Histogram histogram;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float value = native::next_random(&random);
        const auto bits = static_cast<std::uint32_t>(value * 0x1p24F);
        ASSERT_LT(bits, 1U << 24);
        ASSERT_EQ(static_cast<float>(bits) * 0x1p-24F, value);
        histogram.add(static_cast<std::size_t>(bits % (rows * columns)));
    }
    expect_uniform(histogram, "low bits");
}

TEST(SamplerChiSquare, ConcentricDisk) {
    expect_sampler("disk", [](float u, float v, Histogram& histogram) {
        float x, y;
        native::concentric_disk(u, v, &x, &y);
        const double square = double(x) * double(x) + double(y) * double(y);
        ASSERT_LE(square, 1.0 + 1e-6);
        histogram.add(std::min(1.0, square), turn(double(x), double(y)));
    });
}

TEST(SamplerChiSquare, CosineDirection) {
    // Density cos / pi: the cosine's square is uniform.
    expect_sampler("cosine", [](float u, float v, Histogram& histogram) {
        const native::float3 d = native::cosine_direction(u, v);
        ASSERT_NEAR(length_of(d), 1.0, 1e-6);
        histogram.add(std::min(1.0, double(d.z) * double(d.z)), turn(double(d.x), double(d.y)));
    });
}

TEST(SamplerChiSquare, CosineDirectionAboutAnyAxis) {
    const native::float3 axis = native::normalize3(native::f3(0.3f, -0.8f, -0.6f));
    const native::float3 across = native::normalize3(native::cross3(axis, native::f3(1, 0, 0)));
    const native::float3 third = native::cross3(axis, across);
    expect_sampler("turned", [&](float u, float v, Histogram& histogram) {
        const native::float3 d = native::to_world(native::cosine_direction(u, v), axis);
        const double cosine = double(native::dot3(d, axis));
        ASSERT_GE(cosine, -1e-6);
        histogram.add(std::min(1.0, cosine * cosine),
                      turn(double(native::dot3(d, across)), double(native::dot3(d, third))));
    });
}

TEST(SamplerChiSquare, ConeDirection) {
    // Uniform over solid angle: so is the cosine.
    for (const float cos_limit : {-1.0F, 0.0F, 0.9F, 0.99F})
        expect_sampler("cone", [&](float u, float v, Histogram& histogram) {
            const native::float3 d = native::cone_direction(u, v, cos_limit);
            ASSERT_NEAR(length_of(d), 1.0, 1e-6);
            const double height = (double(d.z) - double(cos_limit)) / (1.0 - double(cos_limit));
            histogram.add(std::clamp(height, 0.0, 1.0), turn(double(d.x), double(d.y)));
        });
}

TEST(SamplerChiSquare, PointsOfTriangles) {
    // Two triangles of areas 1 and 3 with a common edge. Each is cut into 64 x 64 equal ones.
    constexpr std::size_t cuts = 64;
    const native::float4 positions[] = {native::f4(0, 0, 1, 0), native::f4(2, 0, 1, 0),
                                        native::f4(0.5f, 1, 1, 0), native::f4(1, -3, 1, 0)};
    const native::Triangle triangles[] = {{0, 1, 2, 0}, {1, 0, 3, 0}};
    const native::EmissiveTriangle emissive[] = {{0, 0.25f, 0.25f, 0}, {1, 1.0f, 0.75f, 0}};
    native::Geometry geometry{};
    geometry.positions = positions;
    geometry.triangles = triangles;
    native::LightRecord light{};
    light.count = 2;
    Histogram histogram(2 * cuts * cuts);
    native::Random random = native::make_random(1, 2, 4);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float u = native::next_random(&random);
        const float v = native::next_random(&random);
        const native::float3 p = native::sample_area(&geometry, light, emissive, u, v).position;
        ASSERT_NEAR(p.z, 1.0F, 1e-6F);
        const std::size_t which = p.y < 0.0F ? 1 : 0;
        // Barycentric coordinates: a is that of the third vertex, b that of (2, 0).
        const double a = which == 1 ? double(p.y) / -3.0 : double(p.y);
        const double b = (double(p.x) - a * (which == 1 ? 1.0 : 0.5)) / 2.0;
        ASSERT_TRUE(a >= -1e-6 && b >= -1e-6 && a + b <= 1.0 + 1e-6);
        const double s = std::clamp(a * cuts, 0.0, cuts - 1e-9);
        const double t = std::clamp(b * cuts, 0.0, cuts - 1e-9);
        const auto row = static_cast<std::size_t>(s);
        const auto column = std::min(static_cast<std::size_t>(t), cuts - 1 - row);
        // Of each square of the grid one half or both lie inside.
        const bool upper = s - std::floor(s) + t - std::floor(t) > 1.0 && row + column + 1 < cuts;
        // Row r has 2 (cuts - r) - 1 of them.
        const std::size_t first = row * (2 * cuts - row);
        histogram.add(which * cuts * cuts + first + 2 * column + (upper ? 1 : 0));
    }
    std::vector<double> probabilities(2 * cuts * cuts, 0.25 / (cuts * cuts));
    std::fill(probabilities.begin() + cuts * cuts, probabilities.end(), 0.75 / (cuts * cuts));
    EXPECT_LT(std::abs(histogram.normal(probabilities)), limit);
}

TEST(SamplerChiSquare, LightsAreChosenByTheirProbabilities) {
    // 200 lights, every seventh of which is never chosen.
    constexpr std::uint32_t count = 200;
    std::vector<native::LightRecord> lights(count);
    std::vector<double> weights;
    double total = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        weights.push_back(i % 7 == 3 ? 0.0 : 1.0 + 5.0 * ((i * 37) % 11));
        total += weights.back();
    }
    double sum = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        sum += weights[i] / total;
        lights[i].choice_cumulative = i + 1 == count ? 1.0F : static_cast<float>(sum);
        lights[i].choice_probability = static_cast<float>(weights[i] / total);
    }
    std::vector<double> probabilities;
    std::vector<std::size_t> bin_of(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        bin_of[i] = probabilities.size();
        if (weights[i] > 0.0) probabilities.push_back(weights[i] / total);
    }
    Histogram histogram(probabilities.size());
    native::Random random = native::make_random(1, 2, 5);
    for (std::uint32_t i = 0; i < samples; ++i) {
        float probability = -1.0F;
        const std::uint32_t chosen = native::choose_for_next_event(
            lights.data(), count, native::next_random(&random), &probability);
        ASSERT_GT(weights.at(chosen), 0.0) << chosen;
        ASSERT_EQ(probability, lights[chosen].choice_probability);
        histogram.add(bin_of[chosen]);
    }
    EXPECT_LT(std::abs(histogram.normal(probabilities)), limit);
}

TEST(SamplerChiSquare, WeightsOfBothTechniquesAddUpToOne) {
    native::Random random = native::make_random(1, 2, 6);
    for (int i = 0; i < 100'000; ++i) {
        const float a = std::exp2(250.0F * native::next_random(&random) - 125.0F);
        const float b = std::exp2(250.0F * native::next_random(&random) - 125.0F);
        const float wa = native::power_heuristic(a, b);
        const float wb = native::power_heuristic(b, a);
        ASSERT_NEAR(wa + wb, 1.0F, 2e-7F) << a << ' ' << b;
        const double square = std::pow(double(a) / double(b), 2.0);
        ASSERT_NEAR(double(wa), std::isinf(square) ? 1.0 : square / (1.0 + square), 1e-6);
    }
    EXPECT_EQ(native::power_heuristic(1.0F, 0.0F), 1.0F);
    EXPECT_EQ(native::power_heuristic(0.0F, 1.0F), 0.0F);
}

TEST(SamplerChiSquare, RadicalInversesFillTheSquareEvenly) {
    // Sequences: counts are as good as random or better. The light path's dimensions in pairs.
    const std::pair<std::uint32_t, std::uint32_t> pairs[] = {{PRIME_POSITION_U, PRIME_POSITION_V},
                                                             {PRIME_DIRECTION_U, PRIME_DIRECTION_V},
                                                             {PRIME_LIGHT, PRIME_POSITION_U},
                                                             {13U, 17U},
                                                             {61U, 67U}};
    for (const auto& [a, b] : pairs)
        for (const std::uint32_t key : {0U, 0xDEADBEEFU}) {
            Histogram histogram;
            for (std::uint32_t i = 0; i < samples; ++i)
                histogram.add(static_cast<double>(native::radical_inverse(a, i, key)),
                              static_cast<double>(native::radical_inverse(b, i, key)));
            EXPECT_LT(histogram.normal(), limit) << a << ", " << b << " key " << key;
        }
}

TEST(SamplerChiSquare, RadicalInversesOfDifferentKeysAreIndependent) {
    // One index under very many keys: random numbers, not a sequence.
    Histogram histogram;
    for (std::uint32_t key = 0; key < samples; ++key)
        histogram.add(static_cast<double>(native::radical_inverse(3, 12345, key)),
                      static_cast<double>(native::radical_inverse(5, 54321, key)));
    expect_uniform(histogram, "keys");
}

}  // namespace
