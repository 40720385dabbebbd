// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mean_albedo.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/testing/surface_scenes.h"

namespace weft::mean_albedo_test {
namespace {

Material described(const SurfaceDescription& description) {
    Material material;
    material.surface = DiffuseSurface{glm::vec3(0.5F)};
    material.description = description;
    return material;
}

glm::vec3 albedo_of(const SurfaceDescription& description) {
    return mean_albedo(described(description), {});
}

TextureStatistics measured(const std::vector<std::uint8_t>& two_texels) {
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.srgb = false;
    texture.rgba = two_texels;
    return measure_texture(texture);
}

TEST(MeanAlbedo, IsThatOfTheSurfaceWithoutADescription) {
    Material material;
    material.surface = DiffuseSurface{glm::vec3(0.1F, 0.2F, 0.3F)};
    EXPECT_EQ(mean_albedo(material, {}), glm::vec3(0.1F, 0.2F, 0.3F));
}

TEST(MeanAlbedo, OfWhiteIsWhite) {
    EXPECT_FLOAT_EQ(albedo_of(test::metal(0.5F)).g, 1.0F);
    EXPECT_FLOAT_EQ(albedo_of(test::grey_mirror(0.25F)).g, 0.25F);
    MetallicSurface plastic;
    plastic.metallic.factor = 0.0F;
    EXPECT_NEAR(albedo_of({plastic, {}, {}}).g, 1.0F, 1e-6F) << "body and coat share all light";
    plastic.base_colour.factor = glm::vec3(0.0F);
    // 2 int F mu dmu of Schlick's F at f0 = 0.04: 0.04 + 0.96 / 21.
    EXPECT_NEAR(albedo_of({plastic, {}, {}}).g, 0.04F + 0.96F / 21.0F, 1e-6F);
}

TEST(MeanAlbedo, OfClearGlassIsWhatItReflects) {
    EXPECT_NEAR(albedo_of(test::glass(1.5)).g, 0.04F + 0.96F / 21.0F, 1e-6F);
    EXPECT_EQ(mean_transmittance(described(test::glass(1.5)), {}), 1.0F);
    EXPECT_EQ(mean_transmittance(described(test::metal(0.0F)), {}), 0.0F);
    EXPECT_FLOAT_EQ(mean_transmittance(described(test::sheet(0.3F)), {}), 0.7F);
}

TEST(MeanAlbedo, IsAFactorOfTheTexture) {
    // Half of the texels are black: the mean with the texture is that of the colour times 1/2.
    MetallicSurface surface;
    surface.metallic.factor = 0.0F;
    surface.specular.factor = 0.0F;
    surface.base_colour.factor = glm::vec3(0.6F);
    surface.transmission.factor = 0.5F;
    surface.base_colour.map.texture = 0;
    Material material = described({surface, {}, {}});
    set_albedo_texture(material, 0);
    const std::vector<TextureStatistics> textures{measured({255, 255, 255, 255, 0, 0, 0, 255})};
    EXPECT_NEAR(mean_albedo(material, textures).g, 0.3F, 1e-6F);
    // Half of it is glass, which is black for half of the texels.
    EXPECT_NEAR(mean_transmittance(material, textures), 0.5F * 0.3F, 1e-6F);
}

TEST(MeanAlbedo, GapsAreThoseOfTheAlphaOfATexture) {
    SurfaceDescription sheet = test::sheet(1.0F);
    sheet.opacity.alpha.map.texture = 0;
    sheet.opacity.alpha.map.channel = Channel::alpha;
    const std::vector<TextureStatistics> textures{measured({255, 255, 255, 0, 255, 0, 0, 102})};
    EXPECT_NEAR(mean_transmittance(described(sheet), textures), 0.8F, 1e-6F);
}

}  // namespace
}  // namespace weft::mean_albedo_test
