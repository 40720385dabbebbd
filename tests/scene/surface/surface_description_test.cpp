// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface/surface_description.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "scene/material.h"

namespace weft::surface_description_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

TEST(SurfaceDescription, RoughnessScalesMeetAtTheirEnds) {
    using enum RoughnessScale;
    EXPECT_DOUBLE_EQ(alpha_of(0.5, roughness), 0.25);
    EXPECT_DOUBLE_EQ(alpha_of(0.75, glossiness), 0.0625);
    EXPECT_DOUBLE_EQ(alpha_of(0.1, alpha), 0.1);
    EXPECT_DOUBLE_EQ(alpha_of(0.0, exponent), 1.0);
    EXPECT_DOUBLE_EQ(alpha_of(6.0, exponent), 0.5);
    EXPECT_DOUBLE_EQ(alpha_of(0.0, roughness), 0.0);
    EXPECT_DOUBLE_EQ(alpha_of(1.0, glossiness), 0.0);
    // Beyond their ends they stay there.
    EXPECT_DOUBLE_EQ(alpha_of(2.0, roughness), 1.0);
    EXPECT_DOUBLE_EQ(alpha_of(-1.0, glossiness), 1.0);
    EXPECT_DOUBLE_EQ(alpha_of(-1.0, exponent), 1.0);
}

TEST(SurfaceDescription, AbsorptionIsThatOfTheAttenuation) {
    const glm::dvec3 absorbed = sigma_a({glm::vec3(1.0F, 0.5F, 0.0F), 2.0});
    EXPECT_DOUBLE_EQ(absorbed.r, 0.0);
    EXPECT_NEAR(absorbed.g, std::log(2.0) / 2.0, 1e-12);
    EXPECT_NEAR(absorbed.b, 24.0 * std::log(2.0) / 2.0, 1e-12) << "black is 2^-24";
    EXPECT_EQ(sigma_a({glm::vec3(0.5F), 0.0}), glm::dvec3(0.0)) << "no distance";
    EXPECT_EQ(sigma_a({glm::vec3(0.5F), 1e-320}), glm::dvec3(1e30));
    EXPECT_TRUE(std::isfinite(sigma_a({glm::vec3(0.0F), 1e300}).r));
}

TEST(SurfaceDescription, LambertIsASurfaceWithoutAnyOtherLobe) {
    SurfaceDescription surface;
    EXPECT_TRUE(is_lambertian(surface));
    surface.normal_map.map.texture = 0;
    EXPECT_FALSE(is_lambertian(surface));
    surface.normal_map = {};
    surface.opacity.mode = OpacityMode::mask;
    EXPECT_FALSE(is_lambertian(surface));
    surface.opacity = {};
    MetallicSurface metal;
    const auto lambertian = [&] {
        surface.model = metal;
        return is_lambertian(surface);
    };
    EXPECT_FALSE(lambertian());
    metal.metallic.factor = 0.0F;
    EXPECT_FALSE(lambertian()) << "a dielectric reflects";
    metal.specular.factor = 0.0F;
    EXPECT_TRUE(lambertian());
    metal.clearcoat.factor.factor = 0.5F;
    EXPECT_FALSE(lambertian());
    metal.clearcoat.factor.factor = 0.0F;
    metal.transmission.factor = 0.5F;
    EXPECT_FALSE(lambertian());
    surface.model = UnlitSurface{};
    EXPECT_FALSE(is_lambertian(surface));
}

TEST(SurfaceDescription, TransmitsWhereSomethingIsNotMetal) {
    MetallicSurface metal;
    metal.transmission.factor = 1.0F;
    EXPECT_FALSE(transmits({metal, {}, {}})) << "metal all over";
    metal.metallic.map.texture = 0;
    EXPECT_TRUE(transmits({metal, {}, {}}));
    metal.metallic = {0.5F};
    EXPECT_TRUE(transmits({metal, {}, {}}));
    EXPECT_TRUE(transmits({DielectricSurface{}, {}, {}}));
    EXPECT_FALSE(transmits({PlasticSurface{}, {}, {}}));
}

TEST(SurfaceDescription, ListsItsTextures) {
    MetallicSurface metal;
    metal.base_colour.map.texture = 1;
    metal.roughness.value.map.texture = 2;
    metal.clearcoat.normal_map.map.texture = 3;
    SurfaceDescription surface{metal, {}, {}};
    surface.normal_map.map.texture = 4;
    surface.opacity.alpha.map.texture = 5;
    std::vector<int> textures;
    for (const TextureMap* map : texture_maps(surface)) textures.push_back(map->texture);
    EXPECT_EQ(textures, (std::vector<int>{1, 2, 3, 4, 5}));
}

/// The problem of a surface of this model after a change.
template <class Model>
std::string problem_after(const std::function<void(Model&)>& change) {
    Model model;
    change(model);
    return surface_problem({model, {}, {}});
}

TEST(SurfaceDescription, KnowsWhatIsOutOfRange) {
    EXPECT_EQ(surface_problem({}), "");
    for (const float bad : {-0.1F, 1.1F, nan, infinite}) {
        using M = MetallicSurface;
        EXPECT_NE(problem_after<M>([&](M& m) { m.metallic.factor = bad; }), "") << bad;
        EXPECT_NE(problem_after<M>([&](M& m) { m.roughness.value.factor = bad; }), "") << bad;
        EXPECT_NE(problem_after<M>([&](M& m) { m.base_colour.factor.g = bad; }), "") << bad;
        EXPECT_NE(problem_after<M>([&](M& m) { m.specular.factor = bad; }), "") << bad;
        EXPECT_NE(problem_after<M>([&](M& m) { m.transmission.factor = bad; }), "") << bad;
        EXPECT_NE(problem_after<M>([&](M& m) { m.clearcoat.factor.factor = bad; }), "") << bad;
        EXPECT_NE(problem_after<M>([&](M& m) { m.clearcoat.roughness.value.factor = bad; }), "");
        EXPECT_NE(problem_after<M>([&](M& m) { m.anisotropy.strength = bad; }), "") << bad;
        EXPECT_NE(problem_after<M>([&](M& m) { m.absorption.colour.b = bad; }), "") << bad;
        EXPECT_NE(problem_after<SpecularSurface>([&](auto& m) { m.specular.factor.r = bad; }), "");
        EXPECT_NE(problem_after<LambertSurface>([&](auto& m) { m.colour.factor.r = bad; }), "");
        EXPECT_NE(problem_after<PlasticSurface>([&](auto& m) { m.diffuse.factor.r = bad; }), "");
    }
    for (const float bad : {-1.0F, nan, infinite}) {
        EXPECT_NE(problem_after<ConductorSurface>([&](auto& m) { m.eta.r = bad; }), "") << bad;
        EXPECT_NE(problem_after<ConductorSurface>([&](auto& m) { m.k.b = bad; }), "") << bad;
        EXPECT_NE(
            problem_after<ConductorSurface>([&](auto& m) { m.roughness_v.value.factor = bad; }),
            "");
        EXPECT_NE(problem_after<DielectricSurface>([&](auto& m) { m.ior_inside = bad; }), "");
        EXPECT_NE(problem_after<PlasticSurface>([&](auto& m) { m.ior_outside = bad; }), "");
        SurfaceDescription cut;
        cut.opacity.cutoff = bad;
        EXPECT_NE(surface_problem(cut), "") << bad;
    }
    for (const float ior : {0.5F, -1.0F, 1e9F, nan})
        EXPECT_NE(problem_after<MetallicSurface>([&](auto& m) { m.ior = ior; }), "") << ior;
    for (const float ior : {0.0F, 1.0F, 2.4F, 100.0F})
        EXPECT_EQ(problem_after<MetallicSurface>([&](auto& m) { m.ior = ior; }), "") << ior;
    // Slopes of microfacets have no upper end.
    EXPECT_EQ(problem_after<ConductorSurface>([](auto& m) { m.roughness_u.value.factor = 3.0F; }),
              "");
    SurfaceDescription bumpy;
    bumpy.normal_map.scale = nan;
    EXPECT_NE(surface_problem(bumpy), "");
}

TEST(SurfaceDescription, EditsOfTheAlbedoReachIt) {
    Material material;
    MetallicSurface metal;
    metal.base_colour.map.texture = 2;
    material.description = SurfaceDescription{metal, {}, {}};
    set_diffuse_albedo(material, {0.1F, 0.2F, 0.3F});
    set_albedo_texture(material, -1);
    const auto& edited = std::get<MetallicSurface>(material.description->model);
    EXPECT_EQ(edited.base_colour.factor, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_FALSE(edited.base_colour.map.present());
    // Metal by its index has no such colour.
    material.description->model = ConductorSurface{};
    set_diffuse_albedo(material, glm::vec3(0.5F));
    EXPECT_EQ(diffuse_albedo(material), glm::vec3(0.5F));
}

}  // namespace
}  // namespace weft::surface_description_test
