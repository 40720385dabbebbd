// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#define NATIVE_KERNELS "kernels/bsdf/glossy_value.h"
#include "tests/bsdf/seen_materials.h"
#include "tests/testing/native_kernels.h"

// What glossy facets reflect from a direction (kernels/bsdf/glossy_value.h), against sums over the
// hemisphere.
namespace weft::glossy_value_test {
namespace {

using namespace seen_materials;

/// The scattering of a material whose frame is the world's, seen along `v`.
native::SurfaceScattering scattering_of(const LayeredMaterial& material, float3 v) {
    native::SurfaceScattering scattering{};
    scattering.model = SURFACE_LAYERED;
    scattering.coverage = 1.0F;
    scattering.frame = {f3(1, 0, 0), f3(0, 1, 0), f3(0, 0, 1)};
    scattering.v = v;
    scattering.smooth = scattering.outward = f3(0, 0, 1);
    scattering.layered = native::make_layered(&material, v);
    return scattering;
}

// The pdf is that of the direction of a facet: over all of them, the mean of value over pdf is what
// the value adds up to over the hemisphere, by midpoints, and that is the way's share of light but
// for what tables err. The pdf adds up to what facets reflect upwards.
TEST(GlossyValue, AddsUpToTheShareOfTheWay) {
    const auto anisotropic = [](float alpha) {
        LayeredMaterial material = metal(alpha);
        material.facets = make_facets(alpha, 3.0F * alpha, 0);
        return material;
    };
    const auto varnished = [](float alpha) {
        LayeredMaterial material = metal(alpha);
        material.coat = 1.0F;
        material.coat_facets = make_facets(0.5F * alpha, 0.5F * alpha, 0);
        return material;
    };
    for (const float alpha : {0.15F, 0.3F})
        for (const float cosine : {0.3F, 0.9F})
            for (const LayeredMaterial& material :
                 {metal(alpha), dielectric(alpha, 0.5F), anisotropic(alpha), varnished(alpha)}) {
                const float3 v = direction(cosine);
                const native::SurfaceScattering scattering = scattering_of(material, v);
                const SeenLobes lobes = lobes_of(material, cosine);
                constexpr int rows = 400;
                double value = 0.0;
                double pdf = 0.0;
                for (int i = 0; i < rows; ++i)
                    for (int j = 0; j < 4 * rows; ++j) {
                        const double z = (i + 0.5) / rows;
                        const double phi = 2.0 * M_PI * (j + 0.5) / (4 * rows);
                        const double r = std::sqrt(1.0 - z * z);
                        const float3 in =
                            f3(static_cast<float>(r * std::cos(phi)),
                               static_cast<float>(r * std::sin(phi)), static_cast<float>(z));
                        const native::LayeredValue at =
                            native::glossy_value(&scattering, &lobes, in, 0.0F);
                        value += static_cast<double>(at.value.y);
                        pdf += static_cast<double>(at.pdf);
                    }
                const double solid_angle = 2.0 * M_PI / (rows * 4.0 * rows);
                value *= solid_angle;
                pdf *= solid_angle;
                double chosen = 0.0;
                int missed = 0;
                constexpr int edge = 64;
                for (int part = 0; part < 16; ++part)
                    for (int i = 0; i < edge; ++i)
                        for (int j = 0; j < edge; ++j) {
                            const SeenLobes seen =
                                lobes_of(material, cosine,
                                         {(static_cast<float>(part) + 0.5F) / 16.0F,
                                          (static_cast<float>(i) + 0.5F) / edge,
                                          (static_cast<float>(j) + 0.5F) / edge, ANY_ALPHA});
                            const native::LayeredValue at = native::glossy_value(
                                &scattering, &seen, seen.ways[WAY_GLOSSY].direction, 0.0F);
                            if (seen.ways[WAY_GLOSSY].missed != 0) {
                                ++missed;
                                continue;
                            }
                            ASSERT_GT(at.pdf, 0.0F);
                            chosen +=
                                static_cast<double>(at.value.y / at.pdf) / (16.0 * edge * edge);
                        }
                SCOPED_TRACE("alpha " + std::to_string(alpha) + ", cosine " +
                             std::to_string(cosine));
                EXPECT_NEAR(pdf, 1.0 - missed / (16.0 * edge * edge), 0.01);
                // Shares of a coat are chosen at 16 places.
                EXPECT_NEAR(chosen, value, 0.02 * value);
                // Tables of albedos are of facets that are the same along both axes.
                if (material.facets.alpha_x == material.facets.alpha_y) {
                    EXPECT_NEAR(value, lobes.ways[WAY_GLOSSY].share.y, 0.02 * value);
                }
            }
}

TEST(GlossyValue, ATurnedNormalWidensTheLobe) {
    const LayeredMaterial material = metal(0.01F);
    const float3 v = direction(1.0F);
    const native::SurfaceScattering scattering = scattering_of(material, v);
    const SeenLobes lobes = lobes_of(material, 1.0F);
    const auto value = [&](float turn) {
        return native::glossy_value(&scattering, &lobes, v, turn).value.y;
    };
    // At its middle the lobe is as high as 1 over the square of alpha.
    EXPECT_NEAR(value(0.01F), 0.5F * value(0.0F), 0.01F * value(0.0F));
    EXPECT_NEAR(value(0.1F), value(0.0F) / 101.0F, 0.0002F * value(0.0F));
}

}  // namespace
}  // namespace weft::glossy_value_test
