// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "scene/surface/facet_albedo.h"
#include "scene/surface/plastic_table.h"
#include "tests/testing/sphere_chi_square.h"

#define NATIVE_KERNELS "kernels/bsdf/plastic.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// kernels/bsdf/plastic.h against the formulas of Mitsuba's `plastic` and `roughplastic`. Estimates
// have fixed seeds. A sampler may be off by 5 standard deviations of the normal variable in either
// direction: over the 4 comparisons of this file a correct one is so with a probability of 2e-6
// (Sidak 1967).
namespace weft::plastic_test {
namespace {

using native::f3;
using native::float3;
using native::Plastic;
using test::SphereDirection;

constexpr double limit = 5.0;
constexpr double eta = 1.49 / 1.000277;

float3 direction(double cosine, double angle) {
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return f3(static_cast<float>(sine * std::cos(angle)),
              static_cast<float>(sine * std::sin(angle)), static_cast<float>(cosine));
}

/// A plastic; `table` has to outlive it where alpha is not 0.
Plastic make_plastic(float alpha, unsigned flags, const PlasticTable& table, bool nonlinear) {
    Plastic plastic{};
    plastic.facets = native::make_facets(alpha, alpha, flags | FACETS_SEPARABLE);
    plastic.ratio = {static_cast<float>(eta), static_cast<float>((eta - 1.0) * (eta + 1.0))};
    plastic.specular = f3(1, 1, 1);
    const float inner = native::facets_are_smooth(plastic.facets)
                            ? native::inner_reflectance(static_cast<float>(eta))
                            : table.inner_reflectance;
    plastic.body =
        native::plastic_body(f3(0.5F, 1.0F, 0.1F), inner, nonlinear, static_cast<float>(eta));
    plastic.weight = 0.6F;
    plastic.transmittance = table.transmittance.data();
    return plastic;
}

TEST(Plastic, TheFitOfInnerReflectionIsNearTheIntegral) {
    // Mitsuba's images have the fit; it is off by less than 1 % of what it stands for.
    for (const double index : {1.33, 1.49, 1.9}) {
        const native::IndexRatio ratio = {static_cast<float>(1.0 / index),
                                          static_cast<float>(1.0 / (index * index) - 1.0)};
        double sum = 0.0;
        constexpr int steps = 20'000;
        for (int i = 0; i < steps; ++i) {
            const double c = (i + 0.5) / steps;
            sum += 2.0 * c / steps *
                   double(native::dielectric_fresnel(ratio, static_cast<float>(c)).reflected);
        }
        EXPECT_NEAR(native::inner_reflectance(static_cast<float>(index)), sum, 0.01 * sum) << index;
    }
}

TEST(Plastic, ValuesAreMitsubas) {
    const PlasticTable none;
    for (const bool nonlinear : {false, true}) {
        const Plastic plastic = make_plastic(0.0F, 0, none, nonlinear);
        const float3 v = direction(0.7, 0.5);
        const float3 l = direction(0.4, 2.0);
        const double fv = double(native::dielectric_fresnel(plastic.ratio, v.z).reflected);
        const double fl = double(native::dielectric_fresnel(plastic.ratio, l.z).reflected);
        const double x = 1.0 / eta;
        const double inner = -1.4399 * x * x + 0.7099 * x + 0.6681 + 0.0636 / x;
        float pdf = 0.0F;
        const float3 found = native::plastic_eval(&plastic, v, l, &pdf);
        for (const auto& [albedo, value] :
             {std::pair{0.5, found.x}, std::pair{1.0, found.y}, std::pair{0.1, found.z}}) {
            const double expected = albedo / (1.0 - (nonlinear ? albedo * inner : inner)) /
                                    (eta * eta) * (1 - fv) * (1 - fl) * double(l.z) /
                                    std::numbers::pi;
            EXPECT_NEAR(value, expected, 1e-5 * expected) << nonlinear << ' ' << albedo;
        }
    }
}

TEST(Plastic, RoughValuesAreMitsubas) {
    for (const unsigned flags : {0U, FACETS_BECKMANN}) {
        const PlasticTable table = plastic_table(0.1, eta, flags != 0);
        const Plastic plastic = make_plastic(0.1F, flags, table, true);
        const float3 v = direction(0.7, 0.5);
        const float3 l = native::normalize3(f3(-v.x + 0.05F, -v.y, v.z));
        float pdf = 0.0F;
        const float3 found = native::plastic_eval(&plastic, v, l, &pdf);
        const float3 h = v + l;
        const double reflected =
            double(native::dielectric_fresnel(plastic.ratio, native::facet_cosine(h)).reflected) *
            double(native::facet_reflection(plastic.facets, v, l, h));
        const auto at = [&](float cosine) {
            const double x = double(cosine) * 63.0;
            const auto node = static_cast<std::size_t>(x);
            const double t = x - static_cast<double>(node);
            return (1 - t) * double(table.transmittance[node]) +
                   t * double(table.transmittance[node + 1]);
        };
        const double inner = double(table.inner_reflectance);
        const double body = 0.5 / (1.0 - 0.5 * inner) / (eta * eta) * at(v.z) * at(l.z) *
                            double(l.z) / std::numbers::pi;
        EXPECT_NEAR(found.x, reflected + body, 1e-5 * (reflected + body)) << flags;
    }
}

TEST(Plastic, TablesOfSmoothBoundariesAreFresnels) {
    for (const bool beckmann : {false, true}) {
        const PlasticTable table = plastic_table(1e-3, eta, beckmann);
        ASSERT_EQ(table.transmittance.size(), std::size_t{PLASTIC_NODES});
        const native::IndexRatio ratio = {static_cast<float>(eta),
                                          static_cast<float>((eta - 1.0) * (eta + 1.0))};
        for (int i = 3; i < PLASTIC_NODES; ++i)
            EXPECT_NEAR(
                table.transmittance[static_cast<std::size_t>(i)],
                native::dielectric_fresnel(ratio, static_cast<float>(i) / 63.0F).transmitted, 2e-3F)
                << i;
        // The sum over 64 nodes, both ends whole.
        EXPECT_NEAR(table.inner_reflectance, native::inner_reflectance(static_cast<float>(eta)),
                    0.02F);
    }
}

TEST(Plastic, TablesOfRoughBoundariesAreIntegralsOfSamples) {
    // By the lobes' own samples, for both distributions: what is transmitted is what glass of that
    // index lets through.
    for (const bool beckmann : {false, true})
        for (const double cosine : {0.2, 0.8}) {
            const native::Facets facets = native::make_facets(
                0.4F, 0.4F, FACETS_SEPARABLE | (beckmann ? FACETS_BECKMANN : 0U));
            const native::IndexRatio ratio = {static_cast<float>(eta),
                                              static_cast<float>((eta - 1.0) * (eta + 1.0))};
            const float3 v = direction(cosine, 0.0);
            double reflected = 0.0;
            constexpr int count = 1 << 16;
            for (int i = 0; i < count; ++i) {
                const float a = (static_cast<float>(i) + 0.5F) / count;
                const auto b = static_cast<float>(std::fmod(i * 0.6180339887498949, 1.0));
                const float3 m = native::sample_facet(facets, v, 1.0F, a, b);
                const float c = native::dot3(v, m);
                const float3 l = native::reflected_direction(v, m, c);
                if (!(l.z > 0.0F)) continue;
                const float3 h = v + l;
                reflected += double(native::facet_reflection(facets, v, l, h) /
                                    native::facet_pdf(facets, v, 1.0F, h) *
                                    native::dielectric_fresnel(ratio, c).reflected) /
                             count;
            }
            // Kernels have a fit of the masking of v, the table has it exact.
            if (beckmann) {
                const double a = cosine / (double(0.4F) * std::sqrt(1.0 - cosine * cosine));
                const double exact =
                    cosine * (std::erf(a) + std::exp(-a * a) / (a * std::sqrt(std::numbers::pi)));
                reflected *=
                    (cosine + double(native::masking_length(facets, v))) / (cosine + exact);
            }
            const GlassShares shares =
                FacetQuadrature(128).separable_albedo(cosine, double(0.4F), eta, beckmann);
            EXPECT_NEAR(shares.reflected, reflected, 5e-4) << beckmann << ' ' << cosine;
            EXPECT_LT(shares.reflected + shares.transmitted, 1.005);
            EXPECT_GT(shares.transmitted, 0.5);
        }
}

TEST(Plastic, ValuesAreThoseOfMitsuba) {
    // Mitsuba 3.9.1 (scalar_rgb), BSDF.eval of roughplastic for three directions of light. What is
    // left is its own quadrature and interpolation.
    struct Known {
        float alpha;
        unsigned flags;
        bool nonlinear;
        double values[3][3];
    };
    const std::vector<Known> all = {{0.1F,
                                     0U,
                                     false,
                                     {{0.536882, 0.652055, 0.444743},
                                      {0.0846761, 0.169016, 0.0172041},
                                      {0.139872, 0.278856, 0.0286849}}},
                                    {0.1F,
                                     0U,
                                     true,
                                     {{0.493685, 0.652055, 0.432782},
                                      {0.0530431, 0.169016, 0.00844456},
                                      {0.087744, 0.278856, 0.01425}}},
                                    {0.5F,
                                     0U,
                                     false,
                                     {{0.0830473, 0.150273, 0.0292667},
                                      {0.0514644, 0.0994523, 0.0130741},
                                      {0.0884673, 0.17115, 0.0223215}}},
                                    {0.5F,
                                     0U,
                                     true,
                                     {{0.0718887, 0.150273, 0.0257205},
                                      {0.0434991, 0.0994523, 0.0105427},
                                      {0.0747431, 0.17115, 0.01796}}},
                                    {0.1F,
                                     FACETS_BECKMANN,
                                     false,
                                     {{0.546463, 0.670033, 0.447608},
                                      {0.0906148, 0.18123, 0.018123},
                                      {0.148919, 0.297838, 0.0297838}}},
                                    {0.1F,
                                     FACETS_BECKMANN,
                                     true,
                                     {{0.496643, 0.670033, 0.434047},
                                      {0.0540811, 0.18123, 0.00817836},
                                      {0.0888785, 0.297838, 0.0134406}}},
                                    {0.5F,
                                     FACETS_BECKMANN,
                                     false,
                                     {{0.107862, 0.198807, 0.0351049},
                                      {0.0711093, 0.137465, 0.0180244},
                                      {0.119359, 0.229869, 0.0309509}}},
                                    {0.5F,
                                     FACETS_BECKMANN,
                                     true,
                                     {{0.0825824, 0.198807, 0.0276599},
                                      {0.052665, 0.137465, 0.0125924},
                                      {0.0886417, 0.229869, 0.0219043}}}};
    const float3 v = f3(0.6F, 0.0F, 0.8F);
    const float3 lights[3] = {f3(-0.6F, 0.0F, 0.8F), f3(0.0F, 0.8F, 0.6F), f3(0.28F, 0.0F, 0.96F)};
    for (const Known& known : all) {
        const PlasticTable table = plastic_table(double(known.alpha), eta, known.flags != 0);
        const Plastic plastic = make_plastic(known.alpha, known.flags, table, known.nonlinear);
        for (int i = 0; i < 3; ++i) {
            float pdf = 0.0F;
            const float3 value = native::plastic_eval(&plastic, v, lights[i], &pdf);
            const double found[3] = {double(value.x), double(value.y), double(value.z)};
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], known.values[i][c], 1e-3 * known.values[i][c])
                    << known.alpha << ' ' << known.flags << ' ' << known.nonlinear << ' ' << i;
        }
    }
}

TEST(Plastic, SamplesFollowTheirPdf) {
    const PlasticTable table = plastic_table(0.2, eta, false);
    for (const unsigned flags : {0U, FACETS_BECKMANN})
        for (const double cosine : {0.2, 0.9}) {
            const Plastic plastic = make_plastic(0.2F, flags, table, false);
            const float3 v = direction(cosine, 1.0);
            native::Random random = native::make_random(1, 2, 3);
            const test::SphereComparison found = test::compare_on_sphere(
                [&](const SphereDirection& d) {
                    float pdf = 0.0F;
                    native::plastic_eval(&plastic, v,
                                         f3(static_cast<float>(d.x), static_cast<float>(d.y),
                                            static_cast<float>(d.z)),
                                         &pdf);
                    return double(pdf);
                },
                {{{-double(v.x), -double(v.y), double(v.z)}, 0.2}},
                [&]() -> std::optional<SphereDirection> {
                    const float choice = native::next_random(&random);
                    const float a = native::next_random(&random);
                    const float b = native::next_random(&random);
                    const auto s = native::plastic_sample(&plastic, v, choice, a, b);
                    if (!(s.pdf > 0.0F)) return std::nullopt;
                    return SphereDirection{double(s.in.x), double(s.in.y), double(s.in.z)};
                },
                500'000);
            EXPECT_LT(std::abs(found.normal), limit) << flags << ' ' << cosine;
        }
}

TEST(Plastic, TheMirrorOfASmoothBoundaryIsADelta) {
    const PlasticTable none;
    const Plastic plastic = make_plastic(0.0F, 0, none, false);
    const float3 v = direction(0.3, 1.0);
    double mirror = 0.0;
    double body = 0.0;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
        const float choice = (static_cast<float>(i) + 0.5F) / count;
        const auto s = native::plastic_sample(&plastic, v, choice, 0.4F, 0.7F);
        if ((s.flags & BSDF_DELTA) != 0U) {
            ASSERT_EQ(s.pdf, 0.0F);
            ASSERT_EQ(s.in.x, -v.x);
            mirror += double(s.weight.x) / count;
        } else {
            ASSERT_EQ(s.flags, BSDF_REFLECTION | BSDF_DIFFUSE);
            ASSERT_GT(s.pdf, 0.0F);
            body += 1.0 / count;
        }
    }
    EXPECT_NEAR(mirror, native::dielectric_fresnel(plastic.ratio, v.z).reflected, 1e-3);
    EXPECT_GT(body, 0.2);
}

TEST(Plastic, AllIsFiniteAtTheEnds) {
    const PlasticTable table = plastic_table(1.0, eta, true);
    for (const float alpha : {0.0F, LEAST_ALPHA, 1.0F})
        for (const float height : {1.0F, 1e-7F, 1e-38F, 0.0F, -0.5F})
            for (const float choice : {0.0F, 0.5F, 0.99999994F}) {
                const Plastic plastic = make_plastic(alpha, FACETS_BECKMANN, table, true);
                const float3 v = f3(std::sqrt((1.0F - height) * (1.0F + height)), 0.0F, height);
                const auto s = native::plastic_sample(&plastic, v, choice, 0.99999994F, 0.0F);
                EXPECT_TRUE(native::is_finite3(s.in) && native::is_finite3(s.weight));
                EXPECT_TRUE(std::isfinite(s.pdf));
            }
}

}  // namespace
}  // namespace weft::plastic_test
