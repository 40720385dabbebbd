// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

#define NATIVE_KERNELS "kernels/cache/hemisphere_records.cl"
#define NATIVE_KERNELS_TOO "kernels/cache/hemisphere_rays.cl"
#include "tests/testing/native_kernels.h"

// Records whose hemisphere is known in every direction, against closed forms. Rays go through the
// middles of cells, so that nothing is left to chance: what remains is the error of the midpoint
// rule, which falls with the number of cells; the tolerances are two to three times that of the
// 4068 cells used here, found by quadrature in double precision.
namespace weft::hemisphere_records_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t elevations = 36;
constexpr std::uint32_t azimuths = 113;
constexpr double rounding = 2e-5;  // sums of some thousand floats

const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));

native::float3 three(const glm::dvec3& v) {
    return native::f3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}

glm::dvec3 vector_of(const native::float3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// Tangents of the kernels' basis.
struct Basis {
    glm::dvec3 tangent, bitangent;
};

Basis basis_of(const glm::dvec3& n) {
    native::float3 t;
    native::float3 b;
    native::make_basis(three(n), &t, &b);
    return {vector_of(t), vector_of(b)};
}

using Cells = std::vector<native::float4>;

/// Cells with radiance(d) times 1, 2 and 0.5 in their channels, met after distance(d), by their
/// middle directions.
template <class Radiance, class Distance>
Cells cells_of(const Radiance& radiance, const Distance& distance) {
    Cells cells;
    for (std::uint32_t cell = 0; cell < elevations * azimuths; ++cell) {
        const glm::dvec3 d = vector_of(
            native::cell_direction(elevations, azimuths, cell, 0.5F, 0.5F, three(normal)));
        const auto light = static_cast<float>(radiance(d));
        cells.push_back(
            native::f4(light, 2.0F * light, 0.5F * light, static_cast<float>(distance(d))));
    }
    return cells;
}

native::Hemisphere hemisphere_of(const Cells& cells) {
    return native::hemisphere_of(cells.data(), elevations, azimuths, three(normal));
}

double unit_distance(const glm::dvec3&) {
    return 1.0;
}

void expect_gradient(const native::Gradient& found, const glm::dvec3& expected, double tolerance) {
    EXPECT_LE(glm::distance(vector_of(found.red), expected), tolerance);
    EXPECT_LE(glm::distance(vector_of(found.green), 2.0 * expected), 2.0 * tolerance);
    EXPECT_LE(glm::distance(vector_of(found.blue), 0.5 * expected), 0.5 * tolerance);
}

TEST(HemisphereRecords, EveryCellHoldsTheDirectionsOfItsPoints) {
    // Their solid angles, weighted by the cosine, are all pi / (M N): the bounds of sin^2 and of
    // the azimuth are even.
    const Basis basis = basis_of(normal);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0.01F, 0.99F);
    for (std::uint32_t cell = 0; cell < elevations * azimuths; ++cell) {
        const float u = uniform(random);
        const float v = uniform(random);
        const glm::dvec3 d =
            vector_of(native::cell_direction(elevations, azimuths, cell, u, v, three(normal)));
        EXPECT_NEAR(glm::length(d), 1.0, 1e-6);
        EXPECT_GE(glm::dot(d, normal), 0.0);
        const double x = glm::dot(d, basis.tangent);
        const double y = glm::dot(d, basis.bitangent);
        EXPECT_NEAR((x * x + y * y) * elevations, cell % elevations + static_cast<double>(u), 1e-4);
        const double turns = std::atan2(y, x) / (2.0 * pi);
        EXPECT_NEAR((turns < 0.0 ? turns + 1.0 : turns) * azimuths,
                    cell / elevations + static_cast<double>(v), 1e-3);
    }
}

TEST(HemisphereRecords, EvenLightHasNoSlope) {
    const native::Hemisphere all =
        hemisphere_of(cells_of([](const glm::dvec3&) { return 1.0; }, unit_distance));
    EXPECT_NEAR(static_cast<double>(all.light.x), pi, rounding * pi);
    EXPECT_NEAR(static_cast<double>(all.light.y), 2.0 * pi, rounding * 2.0 * pi);
    EXPECT_NEAR(static_cast<double>(all.distance), 1.0, rounding);
    expect_gradient(all.move, glm::dvec3(0.0), rounding);
    expect_gradient(all.turn, glm::dvec3(0.0), rounding);
}

TEST(HemisphereRecords, LinearRadianceTurns) {
    // L = 1 + a.d has E = pi + 2 pi / 3 a.n, which changes by 2 pi / 3 (n x a).(n x n') with n'.
    const glm::dvec3 a(0.3, -0.2, 0.25);
    const native::Hemisphere all = hemisphere_of(
        cells_of([&](const glm::dvec3& d) { return 1.0 + glm::dot(a, d); }, unit_distance));
    EXPECT_NEAR(static_cast<double>(all.light.x), pi + 2.0 * pi / 3.0 * glm::dot(a, normal), 5e-4);
    const glm::dvec3 turn = 2.0 * pi / 3.0 * glm::cross(normal, a);
    expect_gradient(all.turn, turn, 2e-3 * glm::length(turn));
}

TEST(HemisphereRecords, AWavyCeilingMoves) {
    // On a plane at height h above, L = 1 + cos(k x) / 2 or with the sine. The kernel h^2 / d^4 of
    // its irradiance has the Fourier transform pi k h K1(k h), so that at the place below x
    //   E = pi (1 + k h K1(k h) sin(k x) / 2).
    struct Wave {
        double height, number, bessel;  // K1(k h): Abramowitz and Stegun, table 9.8
    };
    const Basis basis = basis_of(normal);
    for (const Wave& wave : {Wave{1.0, 1.5, 0.2773878005}, Wave{0.5, 2.0, 0.6019072302}})
        for (const double phase : {0.0, 0.55, 1.2, 2.5}) {
            const double share = 0.5 * wave.number * wave.height * wave.bessel;
            const auto up = [&](const glm::dvec3& d) { return wave.height / glm::dot(d, normal); };
            const auto light = [&](const glm::dvec3& d) {
                return 1.0 +
                       0.5 * std::sin(wave.number * up(d) * glm::dot(d, basis.tangent) + phase);
            };
            const native::Hemisphere all = hemisphere_of(cells_of(light, up));
            EXPECT_NEAR(static_cast<double>(all.light.x), pi * (1.0 + share * std::sin(phase)),
                        6e-3 * pi);
            const double slope = pi * share * wave.number;
            expect_gradient(all.move, slope * std::cos(phase) * basis.tangent, 0.02 * slope);
            // The mean of cos / h is 2 / (3 h).
            EXPECT_NEAR(static_cast<double>(all.distance), 1.5 * wave.height, 1e-3 * wave.height);
        }
}

TEST(HemisphereRecords, SectorsAreExact) {
    // Light from some azimuths and from 10 units off, the others black and 1 unit off: both edges
    // move by their own nearer side. A step of s across an edge at the distance 1 moves it by
    // s / sin t, over all t by s in projected solid angle.
    const Basis basis = basis_of(normal);
    const auto aside = [&](double angle) {
        return std::cos(angle) * basis.bitangent - std::sin(angle) * basis.tangent;
    };
    for (const std::uint32_t lit : {1U, 20U, 57U, 112U}) {
        Cells cells(std::size_t{elevations} * azimuths, native::f4(0.0F, 0.0F, 0.0F, 1.0F));
        for (std::uint32_t cell = 0; cell < lit * elevations; ++cell)
            cells[cell] = native::f4(1.0F, 2.0F, 0.5F, 10.0F);
        const native::Hemisphere all = hemisphere_of(cells);
        const double end = 2.0 * pi * lit / azimuths;
        EXPECT_NEAR(static_cast<double>(all.light.x), end / 2.0, rounding);
        expect_gradient(all.move, aside(0.0) - aside(end), rounding);
        // The integral of sin^2 t is pi / 4; that of the directions aside is what is ahead.
        const glm::dvec3 ahead = std::cos(end) * basis.tangent + std::sin(end) * basis.bitangent;
        expect_gradient(all.turn, pi / 4.0 * (ahead - basis.tangent), rounding);
    }
}

TEST(HemisphereRecords, ZonesAreExact) {
    // Light from above an elevation on one half of the azimuths: a step of s towards u moves its
    // lower edge at distance r by s cos t / r, which brings sin t cos^2 t / r of light per azimuth.
    const Basis basis = basis_of(normal);
    constexpr std::uint32_t zones = 10;
    constexpr std::uint32_t half = 56;
    Cells cells(std::size_t{elevations} * azimuths, native::f4(0.0F, 0.0F, 0.0F, 4.0F));
    for (std::uint32_t cell = 0; cell < half * elevations; ++cell)
        if (cell % elevations < zones) cells[cell] = native::f4(1.0F, 2.0F, 0.5F, 3.0F);
    const native::Hemisphere all = hemisphere_of(cells);
    const double square = static_cast<double>(zones) / elevations;
    const double end = 2.0 * pi * half / azimuths;
    const glm::dvec3 sum = std::sin(end) * basis.tangent +
                           (1.0 - std::cos(end)) * basis.bitangent;  // of directions ahead
    const glm::dvec3 aside = std::cos(end) * basis.bitangent - std::sin(end) * basis.tangent;
    const glm::dvec3 sides = std::sqrt(square) / 3.0 * (basis.bitangent - aside);
    const glm::dvec3 below = -std::sqrt(square) * (1.0 - square) / 3.0 * sum;
    expect_gradient(all.move, sides + below, rounding);
}

TEST(HemisphereRecords, DirectionsBelowTheSurfaceCountForNothing) {
    // Neither do they border on anything, nor has the mean distance to do with them. Where nothing
    // is met there is no light that could move.
    Cells cells(std::size_t{elevations} * azimuths, native::f4(0.0F, 0.0F, 0.0F, 0.0F));
    for (std::uint32_t cell = 0; cell < 30 * elevations; ++cell)
        cells[cell] = native::f4(1.0F, 2.0F, 0.5F, 3.0F);
    const native::Hemisphere half = hemisphere_of(cells);
    expect_gradient(half.move, glm::dvec3(0.0), rounding);
    EXPECT_NEAR(static_cast<double>(half.distance), 3.0, 3.0 * rounding);
    const native::Hemisphere none = hemisphere_of(
        Cells(std::size_t{elevations} * azimuths, native::f4(0.0F, 0.0F, 0.0F, 0.0F)));
    EXPECT_EQ(none.distance, RAY_INFINITY);
    const native::Hemisphere open = hemisphere_of(
        Cells(std::size_t{elevations} * azimuths, native::f4(0.0F, 0.0F, 0.0F, RAY_INFINITY)));
    EXPECT_EQ(open.distance, RAY_INFINITY);
    expect_gradient(open.move, glm::dvec3(0.0), 0.0);
    for (const native::Hemisphere& dark : {none, open})
        EXPECT_TRUE(std::isfinite(native::hemisphere_reach(&dark, 0.2F)));
}

TEST(HemisphereRecords, DistancesHaveTheirHarmonicMean) {
    // Within a sphere of radius 1 a ray at angle t goes 2 cos t, whose reciprocal has the mean 1.
    // It has no bound at the horizon: the midpoint rule over sin^2 lacks -zeta(1/2, 1/2) / 2 =
    // 0.3024 over the root of the number of elevations.
    const native::Hemisphere all =
        hemisphere_of(cells_of([](const glm::dvec3&) { return 1.0; },
                               [](const glm::dvec3& d) { return 2.0 * glm::dot(d, normal); }));
    EXPECT_NEAR(1.0 / static_cast<double>(all.distance), 1.0 - 0.3024 / std::sqrt(elevations),
                5e-4);
}

TEST(HemisphereRecords, ReachIsThatOfDistanceOrSlope) {
    native::Hemisphere all{};
    all.light = native::f3(2.0F, 2.0F, 2.0F);
    all.distance = 5.0F;
    EXPECT_FLOAT_EQ(native::hemisphere_reach(&all, 0.1F), 0.5F);
    EXPECT_EQ(native::hemisphere_reach(&all, 0.0F), 0.0F);
    // Light that falls to nothing within half a unit, whatever the direction.
    for (native::float3* const channel : {&all.move.red, &all.move.green, &all.move.blue})
        *channel = native::f3(0.0F, -2.4F, 3.2F);
    EXPECT_FLOAT_EQ(native::hemisphere_reach(&all, 0.1F), 0.05F);
    all.light = native::f3(0.0F, 0.0F, 0.0F);
    EXPECT_EQ(native::hemisphere_reach(&all, 0.1F), 0.0F);
}

}  // namespace
}  // namespace weft::hemisphere_records_test
