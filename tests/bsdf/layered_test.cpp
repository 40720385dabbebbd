// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "scene/surface/facet_albedo.h"
#include "tests/bsdf/whole_glass_table.h"
#include "tests/testing/sphere_chi_square.h"

#define NATIVE_KERNELS "kernels/bsdf/layered_sample.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// Whole materials of kernels/bsdf/layered.h: that they neither gain nor lose light, that samples
// follow the pdf of all parts, and what smooth parts do. Estimates have fixed seeds. A sampler may
// be off by 5.2 standard deviations of the normal variable in either direction: over the 10
// comparisons of this file a correct one is so with a probability of 2e-6 (Sidak 1967).
namespace weft::layered_test {
namespace {

using native::dot3;
using native::f3;
using native::float3;
using native::LayeredBsdf;
using native::LayeredMaterial;
using native::make_facets;
using test::SphereDirection;

constexpr double limit = 5.2;
constexpr float largest = 0.99999994F;

native::IndexRatio ratio_of(double eta) {
    return {static_cast<float>(eta), static_cast<float>((eta - 1.0) * (eta + 1.0))};
}

float3 direction(double cosine, double angle) {
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return f3(static_cast<float>(sine * std::cos(angle)),
              static_cast<float>(sine * std::sin(angle)), static_cast<float>(cosine));
}

/// A white dielectric of index 1.5 and that roughness.
LayeredMaterial white(double roughness) {
    LayeredMaterial material{};
    const auto alpha = static_cast<float>(roughness * roughness);
    material.base = f3(1, 1, 1);
    material.f0 = f3(0.04F, 0.04F, 0.04F);
    material.f90 = 1.0F;
    material.facets = make_facets(alpha, alpha, 0);
    material.sheet = material.facets;
    material.coat_facets = make_facets(0.01F, 0.01F, 0);
    material.ratio = ratio_of(1.5);
    material.glass_albedo = 1.0F;
    material.coat_normal = f3(0, 0, 1);
    material.diffuse_normal = f3(0, 0, 1);
    material.geometric_normal = f3(0, 0, 1);
    return material;
}

double channel(float3 v, int c) {
    return static_cast<double>(c == 0 ? v.x : (c == 1 ? v.y : v.z));
}

/// Share of light from everywhere that a channel sends towards v: the mean weight of samples on a
/// grid of each part, and of both sides of facets of glass.
double furnace(const LayeredMaterial& material, float3 v, int c, int steps = 96) {
    const LayeredBsdf bsdf = native::make_layered(&material, v);
    const auto mean = [&](const std::function<double(float a, float b)>& f) {
        // Rows are shifted against each other, as facets reflect down behind an edge.
        double sum = 0.0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const double shifted = (i + 0.5) / steps + j * 0.6180339887498949;
                sum += f(std::min(static_cast<float>(shifted - std::floor(shifted)), largest),
                         (static_cast<float>(j) + 0.5F) / static_cast<float>(steps));
            }
        return sum / (steps * steps);
    };
    const auto weight = [&](float choice, float a, float b) {
        return channel(native::layered_sample(&bsdf, v, choice, a, b).weight, c);
    };
    double sum = 0.0;
    float before = 0.0F;
    for (const float part : {bsdf.p_coat, bsdf.p_boundary, bsdf.p_sheet, bsdf.p_diffuse}) {
        if (!(part > 0.0F)) continue;
        const bool glass = before == bsdf.p_coat && part == bsdf.p_boundary && bsdf.glass > 0.0F;
        sum += double(part) * mean([&](float a, float b) {
                   if (!glass) return weight(before + 0.5F * part, a, b);
                   float3 m = f3(0, 0, 1);
                   if (!native::facets_are_smooth(bsdf.facets))
                       m = native::sample_facet(bsdf.facets, v, 1.0F, a, b);
                   const float share = native::reflection_share(
                       native::boundary_fresnel(&bsdf, std::clamp(dot3(v, m), 0.0F, 1.0F)));
                   double both = 0.0;
                   if (share > 0.0F)
                       both += double(share) * weight(before + 0.5F * share * part, a, b);
                   if (share < 1.0F)
                       both += double(1.0F - share) *
                               weight(before + (0.5F + 0.5F * share) * part, a, b);
                   return both;
               });
        before += part;
    }
    return sum;
}

TEST(Layered, WhiteMaterialsKeepAllLight) {
    // Points of a coarse grid, whose error is up to 0.4 %.
    for (int i = 0; i <= 16; ++i)
        for (const double cosine : {0.02, 0.1, 0.4, 1.0})
            for (const float metallic : {0.0F, 0.4F, 1.0F})
                for (const float coat : {0.0F, 0.7F})
                    for (const float specular : {0.0F, 0.5F, 1.0F})
                        for (const bool thin : {false, true}) {
                            LayeredMaterial material = white(i / 16.0);
                            material.metallic = metallic;
                            material.coat = coat;
                            material.f0 = material.f0 * specular;
                            material.f90 = specular;
                            if (thin && metallic == 1.0F) continue;
                            if (thin) {
                                material.flags = LAYERED_THIN;
                                material.transmission = coat > 0.0F ? 0.5F : 1.0F;
                                material.sheet = native::sheet_facets(material.facets, 1.3F);
                            }
                            const double found = furnace(material, direction(cosine, 0.5), 1, 32);
                            ASSERT_NEAR(found, 1.0, 6e-3)
                                << "roughness " << i / 16.0 << " cosine " << cosine << " metallic "
                                << metallic << " coat " << coat << " specular " << specular
                                << (thin ? " thin" : "");
                        }
}

TEST(Layered, NoMaterialGainsLight) {
    // With a grid so fine that its error is below 4e-4 for what is sampled by one part, as metals,
    // and 7e-4 for what several parts have together.
    for (const double roughness : {0.0625, 0.125, 0.3125, 0.625, 1.0})
        for (const double cosine : {0.02, 0.1, 0.5}) {
            LayeredMaterial metal = white(roughness);
            metal.metallic = 1.0F;
            const float3 v = direction(cosine, 0.5);
            const double of_metal = furnace(metal, v, 0, 192);
            EXPECT_LT(of_metal, 1.0005) << roughness << ' ' << cosine;
            EXPECT_GT(of_metal, 0.995) << roughness << ' ' << cosine;
            const double of_plastic = furnace(white(roughness), v, 0, 192);
            EXPECT_LT(of_plastic, 1.0008) << roughness << ' ' << cosine;
            EXPECT_GT(of_plastic, 0.995) << roughness << ' ' << cosine;
        }
    // Anisotropic metals lose up to half of their light, but never gain any.
    for (const float ratio : {0.8F, 0.3F, 0.05F})
        for (const double cosine : {0.05, 0.3, 1.0})
            for (const double angle : {0.0, 0.8, 1.57}) {
                LayeredMaterial metal = white(0.7);
                metal.metallic = 1.0F;
                metal.facets = make_facets(0.5F, 0.5F * ratio, 0);
                const double found = furnace(metal, direction(cosine, angle), 0, 96);
                EXPECT_LT(found, 1.001) << ratio << ' ' << cosine << ' ' << angle;
                EXPECT_GT(found, 0.7) << ratio << ' ' << cosine << ' ' << angle;
            }
}

TEST(Layered, WhiteGlassKeepsAllLight) {
    for (const double eta : {1.33, 1.5, 1.0 / 1.5, 1.0 / 2.42}) {
        const std::vector<float> table = test::whole_glass_table(eta);
        for (int i = 0; i <= 16; i += 2)
            for (const double cosine : {0.02, 0.1, 0.5, 0.745, 1.0})
                for (const float transmission : {1.0F, 0.5F}) {
                    LayeredMaterial material = white(i / 16.0);
                    material.transmission = transmission;
                    material.ratio = ratio_of(eta);
                    const float f0 = native::normal_reflectance(material.ratio);
                    material.f0 = f3(f0, f0, f0);
                    material.glass_albedo = native::glass_albedo(table.data(), material.facets,
                                                                 static_cast<float>(cosine));
                    const double found = furnace(material, direction(cosine, 0.5), 2, 64);
                    EXPECT_LT(found, 1.004) << eta << ' ' << i << ' ' << cosine;
                    EXPECT_GT(found, 0.988) << eta << ' ' << i << ' ' << cosine;
                }
    }
}

TEST(Layered, SingleScatteringLosesWhatTheTablesSay) {
    const FacetQuadrature quadrature(64);
    for (const double roughness : {0.25, 0.5, 1.0})
        for (const double cosine : {0.1, 0.5, 1.0}) {
            LayeredMaterial material = white(roughness);
            material.metallic = 1.0F;
            material.flags = LAYERED_SINGLE_SCATTER;
            EXPECT_NEAR(furnace(material, direction(cosine, 0.0), 0),
                        quadrature.facet_albedo(cosine, roughness * roughness).all, 1e-3);
        }
}

/// A material with everything: coats and normals turned against each other, colours, an anisotropic
/// boundary, half of it glass.
LayeredMaterial everything(bool thin) {
    LayeredMaterial material = white(0.5);
    material.flags = thin ? LAYERED_THIN : 0U;
    material.base = f3(0.9F, 0.5F, 0.2F);
    material.metallic = 0.3F;
    material.transmission = 0.6F;
    material.f0 = f3(0.04F, 0.06F, 0.02F);
    material.f90 = 0.9F;
    material.facets = make_facets(0.4F, 0.2F, 0);
    material.sheet = native::sheet_facets(material.facets, 1.4F);
    material.coat = 0.8F;
    material.coat_facets = make_facets(0.1F, 0.1F, 0);
    material.coat_normal = native::normalize3(f3(0.1F, -0.1F, 1.0F));
    material.diffuse_normal = native::normalize3(f3(-0.2F, 0.1F, 1.0F));
    material.geometric_normal = native::normalize3(f3(0.1F, 0.2F, 1.0F));
    return material;
}

TEST(Layered, SamplesFollowThePdfOfAllParts) {
    struct Case {
        const char* name;
        LayeredMaterial material;
    };
    LayeredMaterial opaque = white(0.3);
    LayeredMaterial glass = white(0.4);
    glass.transmission = 0.7F;
    LayeredMaterial inside = glass;
    inside.ratio = ratio_of(1.0 / 1.5);
    for (const auto& [name, material] :
         {Case{"opaque", opaque}, Case{"glass", glass}, Case{"inside", inside},
          Case{"everything", everything(false)}, Case{"everything, thin", everything(true)}})
        for (const double cosine : {0.3, 0.9}) {
            const float3 v = direction(cosine, 1.0);
            const LayeredBsdf bsdf = native::make_layered(&material, v);
            native::Random random = native::make_random(1, 2, 3);
            const auto sample = [&]() -> std::optional<SphereDirection> {
                const float choice = native::next_random(&random);
                const float a = native::next_random(&random);
                const float b = native::next_random(&random);
                const auto s = native::layered_sample(&bsdf, v, choice, a, b);
                if (!(s.pdf > 0.0F)) return std::nullopt;
                return SphereDirection{double(s.in.x), double(s.in.y), double(s.in.z)};
            };
            const test::SphereComparison found = test::compare_on_sphere(
                [&](const SphereDirection& d) {
                    const float3 l = f3(static_cast<float>(d.x), static_cast<float>(d.y),
                                        static_cast<float>(d.z));
                    return double(native::layered_eval(&bsdf, v, l).pdf);
                },
                {{{-double(v.x), -double(v.y), double(v.z)}, 0.1}}, sample, 500'000);
            EXPECT_LT(std::abs(found.normal), limit) << name << ' ' << cosine;
            EXPECT_NEAR(found.accepted, 1.0 - found.missing, 3e-3) << name << ' ' << cosine;
        }
}

TEST(Layered, SamplesHaveTheWeightOfTheirValue) {
    for (const bool thin : {false, true}) {
        const LayeredMaterial material = everything(thin);
        const float3 v = direction(0.5, 2.0);
        const LayeredBsdf bsdf = native::make_layered(&material, v);
        native::Random random = native::make_random(4, 5, 6);
        unsigned seen = 0;
        for (int i = 0; i < 20'000; ++i) {
            const float choice = native::next_random(&random);
            const float a = native::next_random(&random);
            const float b = native::next_random(&random);
            const auto s = native::layered_sample(&bsdf, v, choice, a, b);
            ASSERT_EQ(s.flags & BSDF_DELTA, 0U);
            if (s.flags == 0U) {
                ASSERT_EQ(s.weight.y, 0.0F);
                continue;
            }
            seen |= s.flags;
            const auto whole = native::layered_eval(&bsdf, v, s.in);
            // The sample knows its facet, which value and pdf find again by rounded directions;
            // narrow facets, whose density falls steeply, make more of that. The weight has the
            // rounding of both.
            ASSERT_NEAR(s.pdf, whole.pdf, 2e-5F * whole.pdf);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(channel(s.weight, c) * double(s.pdf), channel(whole.value, c),
                            3e-5 * channel(whole.value, c));
            const bool above = dot3(s.in, material.geometric_normal) > 0.0F;
            ASSERT_EQ((s.flags & BSDF_REFLECTION) != 0, above);
        }
        EXPECT_EQ(seen, BSDF_DIFFUSE | BSDF_REFLECTION | BSDF_TRANSMISSION);
    }
}

TEST(Layered, SmoothPartsAreDeltas) {
    LayeredMaterial glass = white(0.0);
    glass.transmission = 1.0F;
    glass.base = f3(0.5F, 1.0F, 0.25F);
    const float3 v = direction(0.6, 0.0);
    const LayeredBsdf bsdf = native::make_layered(&glass, v);
    const auto f = native::dielectric_fresnel(glass.ratio, v.z);
    double reflected = 0.0;
    double transmitted = 0.0;
    constexpr int count = 10'000;
    for (int i = 0; i < count; ++i) {
        const float choice = (static_cast<float>(i) + 0.5F) / count;
        const auto s = native::layered_sample(&bsdf, v, choice, 0.3F, 0.6F);
        ASSERT_NE(s.flags & BSDF_DELTA, 0U);
        ASSERT_EQ(s.pdf, 0.0F);
        // In terms of the weights of all samples, what each side gets.
        if ((s.flags & BSDF_REFLECTION) != 0U) {
            ASSERT_NEAR(s.in.x, -v.x, 1e-6F);
            ASSERT_NEAR(s.in.z, v.z, 1e-6F);
            reflected += double(s.weight.x) / count;
        } else {
            ASSERT_NEAR(s.in.x, -v.x / 1.5F, 1e-6F);
            ASSERT_LT(s.in.z, 0.0F);
            transmitted += double(s.weight.x) / count;
        }
        ASSERT_EQ(native::layered_eval(&bsdf, v, s.in).pdf, 0.0F);
        ASSERT_EQ(native::layered_eval(&bsdf, v, s.in).value.x, 0.0F);
    }
    EXPECT_NEAR(reflected, double(f.reflected), 1e-3);
    EXPECT_NEAR(transmitted, 0.5 * double(f.transmitted), 1e-3);
}

TEST(Layered, MirrorsUnderADiffuseBodyAreLeftOutOfValues) {
    // A polished plastic: the value is that of the body alone, the mirror comes by samples.
    const LayeredMaterial material = white(0.0);
    const float3 v = direction(0.6, 0.0);
    const LayeredBsdf bsdf = native::make_layered(&material, v);
    const float mirror = native::schlick_fresnel(material.f0, f3(1, 1, 1), v.z).x;
    const auto whole = native::layered_eval(&bsdf, v, direction(0.5, 2.0));
    EXPECT_NEAR(whole.value.x, (1.0F - mirror) * 0.5F * M_INV_PI, 1e-6F);
    EXPECT_NEAR(whole.pdf, bsdf.p_diffuse * 0.5F * M_INV_PI, 1e-6F);
    const auto s = native::layered_sample(&bsdf, v, 0.0F, 0.5F, 0.5F);
    EXPECT_EQ(s.flags, BSDF_REFLECTION | BSDF_DELTA);
    EXPECT_NEAR(s.weight.x * bsdf.p_boundary, mirror, 1e-6F);
}

TEST(Layered, EqualIndicesLetLightPassStraightOnAtAnyRoughness) {
    for (const double roughness : {0.0, 0.5, 1.0}) {
        LayeredMaterial material = white(roughness);
        material.transmission = 1.0F;
        material.base = f3(0.5F, 1.0F, 0.25F);
        material.ratio = ratio_of(1.0 + 0x1p-11);
        material.f0 = f3(0, 0, 0);
        const float3 v = direction(0.2, 1.0);
        const LayeredBsdf bsdf = native::make_layered(&material, v);
        for (const float choice : {0.0F, 0.5F, largest}) {
            const auto s = native::layered_sample(&bsdf, v, choice, 0.1F, 0.9F);
            EXPECT_EQ(s.flags, BSDF_TRANSMISSION | BSDF_DELTA);
            EXPECT_EQ(s.in.x, -v.x);
            EXPECT_EQ(s.in.z, -v.z);
            EXPECT_NEAR(s.weight.x, 0.5F, 1e-6F);
            EXPECT_NEAR(s.weight.y, 1.0F, 1e-6F);
        }
    }
}

TEST(Layered, RoughnessCrossesTheSmoothLimitWithoutAStep) {
    // What a part sends towards v just below the limit and just above it.
    const float below = std::nextafter(LEAST_ALPHA, 0.0F);
    for (const double cosine : {0.1, 0.3, 0.6, 1.0})
        for (const int kind : {0, 1, 2, 3}) {
            LayeredMaterial material = white(0.5);
            material.base = f3(0.8F, 0.5F, 0.3F);
            if (kind == 0) material.metallic = 1.0F;
            if (kind == 1) material.coat = 1.0F;
            if (kind == 2) material.transmission = 1.0F;
            if (kind == 3) {
                material.flags = LAYERED_THIN;
                material.transmission = 1.0F;
            }
            const float3 v = direction(cosine, 0.3);
            double albedos[2];
            for (const int rough : {0, 1}) {
                const float alpha = rough == 1 ? LEAST_ALPHA : below;
                material.facets = make_facets(alpha, alpha, 0);
                material.sheet = material.facets;
                material.coat_facets = material.facets;
                albedos[rough] = furnace(material, v, 0, 32);
            }
            EXPECT_NEAR(albedos[1], albedos[0], 3e-3) << kind << ' ' << cosine;
        }
    // Rough sheets reflect what smooth ones do.
    LayeredMaterial sheet = white(0.0);
    sheet.flags = LAYERED_THIN;
    sheet.transmission = 1.0F;
    for (const double cosine : {0.1, 0.3, 0.6, 1.0}) {
        const float3 v = direction(cosine, 0.0);
        sheet.facets = make_facets(LEAST_ALPHA, LEAST_ALPHA, 0);
        const LayeredBsdf bsdf = native::make_layered(&sheet, v);
        EXPECT_NEAR(1.0F - bsdf.sheet_colour.x,
                    native::dielectric_fresnel(sheet.ratio, v.z).reflected, 3e-3F)
            << cosine;
    }
}

TEST(Layered, ConductorsReflectByTheirIndex) {
    LayeredMaterial gold = white(0.0);
    gold.flags = LAYERED_CONDUCTOR | LAYERED_SINGLE_SCATTER;
    gold.metallic = 1.0F;
    gold.eta = f3(0.1430F, 0.3753F, 1.4420F);
    gold.k = f3(3.9830F, 2.3856F, 1.6034F);
    const float3 v = direction(0.4, 0.0);
    const LayeredBsdf smooth = native::make_layered(&gold, v);
    const float3 f = native::conductor_fresnel(gold.eta, gold.k, v.z);
    const auto s = native::layered_sample(&smooth, v, 0.5F, 0.1F, 0.2F);
    EXPECT_EQ(s.flags, BSDF_REFLECTION | BSDF_DELTA);
    EXPECT_NEAR(s.weight.x, f.x, 1e-6F);
    EXPECT_NEAR(s.weight.z, f.z, 1e-6F);
    EXPECT_NEAR(native::layered_albedo(&smooth, v).y, f.y, 1e-6F);
    // The value of rough gold, with Mitsuba's choice of distribution and masking.
    gold.facets = make_facets(0.3F, 0.3F, FACETS_BECKMANN | FACETS_SEPARABLE);
    const LayeredBsdf rough = native::make_layered(&gold, v);
    const float3 l = direction(0.7, 2.5);
    const float3 h = v + l;
    const float shape = native::facet_reflection(gold.facets, v, l, h);
    const float3 colour = native::conductor_fresnel(gold.eta, gold.k, native::facet_cosine(h));
    EXPECT_NEAR(native::layered_eval(&rough, v, l).value.x, shape * colour.x, 1e-6F);
    EXPECT_NEAR(native::layered_eval(&rough, v, l).value.z, shape * colour.z, 1e-6F);
}

TEST(Layered, FacetsAreReciprocal) {
    // Without the light of later reflections, whose factor goes by the viewer alone.
    struct Case {
        native::Facets facets;
        std::uint32_t flags;
    };
    const Case cases[] = {
        {make_facets(LEAST_ALPHA, LEAST_ALPHA, 0), 0},
        {make_facets(0.05F, 0.05F, 0), 0},
        {make_facets(0.6F, 0.2F, 0), 0},
        {make_facets(1.0F, 1.0F, FACETS_BECKMANN | FACETS_SEPARABLE), LAYERED_CONDUCTOR},
        {make_facets(0.3F, 0.1F, FACETS_SEPARABLE), LAYERED_CONDUCTOR}};
    native::Random random = native::make_random(10, 11, 12);
    for (const auto& [facets, flags] : cases) {
        LayeredMaterial material = white(0.5);
        material.flags = LAYERED_SINGLE_SCATTER | flags;
        material.metallic = 1.0F;
        material.base = f3(0.9F, 0.5F, 0.2F);
        material.eta = f3(0.2F, 1.5F, 3.0F);
        material.k = f3(3.0F, 2.0F, 0.5F);
        material.facets = facets;
        int compared = 0;
        for (int i = 0; i < 2'000; ++i) {
            const float3 v = direction(0.05 + 0.95 * double(native::next_random(&random)),
                                       6.28 * double(native::next_random(&random)));
            // Directions that facets send light into, so that values of narrow lobes are not 0.
            const float a = native::next_random(&random);
            const float b = native::next_random(&random);
            const float3 m = native::sample_facet(facets, v, 1.0F, a, b);
            const float3 l = native::reflected_direction(v, m, dot3(v, m));
            if (!(l.z > 0.05F)) continue;
            const LayeredBsdf to_v = native::make_layered(&material, v);
            const LayeredBsdf to_l = native::make_layered(&material, l);
            for (int c = 0; c < 3; ++c) {
                const double one = channel(native::layered_eval(&to_v, v, l).value, c) / l.z;
                const double other = channel(native::layered_eval(&to_l, l, v).value, c) / v.z;
                compared += one > 0.0 ? 1 : 0;
                ASSERT_NEAR(other, one, 1e-5 * one) << facets.alpha_x << ' ' << v.z << ' ' << l.z;
            }
        }
        EXPECT_GT(compared, 3'000) << facets.alpha_x;
    }
}

TEST(Layered, DiffuseAlbedosAreMeans) {
    // Of the body's part, over all outgoing directions.
    for (const double roughness : {0.2, 0.5, 1.0}) {
        LayeredMaterial material = white(roughness);
        material.base = f3(0.8F, 0.4F, 0.2F);
        material.metallic = 0.25F;
        material.transmission = 0.25F;
        material.coat = 0.5F;
        double sum = 0.0;
        constexpr int steps = 400;
        for (int i = 0; i < steps; ++i) {
            const double cosine = (i + 0.5) / steps;
            const LayeredBsdf bsdf = native::make_layered(&material, direction(cosine, 0.0));
            sum += 2.0 * cosine * double(bsdf.diffuse.x) / steps;
        }
        EXPECT_NEAR(native::layered_diffuse_albedo(&material).x, sum, 5e-3) << roughness;
    }
}

TEST(Layered, AllIsFiniteAtTheEnds) {
    native::Random random = native::make_random(7, 8, 9);
    for (int i = 0; i < 200'000; ++i) {
        float numbers[12];
        for (float& number : numbers) number = native::next_random(&random);
        const auto end = [&](int n) {
            return numbers[n] < 0.25F ? 0.0F : (numbers[n] < 0.5F ? 1.0F : numbers[n]);
        };
        LayeredMaterial material = everything(numbers[0] < 0.4F);
        material.base = f3(end(1), end(2), end(3));
        material.metallic = end(4);
        material.transmission = end(5);
        material.coat = end(6);
        material.f90 = end(7);
        const float roughest = end(8);
        material.facets = make_facets(roughest, end(9) * roughest, 0);
        material.coat_facets = make_facets(end(9), end(9), 0);
        material.ratio =
            ratio_of(numbers[10] < 0.3F ? 1.0 - 0x1p-10 : (numbers[10] < 0.6F ? 1.0 / 2.42 : 1.5));
        material.geometric_normal = f3(0, 0, 1);
        constexpr float heights[] = {1.0F, 0.3F, 1e-3F, 1e-7F, 1e-20F, 1e-38F, 0.0F, -0.1F};
        const float height = heights[i % 8];
        const float sine = std::sqrt((1.0F - height) * (1.0F + height));
        const float3 v = f3(0.6F * sine, 0.8F * sine, height);
        const LayeredBsdf bsdf = native::make_layered(&material, v);
        ASSERT_TRUE(native::is_finite3(bsdf.albedo) && native::is_finite3(bsdf.diffuse));
        const auto s = native::layered_sample(&bsdf, v, end(11), numbers[10], end(10) * largest);
        ASSERT_TRUE(native::is_finite3(s.in) && native::is_finite3(s.weight)) << height;
        ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf >= 0.0F) << height;
        ASSERT_GE(native::min_component(s.weight), 0.0F);
        const float3 l = native::cone_direction(numbers[1], numbers[2], -1.0F);
        const auto whole = native::layered_eval(&bsdf, v, l);
        ASSERT_TRUE(native::is_finite3(whole.value) && std::isfinite(whole.pdf)) << height;
        ASSERT_TRUE(native::min_component(whole.value) >= 0.0F && whole.pdf >= 0.0F) << height;
    }
}

}  // namespace
}  // namespace weft::layered_test
