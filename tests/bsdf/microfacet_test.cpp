// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/testing/sphere_chi_square.h"

#define NATIVE_KERNELS "kernels/bsdf/microfacet.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// kernels/bsdf/microfacet.h against the textbook's formulas in double, integrals that have to be 1,
// and chi-square. Estimates have fixed seeds. A sampler may be off by 5.5 standard deviations of
// the normal variable in either direction: over the 26 comparisons of this file a correct one is so
// with a probability of 1e-6 (Sidak 1967).
namespace weft::microfacet_test {
namespace {

using native::f3;
using native::Facets;
using native::float3;
using native::make_facets;
using test::SphereDirection;

constexpr double pi = std::numbers::pi;
constexpr double limit = 5.5;
constexpr float smallest = LEAST_ALPHA;

float3 direction(double cosine, double angle) {
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return f3(static_cast<float>(sine * std::cos(angle)),
              static_cast<float>(sine * std::sin(angle)), static_cast<float>(cosine));
}

float3 narrowed(const SphereDirection& d) {
    return f3(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
}

SphereDirection widened(float3 v) {
    return {double(v.x), double(v.y), double(v.z)};
}

float3 reflected(float3 v, float3 m) {
    return m * (2.0F * native::dot3(v, m)) - v;
}

std::vector<Facets> some_facets() {
    return {make_facets(0.05F, 0.05F, 0),
            make_facets(0.5F, 0.5F, 0),
            make_facets(1.0F, 1.0F, FACETS_SEPARABLE),
            make_facets(0.5F, 0.1F, 0),
            make_facets(0.05F, 0.05F, FACETS_BECKMANN),
            make_facets(0.5F, 0.5F, FACETS_BECKMANN | FACETS_SEPARABLE),
            make_facets(0.2F, 0.7F, FACETS_BECKMANN)};
}

/// Integral over normals of f(normal) times its density and its cosine, in slopes.
template <class Function>
double over_normals(Facets facets, const Function& f) {
    constexpr int steps = 400;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double s = (i + 0.5) / steps;
        const double r = s / (1.0 - s);
        for (int j = 0; j < steps; ++j) {
            const double angle = 2.0 * pi * (j + 0.5) / steps;
            const double x = double(facets.alpha_x) * r * std::cos(angle);
            const double y = double(facets.alpha_y) * r * std::sin(angle);
            const double z = 1.0 / std::sqrt(1.0 + x * x + y * y);
            const float3 m =
                f3(static_cast<float>(-x * z), static_cast<float>(-y * z), static_cast<float>(z));
            // d(omega) = cos^3 d(slopes).
            const double area = r / ((1.0 - s) * (1.0 - s)) / steps * 2.0 * pi / steps *
                                double(facets.alpha_x) * double(facets.alpha_y);
            sum += area * std::pow(z, 4) * double(native::facet_density(facets, m)) * f(m);
        }
    }
    return sum;
}

TEST(Microfacet, NormalsCoverTheSurface) {
    for (const Facets& facets : some_facets())
        EXPECT_NEAR(over_normals(facets, [](float3) { return 1.0; }), 1.0, 1e-4)
            << facets.alpha_x << ' ' << facets.alpha_y << ' ' << facets.flags;
}

TEST(Microfacet, VisibleFacetsCoverTheView) {
    // Integral of the facets' areas as `v` sees them, times the share that it sees, is v.z (Heitz
    // 2014, equation 14). The fit of Beckmann's masking is off by 0.35 % at most.
    for (const Facets& facets : some_facets())
        for (const double cosine : {0.1, 0.5, 0.9})
            for (const double angle : {0.0, 1.0}) {
                const float3 v = direction(cosine, angle);
                const double facing = over_normals(facets, [&](float3 m) {
                    return std::max(0.0, double(native::dot3(v, m))) / double(m.z);
                });
                const double seen =
                    2.0 * cosine / (cosine + double(native::masking_length(facets, v)));
                const bool fitted = (facets.flags & FACETS_BECKMANN) != 0;
                EXPECT_NEAR(facing * seen / cosine, 1.0, fitted ? 4e-3 : 1e-3)
                    << facets.alpha_x << ' ' << facets.alpha_y << ' ' << facets.flags << ' '
                    << cosine;
            }
}

TEST(Microfacet, BeckmannsVisibleAreaIsExact) {
    for (const Facets& facets : some_facets()) {
        if ((facets.flags & FACETS_BECKMANN) == 0) continue;
        for (const double cosine : {0.003, 0.1, 0.5, 0.9, 1.0})
            for (const double angle : {0.0, 1.0}) {
                const float3 v = direction(cosine, angle);
                const double facing = over_normals(facets, [&](float3 m) {
                    return std::max(0.0, double(native::dot3(v, m))) / double(m.z);
                });
                // The error of the quadrature.
                EXPECT_NEAR(double(native::beckmann_seen(facets, v)) / facing, 1.0, 2e-4)
                    << facets.alpha_x << ' ' << facets.alpha_y << ' ' << cosine;
            }
    }
}

/// Lambda of Smith's masking, by Heitz 2014, equation 72, and Walter et al. 2007.
double lambda(Facets facets, float3 w) {
    const double x = double(facets.alpha_x) * double(w.x);
    const double y = double(facets.alpha_y) * double(w.y);
    const double slope = std::sqrt(x * x + y * y) / std::abs(double(w.z));
    if (slope == 0.0) return 0.0;
    if ((facets.flags & FACETS_BECKMANN) == 0) return 0.5 * (std::sqrt(1 + slope * slope) - 1);
    const double a = 1.0 / slope;
    return a >= 1.6 ? 0.0 : (1 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a);
}

/// F D G / (4 |v.z|), F = 1.
double textbook(Facets facets, float3 v, float3 l) {
    const double h[3] = {double(v.x) + double(l.x), double(v.y) + double(l.y),
                         double(v.z) + double(l.z)};
    const double length = std::hypot(h[0], h[1], h[2]);
    const double z = h[2] / length;
    const double x = h[0] / length / double(facets.alpha_x);
    const double y = h[1] / length / double(facets.alpha_y);
    const double area = pi * double(facets.alpha_x) * double(facets.alpha_y);
    const double t = (x * x + y * y) / (z * z);
    const double density = (facets.flags & FACETS_BECKMANN) != 0
                               ? std::exp(-t) / (area * std::pow(z, 4))
                               : 1.0 / (area * std::pow(z, 4) * (1 + t) * (1 + t));
    const double lv = lambda(facets, v);
    const double ll = lambda(facets, l);
    const double masking =
        (facets.flags & FACETS_SEPARABLE) != 0 ? 1 / ((1 + lv) * (1 + ll)) : 1 / (1 + lv + ll);
    return density * masking / (4 * double(v.z));
}

TEST(Microfacet, ReflectionsAreTheTextbooks) {
    native::Random random = native::make_random(1, 2, 3);
    for (const Facets& facets : some_facets())
        for (int i = 0; i < 20'000; ++i) {
            const float a = native::next_random(&random);
            const float b = native::next_random(&random);
            const float c = native::next_random(&random);
            const float d = native::next_random(&random);
            const float3 v = native::cone_direction(a, b, 0.0F);
            const float3 l = native::cone_direction(c, d, 0.0F);
            if (!(v.z > 1e-3F && l.z > 1e-3F)) continue;
            const double expected = textbook(facets, v, l);
            if (expected < 1e-20) continue;
            const double found = double(native::facet_reflection(facets, v, l, v + l));
            // The exponent of Beckmann's distribution magnifies its rounding.
            ASSERT_NEAR(found / expected, 1.0, (facets.flags & FACETS_BECKMANN) != 0 ? 5e-5 : 2e-5)
                << v.z << ' ' << l.z << ' ' << facets.flags;
            // The value without the cosine of l is the same with both exchanged.
            const double other = double(native::facet_reflection(facets, l, v, l + v));
            ASSERT_NEAR(found * double(v.z) / (other * double(l.z)), 1.0, 1e-5);
        }
}

TEST(Microfacet, TheDensityKeepsItsDigits) {
    // Of true directions, whose roundings are part of the error; root mean squares. The cosine's
    // formula, alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2), for comparison.
    struct Case {
        float alpha;
        double most;
        double cosine_form;
    };
    for (const auto& [alpha, most, cosine_form] :
         {Case{1e-2F, 6e-6, 5e-4}, Case{1e-3F, 6e-5, 5e-2}, Case{smallest, 2.5e-4, 0.5}}) {
        // Not make_facets: with any alpha.
        const Facets facets = {alpha, alpha, 0};
        native::Random random = native::make_random(4, 5, 6);
        double sum = 0.0;
        double cosine_sum = 0.0;
        constexpr int count = 100'000;
        for (int i = 0; i < count; ++i) {
            double u[4];
            for (double& number : u) number = double(native::next_random(&random));
            // A normal by the distribution, and a view of it.
            const double r = double(alpha) * std::sqrt(u[0] / (1.0 - u[0]));
            const double z = 1.0 / std::sqrt(1.0 + r * r);
            const double m[3] = {r * z * std::cos(2 * pi * u[1]), r * z * std::sin(2 * pi * u[1]),
                                 z};
            const double vz = 0.2 + 0.8 * u[2];
            const double vs = std::sqrt(1 - vz * vz);
            const double v[3] = {vs * std::cos(2 * pi * u[3]), vs * std::sin(2 * pi * u[3]), vz};
            const double c = v[0] * m[0] + v[1] * m[1] + v[2] * m[2];
            if (!(c > 0.1 && 2 * c * m[2] - v[2] > 0.1)) continue;
            float3 rounded[2];
            rounded[0] = narrowed({v[0], v[1], v[2]});
            rounded[1] = narrowed({2 * c * m[0] - v[0], 2 * c * m[1] - v[1], 2 * c * m[2] - v[2]});
            const double e = r * r / (double(alpha) * double(alpha));
            const double exact =
                1.0 / (pi * double(alpha) * double(alpha) * std::pow(z, 4) * (1 + e) * (1 + e));
            const float3 h = rounded[0] + rounded[1];
            const double found = double(native::facet_density(facets, h)) / exact - 1.0;
            const float cosine = native::normalize3(h).z;
            const float q = cosine * cosine * (alpha * alpha - 1.0F) + 1.0F;
            const double other = double(alpha * alpha * M_INV_PI / (q * q)) / exact - 1.0;
            sum += found * found;
            cosine_sum += std::min(other * other, 100.0);
        }
        EXPECT_LT(std::sqrt(sum / count), most) << alpha;
        EXPECT_GT(std::sqrt(cosine_sum / count), cosine_form) << alpha;
    }
}

test::SphereComparison compare(Facets facets, float3 v, bool all_facets) {
    const float k = all_facets ? 1.0F : native::reflecting_cap(facets, v);
    native::Random random = native::make_random(7, 8, 9);
    const auto pdf = [&](const SphereDirection& d) {
        const float3 l = narrowed(d);
        return l.z > 0.0F ? double(native::facet_pdf(facets, v, k, v + l)) : 0.0;
    };
    const auto sample = [&]() -> std::optional<SphereDirection> {
        const float a = native::next_random(&random);
        const float b = native::next_random(&random);
        const float3 l = reflected(v, native::sample_facet(facets, v, k, a, b));
        if (!(l.z > 0.0F)) return std::nullopt;
        return widened(l);
    };
    const double width = double(std::min(facets.alpha_x, facets.alpha_y));
    return test::compare_on_sphere(pdf, {{{-double(v.x), -double(v.y), double(v.z)}, width}},
                                   sample, 1'000'000);
}

TEST(Microfacet, ReflectedDirectionsHaveTheirPdf) {
    std::vector<Facets> all;
    for (const float alpha : {smallest, 0.05F, 0.5F, 1.0F})
        all.push_back(make_facets(alpha, alpha, 0));
    all.push_back(make_facets(0.5F, 0.1F, 0));
    for (const float alpha : {smallest, 0.05F, 0.5F, 1.0F})
        all.push_back(make_facets(alpha, alpha, FACETS_BECKMANN));
    all.push_back(make_facets(0.1F, 0.6F, FACETS_BECKMANN));
    for (const Facets& facets : all)
        for (const double cosine : {0.05, 0.4, 0.8, 1.0}) {
            const test::SphereComparison found = compare(facets, direction(cosine, 1.0), false);
            EXPECT_LT(std::abs(found.normal), limit)
                << facets.alpha_x << ' ' << cosine << ' ' << facets.flags;
            EXPECT_NEAR(found.accepted, 1.0 - found.missing, 2e-3)
                << facets.alpha_x << ' ' << cosine << ' ' << facets.flags;
        }
    for (const double cosine : {0.05, 0.8}) {
        const test::SphereComparison found =
            compare(make_facets(0.5F, 0.5F, 0), direction(cosine, 1.0), true);
        EXPECT_LT(std::abs(found.normal), limit) << cosine;
    }
}

TEST(Microfacet, FewReflectionsGoDown) {
    const Facets rough = make_facets(1.0F, 1.0F, 0);
    const Facets medium = make_facets(0.25F, 0.25F, 0);
    const float3 v = direction(0.1, 1.0);
    EXPECT_EQ(compare(rough, v, false).missing, 0.0);
    EXPECT_NEAR(compare(rough, v, true).missing, 0.090, 2e-3);
    EXPECT_NEAR(compare(medium, v, false).missing, 0.014, 2e-3);
    EXPECT_NEAR(compare(medium, v, true).missing, 0.030, 2e-3);
}

TEST(Microfacet, TheTestSeesOtherPdfs) {
    // The pdf of facets that are 2 % rougher.
    const Facets facets = make_facets(0.5F, 0.5F, 0);
    const Facets rougher = make_facets(0.51F, 0.51F, 0);
    const float3 v = direction(0.4, 1.0);
    const float k = native::reflecting_cap(facets, v);
    native::Random random = native::make_random(7, 8, 9);
    const test::SphereComparison found = test::compare_on_sphere(
        [&](const SphereDirection& d) {
            return d.z > 0.0 ? double(native::facet_pdf(rougher, v, k, v + narrowed(d))) : 0.0;
        },
        {},
        [&]() -> std::optional<SphereDirection> {
            const float a = native::next_random(&random);
            const float b = native::next_random(&random);
            const float3 l = reflected(v, native::sample_facet(facets, v, k, a, b));
            if (!(l.z > 0.0F)) return std::nullopt;
            return widened(l);
        },
        1'000'000);
    EXPECT_GT(found.normal, limit);
}

TEST(Microfacet, WeightsAreBounded) {
    native::Random random = native::make_random(10, 11, 12);
    double most_ggx = 0.0;
    double most_beckmann = 0.0;
    for (int i = 0; i < 1'000'000; ++i) {
        const float alpha = 0.01F + 0.99F * native::next_random(&random);
        const bool beckmann = native::next_random(&random) < 0.5F;
        const bool separable = native::next_random(&random) < 0.5F;
        const Facets facets = make_facets(
            alpha, alpha, (beckmann ? FACETS_BECKMANN : 0U) | (separable ? FACETS_SEPARABLE : 0U));
        const float3 v = direction(0.01 + 0.99 * double(native::next_random(&random)), 0.5);
        const float a = native::next_random(&random);
        const float b = native::next_random(&random);
        const float k = native::reflecting_cap(facets, v);
        const float3 l = reflected(v, native::sample_facet(facets, v, k, a, b));
        if (!(l.z > 0.0F)) continue;
        const float pdf = native::facet_pdf(facets, v, k, v + l);
        ASSERT_GT(pdf, 0.0F);
        const double weight = double(native::facet_reflection(facets, v, l, v + l) / pdf);
        double& most = beckmann ? most_beckmann : most_ggx;
        most = std::max(most, weight);
    }
    EXPECT_LT(most_ggx, 1.0 + 1e-5);
    // Masking is a fit, by which more than what is visible may be seen by 0.35 %.
    EXPECT_LT(most_beckmann, 1.004);
}

TEST(Microfacet, SmoothSurfacesAreThoseBelowTheLimit) {
    const float below = std::nextafter(smallest, 0.0F);
    EXPECT_TRUE(native::facets_are_smooth(make_facets(0.0F, 0.0F, 0)));
    EXPECT_TRUE(native::facets_are_smooth(make_facets(below, below, 0)));
    EXPECT_FALSE(native::facets_are_smooth(make_facets(smallest, smallest, 0)));
    const Facets raised = make_facets(0.0F, 0.5F, 0);
    EXPECT_EQ(raised.alpha_x, smallest);
    EXPECT_EQ(raised.alpha_y, 0.5F);
    // Of 8-bit roughness 0 to 3 are mirrors.
    const float three = 3.0F / 255.0F;
    const float four = 4.0F / 255.0F;
    EXPECT_TRUE(native::facets_are_smooth(make_facets(three * three, three * three, 0)));
    EXPECT_FALSE(native::facets_are_smooth(make_facets(four * four, four * four, 0)));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(native::facets_are_smooth(make_facets(nan, nan, 0)));
}

TEST(Microfacet, AllIsFiniteAtTheEnds) {
    const float largest = std::nextafter(1.0F, 0.0F);
    for (const unsigned flags : {0U, FACETS_BECKMANN, FACETS_BECKMANN | FACETS_SEPARABLE})
        for (const float alpha : {smallest, 0.01F, 1.0F, 3.0F})
            for (const float other : {smallest, 1.0F})
                for (const float height : {1e-38F, 1e-20F, 1e-7F, 1e-3F, 1.0F})
                    for (const float a : {0.0F, 0.3F, 0.5F, largest})
                        for (const float b : {0.0F, 0x1p-24F, 0.5F, largest}) {
                            const Facets facets = make_facets(alpha, other, flags);
                            const float sine = std::sqrt((1.0F - height) * (1.0F + height));
                            const float3 v = f3(sine, 0.0F, height);
                            for (const float k : {native::reflecting_cap(facets, v), 1.0F}) {
                                const float3 m = native::sample_facet(facets, v, k, a, b);
                                ASSERT_TRUE(native::is_finite3(m) && m.z >= 0.0F);
                                const float3 l = reflected(v, m);
                                ASSERT_NEAR(native::length3(l), 1.0F, 2e-6F);
                                const float3 h = v + l;
                                ASSERT_TRUE(std::isfinite(native::facet_density(facets, h)));
                                ASSERT_TRUE(std::isfinite(native::facet_pdf(facets, v, k, h)));
                                if (l.z > 0.0F) {
                                    ASSERT_TRUE(
                                        std::isfinite(native::facet_reflection(facets, v, l, h)))
                                        << alpha << ' ' << height;
                                }
                            }
                        }
}

}  // namespace
}  // namespace weft::microfacet_test
