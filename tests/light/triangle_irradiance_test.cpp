// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "tests/testing/closed_forms.h"

#define NATIVE_KERNELS "kernels/light/triangle_irradiance.h"
#include "tests/testing/native_kernels.h"

namespace {

using Triangle3 = std::array<glm::dvec3, 3>;

native::float3 to_float3(const glm::dvec3& v) {
    return native::f3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}

native::WFloat3 in_all_lanes(const glm::dvec3& v) {
    const native::float3 f = to_float3(v);
    return {native::WIDE(f.x), native::WIDE(f.y), native::WIDE(f.z)};
}

/// The kernels' irradiance at the origin, in the last lane.
double found(const glm::dvec3& normal, const Triangle3& t) {
    std::array<float, LANES> lanes{};
    native::wide_store(
        native::triangle_irradiance(in_all_lanes({0, 0, 0}), in_all_lanes(normal), to_float3(t[0]),
                                    to_float3(t[1]), to_float3(t[2])),
        lanes.data(), 0);
    return static_cast<double>(lanes[LANES - 1]);
}

/// The same in doubles: what is left of the triangle after clipping (Sutherland and Hodgman 1974),
/// by Lambert's formula.
double clipped_irradiance(const glm::dvec3& normal, const Triangle3& t) {
    std::vector<glm::dvec3> above;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& a = t.at(i);
        const glm::dvec3& b = t.at((i + 1) % 3);
        const double ha = glm::dot(a, normal);
        const double hb = glm::dot(b, normal);
        if (ha > 0.0) above.push_back(a);
        if ((ha > 0.0) != (hb > 0.0)) above.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    if (above.size() < 3) return 0.0;
    const double size = weft::test::polygon_irradiance(above, {0, 0, 0}, normal);
    const bool seen_clockwise = glm::dot(t[0], glm::cross(t[1], t[2])) > 0.0;
    return seen_clockwise ? -size : size;
}

/// Rounded to floats, as kernels get them.
glm::dvec3 rounded(const glm::dvec3& v) {
    return glm::dvec3(glm::vec3(v));
}

TEST(TriangleIrradiance, IsLambertsFormulaOfWhatIsAboveTheHorizon) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal_number;
    std::uniform_real_distribution<double> exponent(-3.0, 3.0);
    const auto vector = [&] {
        return glm::dvec3(normal_number(random), normal_number(random), normal_number(random));
    };
    std::array<int, 4> above{};
    double worst = 0.0;
    for (int trial = 0; trial < 200000; ++trial) {
        const glm::dvec3 normal = rounded(glm::normalize(vector()));
        const glm::dvec3 middle = vector() * std::exp2(exponent(random));
        const double size = std::exp2(exponent(random));
        Triangle3 t{};
        for (glm::dvec3& corner : t) corner = rounded(middle + size * vector());
        ++above.at(static_cast<std::size_t>(std::count_if(
            t.begin(), t.end(), [&](const glm::dvec3& c) { return glm::dot(c, normal) > 0.0; })));
        // Lambert's formula for a triangle whose plane the receiver all but lies in turns by half
        // a revolution with the last bit of a corner.
        const glm::dvec3 plane = glm::cross(t[1] - t[0], t[2] - t[0]);
        const double longest = std::max(
            {glm::length(t[0]), glm::length(t[1]), glm::length(t[2]), glm::length(t[1] - t[0])});
        if (std::abs(glm::dot(plane, t[0])) < 1e-3 * glm::length(plane) * longest) continue;
        worst = std::max(worst, std::abs(found(normal, t) - clipped_irradiance(normal, t)));
    }
    for (const int count : above) EXPECT_GT(count, 10000);
    // Angles of up to pi to 3 ulp, turned by cross products that cancel up to a thousandfold.
    EXPECT_LT(worst, 2e-4);
}

TEST(TriangleIrradiance, AHalfSpaceOfLightGivesPi) {
    // Four triangles about a point, just above it, reach out a million times as far.
    constexpr double far = 1e3;
    constexpr double height = 1e-3;
    const std::array<glm::dvec3, 4> corners{glm::dvec3(far, 0, height), glm::dvec3(0, far, height),
                                            glm::dvec3(-far, 0, height),
                                            glm::dvec3(0, -far, height)};
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        sum += found({0, 0, 1}, {glm::dvec3(0, 0, height), corners.at((i + 1) % 4), corners.at(i)});
    EXPECT_NEAR(sum, std::numbers::pi, 1e-5);
}

TEST(TriangleIrradiance, TakesTheSignOfTheSideThatIsSeen) {
    const Triangle3 down{glm::dvec3(0, 0, 1), {0, 1, 1}, {1, 0, 1}};
    const Triangle3 up{down[0], down[2], down[1]};
    EXPECT_GT(found({0, 0, 1}, down), 0.1);
    EXPECT_EQ(found({0, 0, 1}, up), -found({0, 0, 1}, down));
}

TEST(TriangleIrradiance, IsZeroWhereNothingIsAboveTheHorizonOrTheTriangleIsNone) {
    const Triangle3 down{glm::dvec3(0, 0, 1), {0, 1, 1}, {1, 0, 1}};
    EXPECT_EQ(found({0, 0, -1}, down), 0.0);
    EXPECT_EQ(found({0, 0, 1}, {down[0], down[0], down[0]}), 0.0);
    EXPECT_EQ(found({0, 0, 1}, {glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)}), 0.0);
    // On the horizon, and with the receiver at a corner.
    EXPECT_EQ(found({0, 0, 1}, {glm::dvec3(1, 0, 0), {0, 1, 0}, {1, 1, 0}}), 0.0);
    EXPECT_TRUE(std::isfinite(found({0, 0, 1}, {glm::dvec3(0.0), {0, 1, 1}, {1, 0, 1}})));
}

}  // namespace
