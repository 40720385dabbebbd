// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>

#include "film/film_sums.h"
#include "selftest/case_groups.h"
#include "selftest/chi_square.h"

#define NATIVE_KERNELS "kernels/path/path.cl"
#define NATIVE_KERNELS_TOO "kernels/media/medium.h"
#include "selftest/native_kernels.h"

// Single functions of the kernels, run natively: the distributions of samplers, and the range of
// counters.
namespace weft::selftest {
namespace {

constexpr std::uint32_t samples = 1'000'000;

double wide(float value) {
    return static_cast<double>(value);
}

double clamped(double value) {
    return std::clamp(value, 0.0, 1.0);
}

/// The normal variable of a sampler whose points, mapped by `place`, should be uniform in the unit
/// square.
double normal_of_sampler(const std::function<void(float u, float v, Histogram&)>& place) {
    Histogram histogram;
    native::Random random = native::make_random(1, 2, 3);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float u = native::next_random(&random);
        const float v = native::next_random(&random);
        place(u, v, histogram);
    }
    return histogram.normal();
}

double cosine_sampler() {
    return normal_of_sampler([](float u, float v, Histogram& histogram) {
        const native::float3 d = native::cosine_direction(u, v);
        // With the pdf cos / pi, the cosine's square is uniform.
        histogram.add(clamped(wide(d.z) * wide(d.z)), turn(wide(d.x), wide(d.y)));
    });
}

double cone_sampler() {
    constexpr float cos_limit = 0.9F;
    return normal_of_sampler([](float u, float v, Histogram& histogram) {
        const native::float3 d = native::cone_direction(u, v, cos_limit);
        const double height = (wide(d.z) - wide(cos_limit)) / (1.0 - wide(cos_limit));
        histogram.add(clamped(height), turn(wide(d.x), wide(d.y)));
    });
}

double phase_sampler(float g) {
    const native::float3 along = native::f3(0.0F, 0.0F, 1.0F);
    return normal_of_sampler([&](float u, float v, Histogram& histogram) {
        float pdf = 0.0F;
        const native::float3 d = native::scatter_direction(g, along, u, v, &pdf);
        // The distribution function of Henyey and Greenstein (1941), of the cosine.
        const double k = wide(g);
        const double t = (1.0 - k * k) / std::sqrt(1.0 + k * k - 2.0 * k * wide(d.z));
        histogram.add(clamped((t - (1.0 - k)) / (2.0 * k)), turn(wide(d.x), wide(d.y)));
    });
}

/// Tests points in a triangle, by bins that are 64 x 64 equal triangles.
double triangle_sampler() {
    constexpr std::size_t cuts = 64;
    const native::float4 positions[] = {native::f4(0, 0, 1, 0), native::f4(2, 0, 1, 0),
                                        native::f4(0.5F, 1, 1, 0)};
    const native::Triangle triangles[] = {{0, 1, 2, 0}};
    const native::EmissiveTriangle emissive[] = {{0, 1.0F, 1.0F, 0}};
    native::Geometry geometry{};
    geometry.positions = positions;
    geometry.triangles = triangles;
    native::LightRecord light{};
    light.count = 1;
    Histogram histogram(cuts * cuts);
    native::Random random = native::make_random(1, 2, 4);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float u = native::next_random(&random);
        const float v = native::next_random(&random);
        const native::float3 p = native::sample_area(&geometry, light, emissive, u, v).position;
        // Barycentric coordinates: a is that of the third vertex, b that of the second.
        const double a = wide(p.y);
        const double b = (wide(p.x) - 0.5 * a) / 2.0;
        if (!(a >= -1e-6 && b >= -1e-6 && a + b <= 1.0 + 1e-6))
            throw std::out_of_range("a sample lies outside of its triangle");
        const double s = std::clamp(a * cuts, 0.0, cuts - 1e-9);
        const double t = std::clamp(b * cuts, 0.0, cuts - 1e-9);
        const auto row = static_cast<std::size_t>(s);
        const auto column = std::min(static_cast<std::size_t>(t), cuts - 1 - row);
        // Of each square of the grid one half or both lie inside; row r has 2 (cuts - r) - 1.
        const bool upper = s - std::floor(s) + t - std::floor(t) > 1.0 && row + column + 1 < cuts;
        histogram.add(row * (2 * cuts - row) + 2 * column + (upper ? 1 : 0));
    }
    return histogram.normal();
}

SelftestCase samplers() {
    // 2e-6 of a normal variable lie outside; that is 1e-4 of 50 comparisons (Sidak 1967).
    const Tolerance tolerance = within(4.75);
    const std::string reason =
        "chi-square of 10^6 samples as a normal variable, which is farther off once in 500,000";
    return host_case(15, "samplers keep to their pdfs",
                     {{"cosine-weighted directions", 0.0, tolerance, reason},
                      {"directions of a cone", 0.0, tolerance, reason},
                      {"points of a triangle", 0.0, tolerance, reason},
                      {"Henyey-Greenstein, g = 0.6", 0.0, tolerance, reason},
                      {"Henyey-Greenstein, g = -0.9", 0.0, tolerance, reason}},
                     []() -> std::vector<Measured> {
                         return {cosine_sampler(), cone_sampler(), triangle_sampler(),
                                 phase_sampler(0.6F), phase_sampler(-0.9F)};
                     });
}

/// Number of rays that counters hold after a million work-items of 2^13 rays each.
double counted_rays() {
    native::RayCounter counter{};
    for (std::uint32_t i = 0; i < 1U << 20; ++i) native::count_rays(&counter, 1U << 13);
    return std::ldexp(static_cast<double>(counter.rays_high), 32) +
           static_cast<double>(counter.rays_low);
}

/// 2^33 in the words of an exact sum, as two halves.
double summed_words() {
    std::uint32_t words[2] = {0xFFFFFFFFU, 0U};
    native::add_to_sum(words, 2U, 1.0F, 0);
    native::add_to_sum(words, 2U, 0x1p32F, 0);
    return std::ldexp(static_cast<double>(words[1]), 32) + static_cast<double>(words[0]);
}

SelftestCase counters() {
    const std::string exact = "whole numbers are counted exactly";
    return host_case(
        31, "counts beyond 2^32",
        {{"rays of a frame", 0x1p33, within(0.0), exact},
         {"exact sum of samples", 0x1p33, within(0.0), exact},
         {"samples of a pixel, in two ranges", 4294967290.0, within(0.0), exact}},
        []() -> std::vector<Measured> {
            FilmSums sums;
            sums.ranges = {{0U, 2147483645U}, {2147483650U, 4294967295U}};
            return {counted_rays(), summed_words(), static_cast<double>(sums.samples())};
        });
}

}  // namespace

std::vector<SelftestCase> sampler_cases() {
    return {samplers(), counters()};
}

}  // namespace weft::selftest
