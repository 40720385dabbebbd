// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/testing/sphere_chi_square.h"

#define NATIVE_KERNELS "kernels/bsdf/rough_glass.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// kernels/bsdf/rough_glass.h against the textbook's formulas in double, and by chi-square.
// Estimates have fixed seeds. A sampler may be off by 5.5 standard deviations of the normal
// variable in either direction: over the 24 comparisons of this file a correct one is so with a
// probability of 1e-6 (Sidak 1967).
namespace weft::rough_glass_test {
namespace {

using native::dot3;
using native::f3;
using native::Facets;
using native::float3;
using native::make_facets;
using test::SphereDirection;

constexpr double limit = 5.5;
constexpr float smallest = LEAST_ALPHA;

native::IndexRatio ratio_of(double eta) {
    return {static_cast<float>(eta), static_cast<float>((eta - 1.0) * (eta + 1.0))};
}

float3 direction(double cosine, double angle) {
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return f3(static_cast<float>(sine * std::cos(angle)),
              static_cast<float>(sine * std::sin(angle)), static_cast<float>(cosine));
}

float3 narrowed(const SphereDirection& d) {
    return f3(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
}

/// What one facet does: reflects or refracts v by the number `choice`, if to the right side.
struct Scattered {
    float3 l;
    bool refracted;
    float3 m;
    float c;
};

std::optional<Scattered> scatter(native::IndexRatio ratio, Facets facets, float3 v, float choice,
                                 float a, float b) {
    const float3 m = native::sample_facet(facets, v, 1.0F, a, b);
    const float c = std::clamp(dot3(v, m), 0.0F, 1.0F);
    const auto f = native::dielectric_fresnel(ratio, c);
    Scattered result{f3(0, 0, 0), choice >= f.reflected && f.g > 0.0F, m, c};
    result.l = result.refracted ? native::refracted_direction(ratio, v, m, c, f.g)
                                : native::reflected_direction(v, m, c);
    if (result.refracted ? result.l.z < 0.0F : result.l.z > 0.0F) return result;
    return std::nullopt;
}

double pdf_of(native::IndexRatio ratio, Facets facets, float3 v, float3 l) {
    if (l.z > 0.0F) {
        const float3 h = v + l;
        return double(native::facet_pdf(facets, v, 1.0F, h) *
                      native::dielectric_fresnel(ratio, native::facet_cosine(h)).reflected);
    }
    const auto facet = native::refracting_facet(ratio, v, l);
    return double(native::refraction_pdf(facets, v, facet) *
                  native::dielectric_fresnel(ratio, facet.c).transmitted);
}

TEST(RoughGlass, DirectionsHaveTheirPdf) {
    for (const double eta : {1.5, 1.0 / 1.5})
        for (const float alpha : {smallest, 0.05F, 0.5F, 1.0F})
            for (const double cosine : {0.05, 0.5, 1.0}) {
                const native::IndexRatio ratio = ratio_of(eta);
                const Facets facets = make_facets(alpha, alpha, 0);
                const float3 v = direction(cosine, 1.0);
                native::Random random = native::make_random(1, 2, 3);
                const auto sample = [&]() -> std::optional<SphereDirection> {
                    const float choice = native::next_random(&random);
                    const float a = native::next_random(&random);
                    const float b = native::next_random(&random);
                    const auto s = scatter(ratio, facets, v, choice, a, b);
                    if (!s) return std::nullopt;
                    return SphereDirection{double(s->l.x), double(s->l.y), double(s->l.z)};
                };
                std::vector<test::PdfPeak> peaks = {
                    {{-double(v.x), -double(v.y), double(v.z)}, double(alpha)}};
                const auto f = native::dielectric_fresnel(ratio, v.z);
                if (f.g > 0.0F) {
                    const float3 l = native::refracted_direction(ratio, v, f3(0, 0, 1), v.z, f.g);
                    peaks.push_back({{double(l.x), double(l.y), double(l.z)}, 0.3 * double(alpha)});
                }
                const test::SphereComparison found = test::compare_on_sphere(
                    [&](const SphereDirection& d) { return pdf_of(ratio, facets, v, narrowed(d)); },
                    peaks, sample, 1'000'000);
                EXPECT_LT(std::abs(found.normal), limit) << eta << ' ' << alpha << ' ' << cosine;
                EXPECT_NEAR(found.accepted, 1.0 - found.missing, 2e-3)
                    << eta << ' ' << alpha << ' ' << cosine;
            }
}

/// Walter et al. 2007, equation 21, without Fresnel's term and without the factor eta^2 of radiance
/// that is not basic, times the cosine of l.
double textbook(double eta, double alpha, float3 v, float3 l) {
    double h[3] = {double(v.x) + eta * double(l.x), double(v.y) + eta * double(l.y),
                   double(v.z) + eta * double(l.z)};
    const double length = std::hypot(h[0], h[1], h[2]) * (h[2] < 0 ? -1.0 : 1.0);
    for (double& x : h) x /= length;
    const double vh = double(v.x) * h[0] + double(v.y) * h[1] + double(v.z) * h[2];
    const double lh = double(l.x) * h[0] + double(l.y) * h[1] + double(l.z) * h[2];
    if (!(vh > 0 && lh < 0)) return 0.0;
    const double z2 = h[2] * h[2];
    const double t = (1 - z2) / (z2 * alpha * alpha);
    const double density = 1.0 / (std::numbers::pi * alpha * alpha * z2 * z2 * (1 + t) * (1 + t));
    const auto lambda = [&](float3 w) {
        const double wz = double(w.z);
        return 0.5 * (std::sqrt(1 + alpha * alpha * (1 - wz * wz) / (wz * wz)) - 1);
    };
    const double masking = 1 / (1 + lambda(v) + lambda(l));
    const double denominator = vh + eta * lh;
    return vh * std::abs(lh) / double(v.z) * eta * eta * masking * density /
           (denominator * denominator);
}

TEST(RoughGlass, RefractionIsTheTextbooks) {
    native::Random random = native::make_random(4, 5, 6);
    for (const double eta : {1.0 / 2.42, 1.0 / 1.5, 1.1, 1.5})
        for (const float alpha : {0.05F, 0.5F, 1.0F})
            for (int i = 0; i < 20'000; ++i) {
                const native::IndexRatio ratio = ratio_of(eta);
                const float a = native::next_random(&random);
                const float b = native::next_random(&random);
                const float3 v = native::cone_direction(a, b, 0.0F);
                if (!(v.z > 0.01F)) continue;
                const Facets facets = make_facets(alpha, alpha, 0);
                const float c = native::next_random(&random);
                const float d = native::next_random(&random);
                const auto s = scatter(ratio, facets, v, 1.0F, c, d);
                // Near the facet's own critical angle the Jacobian goes through 0.
                if (!s || !s->refracted || -s->l.z < 0.01F || s->c < 0.05F) continue;
                if (std::abs(dot3(s->l, s->m)) < 0.1F) continue;
                const auto facet = native::refracting_facet(ratio, v, s->l);
                const double found = double(native::facet_refraction(facets, v, s->l, facet));
                const double expected = textbook(eta, double(alpha), v, s->l);
                ASSERT_NEAR(found / expected, 1.0, 1e-3) << eta << ' ' << alpha;
                // The sampled facet is found again.
                ASSERT_NEAR(facet.c, s->c, 2e-6F) << eta;
                // A sample's weight is the share of its facets that l sees, at most 1.
                const double weight = found / double(native::refraction_pdf(facets, v, facet));
                ASSERT_LE(weight, 1.0 + 1e-5) << eta << ' ' << alpha;
                ASSERT_GT(weight, 0.0) << eta << ' ' << alpha;
            }
}

TEST(RoughGlass, IsReciprocalInBasicRadiance) {
    native::Random random = native::make_random(7, 8, 9);
    int compared = 0;
    double squares = 0.0;
    for (const unsigned flags : {0U, FACETS_SEPARABLE, FACETS_BECKMANN})
        for (const double eta : {1.0 / 2.42, 1.0 / 1.5, 1.1, 1.5})
            for (int i = 0; i < 20'000; ++i) {
                const native::IndexRatio there = ratio_of(eta);
                const native::IndexRatio back = ratio_of(1.0 / eta);
                const Facets facets = make_facets(0.4F, 0.4F, flags);
                const float a = native::next_random(&random);
                const float b = native::next_random(&random);
                const float3 v = native::cone_direction(a, b, 0.0F);
                if (!(v.z > 0.01F)) continue;
                const float c = native::next_random(&random);
                const float d = native::next_random(&random);
                const auto s = scatter(there, facets, v, 1.0F, c, d);
                if (!s || !s->refracted || -s->l.z < 0.01F) continue;
                // Seen from the other side, where l is above the surface.
                const float3 other = f3(s->l.x, s->l.y, -s->l.z);
                const float3 from = f3(v.x, v.y, -v.z);
                const auto facet = native::refracting_facet(there, v, s->l);
                const auto seen = native::refracting_facet(back, other, from);
                const double f = double(native::facet_refraction(facets, v, s->l, facet)) *
                                 double(native::dielectric_fresnel(there, facet.c).transmitted) /
                                 -double(s->l.z);
                const double g = double(native::facet_refraction(facets, other, from, seen)) *
                                 double(native::dielectric_fresnel(back, seen.c).transmitted) /
                                 double(v.z);
                if (f < 1e-6 || facet.g < 0.1F || facet.c < 0.1F) continue;
                // n_v^2 f(v, l) = n_l^2 f(l, v), but for the rounding of l.
                const double error = f / (eta * eta * g) - 1.0;
                ASSERT_LT(std::abs(error), 2e-3) << eta << ' ' << flags;
                squares += error * error;
                ++compared;
            }
    EXPECT_GT(compared, 100'000);
    EXPECT_LT(std::sqrt(squares / compared), 1e-5);
}

TEST(RoughGlass, NothingPassesWhereNoFacetRefracts) {
    const native::IndexRatio ratio = ratio_of(1.5);
    const Facets facets = make_facets(0.5F, 0.5F, 0);
    const float3 v = direction(0.3, 0.0);
    for (const float3 l : {direction(0.5, 2.0), f3(1, 0, 0), direction(-0.01, 0.0), v}) {
        const auto facet = native::refracting_facet(ratio, v, l);
        EXPECT_EQ(native::facet_refraction(facets, v, l, facet), 0.0F) << l.z;
        EXPECT_EQ(native::refraction_pdf(facets, v, facet), 0.0F) << l.z;
    }
}

TEST(RoughGlass, AllIsFiniteAtTheEnds) {
    native::Random random = native::make_random(10, 11, 12);
    for (const double eta : {1.0 + 0x1p-10, 1.0 - 0x1p-10, 1.0 / 3.0, 3.0})
        for (const float alpha : {smallest, 0.01F, 1.0F})
            for (const float height : {1e-38F, 1e-20F, 1e-7F, 1e-3F, 1.0F})
                for (int i = 0; i < 200; ++i) {
                    const native::IndexRatio ratio = ratio_of(eta);
                    const Facets facets = make_facets(alpha, alpha, 0);
                    const float sine = std::sqrt((1.0F - height) * (1.0F + height));
                    const float3 v = f3(sine, 0.0F, height);
                    const float choice = i % 2 == 0 ? 0.0F : 1.0F;
                    const float a = native::next_random(&random);
                    const float b = i < 10 ? 0.99999994F : native::next_random(&random);
                    const auto s = scatter(ratio, facets, v, choice, a, b);
                    if (!s) continue;
                    ASSERT_TRUE(native::is_finite3(s->l));
                    ASSERT_NEAR(native::length3(s->l), 1.0F, 2e-6F);
                    ASSERT_TRUE(std::isfinite(pdf_of(ratio, facets, v, s->l)))
                        << eta << ' ' << alpha << ' ' << height;
                    const auto facet = native::refracting_facet(ratio, v, s->l);
                    ASSERT_TRUE(std::isfinite(native::facet_refraction(facets, v, s->l, facet)));
                }
}

}  // namespace
}  // namespace weft::rough_glass_test
