// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "selftest/chi_square.h"

#define NATIVE_KERNELS "kernels/bsdf/bsdf.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// The tests hold every lobe of kernels/bsdf to what any must keep: energy, pdfs, reciprocity.
// That devices compute the same bits is tested in surfaces_opencl_test.cpp.
//
// Integrals are midpoint rules over equal solid angles. Estimates have fixed seeds. A million
// samples are counted in 32 x 64 bins by chi-square; the probability of a value as large as the one
// found must be above 1e-4 over all comparisons of this file together (Sidak 1967, for 50 of them,
// more than there are: 4.75 standard deviations of the normal variable). Tolerances: 1e-6 is eight
// roundings of a float of about 1, 2e-6 twice that for two rotations; 1e-5 is for sums over a
// quadrature, whose midpoints are exact for what is linear in the cosine.
namespace {

using native::f3;
using native::float3;
using weft::selftest::Histogram;
using weft::selftest::turn;

constexpr double pi = std::numbers::pi;
constexpr std::size_t rows = 32;
constexpr std::size_t columns = 64;
constexpr std::uint32_t samples = 1'000'000;
constexpr double limit = 4.75;

struct NamedBsdf {
    const char* name;
    native::Bsdf bsdf;
};

native::Bsdf lambert(float red, float green, float blue) {
    native::Bsdf bsdf{};
    bsdf.lobe = native::LOBE_LAMBERT;
    bsdf.albedo = f3(red, green, blue);
    return bsdf;
}

/// At least one of every kind of lobe.
std::vector<NamedBsdf> all_bsdfs() {
    return {{"Lambert, grey", lambert(0.5F, 0.5F, 0.5F)},
            {"Lambert, coloured", lambert(0.9F, 0.25F, 0.0F)},
            {"Lambert, white", lambert(1.0F, 1.0F, 1.0F)}};
}

/// A unit direction about +z.
float3 direction(double cosine, double angle) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return f3(static_cast<float>(sine * std::cos(angle)),
              static_cast<float>(sine * std::sin(angle)), static_cast<float>(cosine));
}

/// Ways that light leaves by: straight up, at an angle, nearly along the surface.
std::vector<float3> outs() {
    return {direction(1.0, 0.0), direction(0.6, 1.0), direction(0.05, 4.0)};
}

double channel(float3 v, int c) {
    return static_cast<double>(c == 0 ? v.x : (c == 1 ? v.y : v.z));
}

/// The value of one channel, 1/sr.
double value_of(const native::Bsdf& bsdf, float3 out, float3 in, int c) {
    const native::BsdfValue value = native::bsdf_eval(&bsdf, out, in);
    return channel(value.colour, c) * static_cast<double>(value.share);
}

/// Integral over the solid angle of the upper hemisphere.
double hemisphere_integral(const std::function<double(float3 in)>& f) {
    constexpr int steps = 256;
    double sum = 0.0;
    for (int j = 0; j < steps; ++j)
        for (int k = 0; k < steps; ++k)
            sum += f(direction((j + 0.5) / steps, 2.0 * pi * (k + 0.5) / steps));
    return 2.0 * pi * sum / (steps * steps);
}

using Sampler = std::function<float3(float u, float v)>;

/// The normal variable of a sampler's directions by chi-square against bsdf_pdf.
double normal_of_sampler(const native::Bsdf& bsdf, float3 out, const Sampler& sample) {
    constexpr int parts = 4;
    std::vector<double> probabilities;
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t k = 0; k < columns; ++k) {
            double sum = 0.0;
            for (int part = 0; part < parts * parts; ++part) {
                const double row = static_cast<double>(j) + (part / parts + 0.5) / parts;
                const double column = static_cast<double>(k) + (part % parts + 0.5) / parts;
                const float3 in = direction(row / rows, (column / columns - 0.5) * 2.0 * pi);
                sum += static_cast<double>(native::bsdf_pdf(&bsdf, out, in));
            }
            probabilities.push_back(2.0 * pi * sum / (parts * parts * rows * columns));
        }
    Histogram histogram(rows * columns);
    native::Random random = native::make_random(1, 2, 3);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float u = native::next_random(&random);
        const float v = native::next_random(&random);
        const float3 in = sample(u, v);
        const auto row = static_cast<std::size_t>(static_cast<double>(in.z) * rows);
        const auto column = static_cast<std::size_t>(
            turn(static_cast<double>(in.x), static_cast<double>(in.y)) * columns);
        histogram.add(std::min(row, rows - 1) * columns + std::min(column, columns - 1));
    }
    return histogram.normal(probabilities);
}

TEST(Bsdf, FurnaceReflectsTheAlbedo) {
    // In light of radiance 1 from everywhere: by quadrature of the value times the cosine.
    for (const auto& [name, bsdf] : all_bsdfs())
        for (const float3 out : outs())
            for (int c = 0; c < 3; ++c) {
                const double reflected = hemisphere_integral([&, &bsdf = bsdf](float3 in) {
                    return value_of(bsdf, out, in, c) * double(in.z);
                });
                EXPECT_NEAR(reflected, channel(native::bsdf_albedo(&bsdf, out), c), 1e-5)
                    << name << " channel " << c;
                EXPECT_LE(reflected, 1.0 + 1e-5) << name << " channel " << c;
            }
}

TEST(Bsdf, SamplesReflectTheAlbedo) {
    // The same by the directions that bsdf_sample chooses.
    for (const auto& [name, bsdf] : all_bsdfs())
        for (const float3 out : outs()) {
            native::Random random = native::make_random(4, 5, 6);
            double sums[3] = {};
            double squares[3] = {};
            constexpr int count = 100'000;
            for (int i = 0; i < count; ++i) {
                const float u = native::next_random(&random);
                const float v = native::next_random(&random);
                const native::BsdfSample sample = native::bsdf_sample(&bsdf, out, u, v);
                for (int c = 0; c < 3; ++c) {
                    sums[c] += channel(sample.weight, c);
                    squares[c] += channel(sample.weight, c) * channel(sample.weight, c);
                }
            }
            for (int c = 0; c < 3; ++c) {
                const double mean = sums[c] / count;
                const double variance = std::max(0.0, squares[c] / count - mean * mean);
                EXPECT_NEAR(mean, channel(native::bsdf_albedo(&bsdf, out), c),
                            limit * std::sqrt(variance / count) + 1e-6)
                    << name << " channel " << c;
            }
        }
}

TEST(Bsdf, WeightsAreValueTimesCosineOverPdf) {
    for (const auto& [name, bsdf] : all_bsdfs())
        for (const float3 out : outs()) {
            native::Random random = native::make_random(7, 8, 9);
            for (int i = 0; i < 10'000; ++i) {
                const float u = native::next_random(&random);
                const float v = native::next_random(&random);
                const native::BsdfSample sample = native::bsdf_sample(&bsdf, out, u, v);
                const double length =
                    std::hypot(double(sample.in.x), double(sample.in.y), double(sample.in.z));
                ASSERT_NEAR(length, 1.0, 1e-6) << name;
                ASSERT_EQ(sample.pdf, native::bsdf_pdf(&bsdf, out, sample.in)) << name;
                if (!(sample.pdf > 0.0F)) continue;
                for (int c = 0; c < 3; ++c) {
                    const double weight =
                        value_of(bsdf, out, sample.in, c) * double(sample.in.z) / sample.pdf;
                    ASSERT_NEAR(channel(sample.weight, c), weight, 1e-6) << name;
                }
            }
        }
}

TEST(Bsdf, PdfsIntegrateToOne) {
    for (const auto& [name, bsdf] : all_bsdfs())
        for (const float3 out : outs())
            EXPECT_NEAR(hemisphere_integral([&, &bsdf = bsdf](float3 in) {
                            return double(native::bsdf_pdf(&bsdf, out, in));
                        }),
                        1.0, 1e-5)
                << name;
}

TEST(Bsdf, DirectionsHaveTheirPdf) {
    for (const auto& [name, bsdf] : all_bsdfs())
        for (const float3 out : outs())
            EXPECT_LT(
                std::abs(normal_of_sampler(bsdf, out,
                                           [&, &bsdf = bsdf](float u, float v) {
                                               return native::bsdf_sample(&bsdf, out, u, v).in;
                                           })),
                limit)
                << name;
}

TEST(Bsdf, TheTestSeesOtherPdfs) {
    // Directions that are uniform over solid angle, and those of a cosine that are bent by 3 %.
    const native::Bsdf bsdf = lambert(0.5F, 0.5F, 0.5F);
    EXPECT_GT(
        normal_of_sampler(bsdf, f3(0, 0, 1),
                          [](float u, float v) { return native::cone_direction(u, v, 0.0F); }),
        limit);
    EXPECT_GT(normal_of_sampler(bsdf, f3(0, 0, 1),
                                [](float u, float v) {
                                    const float3 in = native::cosine_direction(u, v);
                                    return native::normalize3(f3(1.03F * in.x, in.y, in.z));
                                }),
              limit);
}

TEST(Bsdf, ValuesAreReciprocal) {
    for (const auto& [name, bsdf] : all_bsdfs()) {
        native::Random random = native::make_random(10, 11, 12);
        for (int i = 0; i < 10'000; ++i) {
            const float u = native::next_random(&random);
            const float v = native::next_random(&random);
            const float s = native::next_random(&random);
            const float t = native::next_random(&random);
            const float3 a = native::cone_direction(u, v, 0.0F);
            const float3 b = native::cone_direction(s, t, 0.0F);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(value_of(bsdf, a, b, c), value_of(bsdf, b, a, c), 1e-6) << name;
        }
    }
}

TEST(Bsdf, AllIsFiniteWhereTheViewerSeesTheSurfaceFromTheSideOrBelow) {
    // Interpolated normals may point away from the viewer of a triangle.
    for (const auto& [name, bsdf] : all_bsdfs())
        for (const float3 out : {direction(0.0, 1.0), f3(0.6F, 0.0F, -0.8F)}) {
            const float3 albedo = native::bsdf_albedo(&bsdf, out);
            const native::BsdfSample sample = native::bsdf_sample(&bsdf, out, 0.3F, 0.7F);
            for (int c = 0; c < 3; ++c) {
                EXPECT_TRUE(std::isfinite(channel(albedo, c))) << name;
                EXPECT_TRUE(std::isfinite(channel(sample.in, c))) << name;
                EXPECT_TRUE(std::isfinite(channel(sample.weight, c))) << name;
                EXPECT_TRUE(std::isfinite(value_of(bsdf, out, sample.in, c))) << name;
            }
            EXPECT_TRUE(std::isfinite(native::bsdf_pdf(&bsdf, out, sample.in))) << name;
        }
}

TEST(Bsdf, NothingComesFromBelowTheSurface) {
    for (const auto& [name, bsdf] : all_bsdfs()) {
        ASSERT_EQ(native::bsdf_flags(&bsdf), BSDF_DIFFUSE | BSDF_REFLECTION) << name;
        for (const float3 in : {f3(0, 0, -1), f3(0.6F, 0, -0.8F), f3(1, 0, 0)}) {
            EXPECT_EQ(value_of(bsdf, f3(0, 0, 1), in, 0), 0.0) << name;
            EXPECT_EQ(native::bsdf_pdf(&bsdf, f3(0, 0, 1), in), 0.0F) << name;
        }
    }
}

TEST(Bsdf, WhatIsDiffuseIsLambertsLaw) {
    // Composition and virtual lights know albedo and irradiance alone.
    const native::Bsdf bsdf = lambert(0.75F, 0.5F, 0.25F);
    const float3 albedo = native::bsdf_diffuse_albedo(&bsdf);
    const float3 reflectance = LAMBERT_REFLECTANCE(albedo);
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(static_cast<float>(value_of(bsdf, f3(0, 0, 1), direction(0.3, 2.0), c)),
                  static_cast<float>(channel(reflectance, c)));
    EXPECT_NEAR(LAMBERT_REFLECTANCE(LAMBERT_ALBEDO_OF_ONE), 1.0F, 1e-7F);
}

TEST(Bsdf, LocalDirectionsAreTheInverseOfTurning) {
    native::Random random = native::make_random(13, 14, 15);
    for (int i = 0; i < 10'000; ++i) {
        const float u = native::next_random(&random);
        const float v = native::next_random(&random);
        const float s = native::next_random(&random);
        const float t = native::next_random(&random);
        const float3 axis = native::cone_direction(u, v, -1.0F);
        const float3 local = native::cone_direction(s, t, -1.0F);
        const float3 back = native::local_direction(native::to_world(local, axis), axis);
        ASSERT_NEAR(back.x, local.x, 2e-6F);
        ASSERT_NEAR(back.y, local.y, 2e-6F);
        ASSERT_NEAR(back.z, local.z, 2e-6F);
    }
}

}  // namespace
