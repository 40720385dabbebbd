// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#define NATIVE_KERNELS "kernels/bsdf/glossy_value.h"
#include "tests/bsdf/seen_materials.h"
#include "tests/testing/native_kernels.h"

// What previews make of materials (kernels/bsdf/seen_lobes.h): no light is lost or gained between
// the diffuse part and the two directions, whatever the roughness, and small changes of roughness
// make small changes of each.
namespace weft::seen_lobes_test {
namespace {

using namespace seen_materials;

float light_of(const SeenLobes& lobes) {
    float sum = lobes.diffuse.y;
    for (const native::SeenWay& way : lobes.ways) sum += way.share.y;
    return sum;
}

TEST(SeenLobes, ShareTheLightOfTheMaterial) {
    for (const float alpha : {0.0F, 0.0004F, 0.01F, 0.1F, 0.24F, 0.26F, 0.6F, 1.0F})
        for (const float cosine : {0.1F, 0.4F, 0.8F, 1.0F})
            for (const auto& make : {metal, coated, pane}) {
                const LayeredMaterial material = make(alpha);
                const float3 v = direction(cosine);
                const LayeredBsdf bsdf = native::make_layered(&material, v);
                const float albedo = native::layered_albedo(&bsdf, v).y;
                for (const native::FacetChoice& seen : {middle, mirrored}) {
                    EXPECT_NEAR(light_of(lobes_of(material, cosine, seen)), albedo, 1e-4F * albedo)
                        << "alpha " << alpha << ", cosine " << cosine;
                    EXPECT_LE(light_of(lobes_of(material, cosine, seen)), 1.001F);
                }
            }
    for (const float cosine : {0.3F, 1.0F})
        EXPECT_NEAR(light_of(lobes_of(glass(0.0F), cosine)), 1.0F, 1e-5F) << cosine;
}

TEST(SeenLobes, MirrorsAndGlassHaveNoDiffusePart) {
    for (const float alpha : {0.0F, 0.1F}) {
        EXPECT_EQ(lobes_of(metal(alpha), 0.7F).diffuse.y, 0.0F) << alpha;
        EXPECT_EQ(lobes_of(pane(alpha), 0.7F).diffuse.y, 0.0F) << alpha;
        EXPECT_EQ(lobes_of(glass(alpha), 0.7F).diffuse.y, 0.0F) << alpha;
    }
    EXPECT_EQ(lobes_of(metal(0.0F), 0.7F).ways[WAY_GLOSSY].share.y, 0.0F);
    EXPECT_EQ(lobes_of(metal(0.1F), 0.7F).ways[WAY_REFLECTION].share.y, 0.0F);
    EXPECT_GT(lobes_of(metal(0.1F), 0.7F).ways[WAY_GLOSSY].share.y, 0.7F);
    for (const float alpha : {0.3F, 1.0F}) {
        EXPECT_EQ(lobes_of(metal(alpha), 0.7F).diffuse.y, 0.0F);
        EXPECT_EQ(lobes_of(metal(alpha), 0.7F, mirrored).ways[WAY_GLOSSY].share.y, 0.0F);
        EXPECT_GT(lobes_of(metal(alpha), 0.7F, mirrored).diffuse.y, 0.6F);
    }
}

TEST(SeenLobes, FaintFacetsAreDiffuseWhereTheyAreRough) {
    EXPECT_GT(lobes_of(dielectric(0.4F, 0.5F), 0.7F).ways[WAY_GLOSSY].share.y, 0.03F);
    EXPECT_EQ(lobes_of(dielectric(0.6F, 0.5F), 0.7F).ways[WAY_GLOSSY].share.y, 0.0F);
    LayeredMaterial bright = dielectric(0.6F, 0.5F);
    bright.f0 = f3(0.1F, 0.1F, 0.1F);
    EXPECT_GT(lobes_of(bright, 0.7F).ways[WAY_GLOSSY].share.y, 0.06F);
}

TEST(SeenLobes, SmoothDirectionsAreThoseOfOptics) {
    const float3 v = direction(0.6F);
    const native::SeenWay mirror = lobes_of(metal(0.0F), 0.6F).ways[WAY_REFLECTION];
    EXPECT_NEAR(mirror.direction.x, -v.x, 1e-6F);
    EXPECT_NEAR(mirror.direction.z, v.z, 1e-6F);
    EXPECT_EQ(mirror.alpha, 0.0F);
    const SeenLobes clear = lobes_of(glass(0.0F), 0.6F);
    EXPECT_NEAR(clear.ways[WAY_REFRACTION].direction.x, -v.x / 1.5F, 1e-6F) << "Snell's law";
    EXPECT_EQ(clear.refracts, 1);
    const SeenLobes sheet = lobes_of(pane(0.0F), 0.6F);
    EXPECT_NEAR(sheet.ways[WAY_REFRACTION].direction.x, -v.x, 1e-6F);
    EXPECT_NEAR(sheet.ways[WAY_REFRACTION].direction.z, -v.z, 1e-6F);
    EXPECT_EQ(sheet.refracts, 0);
}

// A smooth coat is a mirror beside the gloss of what it covers. Of a glossy coat on a glossy body
// `part` chooses between both, as often as is their share of light.
TEST(SeenLobes, PartsAreChosenByTheirLight) {
    const float3 v = direction(0.8F);
    LayeredMaterial material = metal(0.1F);
    material.coat = 1.0F;
    material.coat_normal = native::normalize3(f3(0.2F, 0.0F, 1.0F));
    const float coat = 1.0F - native::make_layered(&material, v).under_coat;
    const SeenLobes apart = lobes_of(material, 0.8F);
    EXPECT_NEAR(apart.ways[WAY_REFLECTION].share.y, coat, 1e-6F);
    EXPECT_GT(apart.ways[WAY_GLOSSY].share.y, 0.5F);
    material.coat_facets = make_facets(0.1F, 0.1F, 0);
    const native::SeenWay body =
        lobes_of(material, 0.8F, {0.0F, 0.5F, 0.5F, ANY_ALPHA}).ways[WAY_GLOSSY];
    int coats = 0;
    constexpr int count = 1000;
    for (int i = 0; i < count; ++i) {
        const float part = (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        const native::SeenWay way =
            lobes_of(material, 0.8F, {part, 0.5F, 0.5F, ANY_ALPHA}).ways[WAY_GLOSSY];
        if (way.direction.x != body.direction.x) ++coats;
        EXPECT_EQ(way.share.y, body.share.y);
    }
    EXPECT_NEAR(static_cast<float>(coats) / static_cast<float>(count), coat / body.share.y, 0.002F);
}

// Of facets that are chosen one after the other the mean direction is that of the lobe, and rough
// ones spread.
TEST(SeenLobes, FacetsSpreadByTheirRoughness) {
    const auto spread = [](float alpha) {
        double square = 0.0;
        constexpr int edge = 16;
        for (int i = 0; i < edge; ++i)
            for (int j = 0; j < edge; ++j) {
                const SeenLobes lobes =
                    lobes_of(metal(alpha), 1.0F,
                             {0.5F, (static_cast<float>(i) + 0.5F) / edge,
                              (static_cast<float>(j) + 0.5F) / edge, ANY_ALPHA});
                EXPECT_GT(lobes.ways[WAY_GLOSSY].direction.z, 0.0F);
                square += 1.0 - static_cast<double>(lobes.ways[WAY_GLOSSY].direction.z);
            }
        return square / (edge * edge);
    };
    EXPECT_GT(spread(0.05F), 0.0);
    EXPECT_GT(spread(0.2F), 4.0 * spread(0.05F));
}

}  // namespace
}  // namespace weft::seen_lobes_test
