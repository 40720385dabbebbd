// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#define NATIVE_KERNELS "kernels/bsdf/fresnel.h"
#include "tests/testing/native_kernels.h"

// kernels/bsdf/fresnel.h against the textbook's equations in long double, closed
// forms, and at the ends of what they may be given.
namespace weft::fresnel_test {
namespace {

using native::f3;
using native::float3;

native::IndexRatio ratio_of(double eta) {
    return {static_cast<float>(eta), static_cast<float>((eta - 1.0) * (eta + 1.0))};
}

/// Reflectance and transmittance by the amplitudes of Born and Wolf, equations 1.5 (20) and (21).
struct Shares {
    long double reflected, transmitted;
};

Shares textbook(long double eta, long double c) {
    const long double square = eta * eta - (1 - c) * (1 + c);
    if (square <= 0) return {1, 0};
    const long double g = std::sqrt(square);
    const long double s = (c - g) / (c + g);
    const long double p = (eta * eta * c - g) / (eta * eta * c + g);
    const long double ts = 2 * c / (c + g);
    const long double tp = 2 * eta * c / (eta * eta * c + g);
    return {(s * s + p * p) / 2, g / c * (ts * ts + tp * tp) / 2};
}

/// 2 times the integral of the reflectance times c: what a surface reflects of even light.
double mean_reflectance(double eta) {
    constexpr int steps = 200'000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double c = (i + 0.5) / steps;
        const auto f = native::dielectric_fresnel(ratio_of(eta), static_cast<float>(c));
        sum += 2.0 * static_cast<double>(f.reflected) * c / steps;
    }
    return sum;
}

TEST(Fresnel, MeansOfDielectrics) {
    EXPECT_NEAR(mean_reflectance(1.33), 0.0659308, 2e-7);
    EXPECT_NEAR(mean_reflectance(1.5), 0.0917780, 2e-7);
    EXPECT_NEAR(mean_reflectance(2.42), 0.2125408, 2e-7);
    // Midpoints meet the kink at the critical angle with an error of (1 / steps)^1.5.
    EXPECT_NEAR(mean_reflectance(1.0 / 1.5), 0.5963458, 2e-6);
}

TEST(Fresnel, KeepsItsDigitsWhereIndicesAreNearlyEqual) {
    for (const double eta : {1.0001, 0.9999, 1.001, 1.0 / 1.5, 1.33, 1.5, 2.42, 4.0}) {
        const native::IndexRatio ratio = ratio_of(eta);
        double worst_reflected = 0.0;
        double worst_transmitted = 0.0;
        for (int i = 1; i <= 5000; ++i) {
            const float c = static_cast<float>(i) / 5000.0F;
            // Near the critical angle the rounding of the square of c alone is more.
            const double gap = eta * eta - (1.0 - double(c)) * (1.0 + double(c));
            if (eta < 1.0 && std::abs(gap) < 0.02 * (1.0 - eta)) continue;
            // Of the `eta` and `step` that the function is given.
            const long double given = std::sqrt(1.0L + static_cast<long double>(ratio.step));
            const Shares exact = textbook(given, c);
            const auto found = native::dielectric_fresnel(ratio, c);
            ASSERT_NEAR(found.reflected + found.transmitted, 1.0F, 1e-6F) << eta << ' ' << c;
            if (exact.transmitted == 0) continue;
            worst_reflected =
                std::max(worst_reflected,
                         double(std::abs((found.reflected - exact.reflected) / exact.reflected)));
            worst_transmitted = std::max(
                worst_transmitted,
                double(std::abs((found.transmitted - exact.transmitted) / exact.transmitted)));
        }
        // For eta below 1 g has lost up to two digits within what is tested.
        EXPECT_LT(worst_reflected, eta < 1.0 ? 2e-5 : 2e-6) << eta;
        EXPECT_LT(worst_transmitted, eta < 1.0 ? 2e-5 : 1e-6) << eta;
    }
}

TEST(Fresnel, ReflectionIsTotalBeyondTheCriticalAngle) {
    for (const double eta : {1.0 / 1.0011, 1.0 / 1.33, 1.0 / 1.5, 1.0 / 2.42}) {
        const native::IndexRatio ratio = ratio_of(eta);
        const auto critical = static_cast<float>(std::sqrt((1.0 - eta) * (1.0 + eta)));
        float c = critical;
        for (int i = 0; i < 64; ++i) c = std::nextafter(c, 0.0F);
        for (int i = -64; i <= 64; ++i, c = std::nextafter(c, 1.0F)) {
            const auto f = native::dielectric_fresnel(ratio, c);
            ASSERT_TRUE(f.reflected >= 0.0F && f.reflected <= 1.000001F) << eta << ' ' << i;
            ASSERT_TRUE(f.transmitted >= 0.0F && f.transmitted <= 1.0F) << eta << ' ' << i;
            if (i < -2) {
                ASSERT_EQ(f.reflected, 1.0F) << eta << ' ' << i;
                ASSERT_EQ(f.g, 0.0F);
            }
            if (i > 2) {
                ASSERT_GT(f.transmitted, 0.0F) << eta << ' ' << i;
            }
            if (!(f.g > 0.0F)) continue;
            const float sine = std::sqrt((1.0F - c) * (1.0F + c));
            const float3 l =
                native::refracted_direction(ratio, f3(sine, 0, c), f3(0, 0, 1), c, f.g);
            ASSERT_TRUE(native::is_finite3(l));
            ASSERT_NEAR(native::length3(l), 1.0F, 1e-6F);
        }
    }
}

TEST(Fresnel, RefractionObeysSnell) {
    const float3 m = native::normalize3(f3(0.2F, -0.3F, 0.9F));
    for (const double eta : {1.0 / 2.42, 1.0 / 1.5, 0.999, 1.0009765625, 1.33, 1.5, 2.42})
        for (const float3 v : {m, f3(0, 0, 1), native::normalize3(f3(-0.5F, 0.6F, 0.5F))}) {
            const native::IndexRatio ratio = ratio_of(eta);
            const float c = native::dot3(v, m);
            const auto f = native::dielectric_fresnel(ratio, c);
            if (!(f.g > 0.0F)) continue;
            const float3 l = native::refracted_direction(ratio, v, m, c, f.g);
            EXPECT_NEAR(native::length3(l), 1.0F, 1e-6F) << eta;
            EXPECT_LT(native::dot3(l, m), 0.0F) << eta;
            // Tangential components: those of v + eta l vanish.
            const float3 sum = v + l * ratio.eta;
            EXPECT_LT(native::length3(native::cross3(sum, m)), 1e-6F) << eta;
        }
}

TEST(Fresnel, NearlyEqualIndicesAreNoBoundary) {
    EXPECT_FALSE(native::bends_light(ratio_of(1.0)));
    EXPECT_FALSE(native::bends_light(ratio_of(1.0 + 0.99 * 0x1p-10)));
    EXPECT_FALSE(native::bends_light(ratio_of(1.0 - 0.99 * 0x1p-10)));
    EXPECT_TRUE(native::bends_light(ratio_of(1.0 + 1.01 * 0x1p-10)));
    EXPECT_TRUE(native::bends_light(ratio_of(1.0 - 1.01 * 0x1p-10)));
    EXPECT_LT(native::normal_reflectance(ratio_of(1.0 + 0x1p-10)), 2.4e-7F);
    EXPECT_NEAR(native::normal_reflectance(ratio_of(1.5)), 0.04F, 1e-8F);
    EXPECT_NEAR(native::normal_reflectance(ratio_of(1.0 / 1.5)), 0.04F, 1e-8F);
}

TEST(Fresnel, AllIsFiniteAtTheEnds) {
    for (const double eta : {1.0, 1.0 + 0x1p-10, 1.0 - 0x1p-10, 0.1, 10.0})
        for (const float c : {0.0F, std::numeric_limits<float>::denorm_min(), 1e-30F, 1e-10F, 1e-4F,
                              0.99999994F, 1.0F}) {
            const auto f = native::dielectric_fresnel(ratio_of(eta), c);
            EXPECT_TRUE(f.reflected >= 0.0F && f.reflected <= 1.000001F) << eta << ' ' << c;
            EXPECT_TRUE(f.transmitted >= 0.0F && f.transmitted <= 1.000001F) << eta << ' ' << c;
            EXPECT_NEAR(f.reflected + f.transmitted, 1.0F, 1e-5F) << eta << ' ' << c;
        }
    EXPECT_NEAR(native::dielectric_fresnel(ratio_of(1.5), 0.0F).reflected, 1.0F, 1e-6F);
}

/// Fresnel's equations with a complex index.
double conductor_reference(double eta, double k, double c) {
    const std::complex<double> n(eta, k);
    const std::complex<double> root = std::sqrt(n * n - (1.0 - c) * (1.0 + c));
    const double s = std::norm((c - root) / (c + root));
    const double p = std::norm((n * n * c - root) / (n * n * c + root));
    return 0.5 * (s + p);
}

TEST(Fresnel, ConductorsAreComplexDielectrics) {
    const double indices[][2] = {{0.1553, 4.8284}, {0.1384, 2.1469}, {1.6575, 9.2238},
                                 {0.1430, 3.9830}, {4.3697, 5.2065}, {1.5, 0.0},
                                 {1.5, 1e-4},      {0.05, 0.05},     {3.0, 0.3}};
    for (const auto& [eta, k] : indices)
        for (int i = 0; i <= 1000; ++i) {
            const double c = i / 1000.0;
            const float found = native::conductor_fresnel1(
                static_cast<float>(eta), static_cast<float>(k), static_cast<float>(c));
            ASSERT_NEAR(found, conductor_reference(eta, k, c), 1e-6) << eta << ' ' << k << ' ' << c;
            ASSERT_TRUE(found >= 0.0F && found <= 1.000001F);
        }
    // A perfect mirror, and what has no index at all.
    for (const float c : {0.0F, 1e-20F, 0.3F, 1.0F}) {
        EXPECT_NEAR(native::conductor_fresnel1(0.0F, 1.0F, c), 1.0F, 1e-6F) << c;
        EXPECT_TRUE(std::isfinite(native::conductor_fresnel1(0.0F, 0.0F, c))) << c;
        EXPECT_TRUE(std::isfinite(native::conductor_fresnel1(1.0F, 0.0F, c))) << c;
        EXPECT_TRUE(std::isfinite(native::conductor_fresnel1(100.0F, 100.0F, c))) << c;
    }
    EXPECT_NEAR(native::conductor_fresnel(f3(0, 0, 0), f3(1, 1, 1), 0.5F).y, 1.0F, 1e-6F);
}

TEST(Fresnel, SchlicksApproximationEndsWhereItShould) {
    const float3 f0 = f3(0.04F, 0.5F, 1.0F);
    const float3 f90 = f3(1.0F, 0.75F, 1.0F);
    EXPECT_EQ(native::schlick_fresnel(f0, f90, 1.0F).x, 0.04F);
    EXPECT_EQ(native::schlick_fresnel(f0, f90, 0.0F).y, 0.75F);
    EXPECT_EQ(native::schlick_fresnel(f0, f90, 0.3F).z, 1.0F);
    EXPECT_NEAR(native::schlick_weight(0.5F), 0.03125F, 1e-9F);
    EXPECT_EQ(native::schlick_weight(1.0000001F), 0.0F);
}

TEST(Fresnel, ColouredGlassOfItsOwnReflectanceIsExact) {
    for (const double eta : {1.0 / 2.42, 1.0 / 1.5, 1.0 + 0x1p-10, 1.33, 1.5, 2.42, 5.0})
        for (int i = 0; i <= 200; ++i) {
            const float c = static_cast<float>(i) / 200.0F;
            const native::IndexRatio ratio = ratio_of(eta);
            const float f0 = native::normal_reflectance(ratio);
            const auto exact = native::dielectric_fresnel(ratio, c);
            const auto found = native::coloured_fresnel(ratio, f3(f0, 0.0F, 1.0F), 1.0F, c);
            ASSERT_NEAR(found.reflected.x, exact.reflected, 1e-6F) << eta << ' ' << c;
            ASSERT_NEAR(found.transmitted.x, exact.transmitted, 2e-6F) << eta << ' ' << c;
            for (const auto& [r, t] : {std::pair{found.reflected.x, found.transmitted.x},
                                       std::pair{found.reflected.y, found.transmitted.y},
                                       std::pair{found.reflected.z, found.transmitted.z}}) {
                ASSERT_TRUE(r >= 0.0F && t >= 0.0F) << eta << ' ' << c;
                ASSERT_NEAR(r + t, 1.0F, 2e-6F) << eta << ' ' << c;
            }
            if (exact.g == 0.0F) {
                ASSERT_EQ(found.reflected.y, 1.0F);
            }
        }
    // Total reflection is total at specular 0 as well, and all else passes.
    const auto inside = native::coloured_fresnel(ratio_of(1.0 / 1.5), f3(0, 0, 0), 0.0F, 0.2F);
    EXPECT_EQ(inside.reflected.x, 1.0F);
    EXPECT_NEAR(native::coloured_fresnel(ratio_of(1.5), f3(0, 0, 0), 0.0F, 0.2F).transmitted.x,
                1.0F, 1e-6F);
}

}  // namespace
}  // namespace weft::fresnel_test
