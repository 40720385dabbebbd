// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scene/flat_scene.h"
#include "tests/testing/floor_scenes.h"

namespace weft::light_table_test {
namespace {

using test::quad_mesh;
using test::SceneBuilder;

constexpr double pi = std::numbers::pi;

Mesh square(double edge, const glm::vec3& corner = glm::vec3(0.0F)) {
    const auto e = static_cast<float>(edge);
    return quad_mesh(corner, {e, 0.0F, 0.0F}, {0.0F, e, 0.0F});
}

/// A scene whose kernel units are scene units: a square of edge 2 about the origin.
SceneBuilder unit_scene() {
    SceneBuilder builder;
    builder.add(square(2.0, {-1.0F, -1.0F, 0.0F}), builder.material(glm::vec3(0.5F)));
    return builder;
}

/// Probabilities are above 0, are the differences of the sums, and end at 1 exactly.
template <class Entry>
void expect_distribution(const std::vector<Entry>& entries, std::size_t begin, std::size_t end) {
    ASSERT_LT(begin, end);
    ASSERT_LE(end, entries.size());
    float before = 0.0F;
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        EXPECT_GT(entries[i].probability, 0.0F) << i;
        EXPECT_EQ(entries[i].probability, entries[i].cumulative - before) << i;
        before = entries[i].cumulative;
        sum += static_cast<double>(entries[i].probability);
    }
    EXPECT_EQ(before, 1.0F);
    EXPECT_NEAR(sum, 1.0, 1e-12 * static_cast<double>(entries.size()) + 1e-7);
}

TEST(LightTable, PowersOfEveryKind) {
    SceneBuilder builder = unit_scene();
    builder.add(square(1.0), builder.material(glm::vec3(0.0F), glm::vec3(3.0F)));
    builder.light(LightType::point, {0.0, 0.0, 0.5}, glm::vec3(2.0F));
    PunctualLight& spot = builder.light(LightType::spot, {0.0, 0.0, 0.5}, glm::vec3(2.0F));
    spot.cos_outer = 0.5F;
    spot.cos_inner = 0.75F;
    builder.light(LightType::directional, glm::dvec3(0.0), glm::vec3(1.0F));
    builder.scene.environment = Environment{glm::vec3(0.5F)};
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.units.scale, 1.0);
    ASSERT_EQ(flat.lights.size(), 5u);
    const double disc = pi * static_cast<double>(flat.radius) * static_cast<double>(flat.radius);
    const double powers[] = {3.0 * pi, 2.0 * 4.0 * pi, 2.0 * pi, disc, 0.5 * 4.0 * pi * disc};
    const double total = powers[0] + powers[1] + powers[2] + powers[3] + powers[4];
    const std::uint32_t kinds[] = {EMITTER_AREA, EMITTER_POINT, EMITTER_SPOT, EMITTER_DIRECTIONAL,
                                   EMITTER_ENVIRONMENT};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(flat.lights[i].kind, kinds[i]);
        EXPECT_NEAR(flat.lights[i].probability, powers[i] / total, 1e-6) << i;
    }
    expect_distribution(flat.lights, 0, 5);
    EXPECT_EQ(flat.area_lights, 1u);
    EXPECT_EQ(flat.punctual_lights, 2u);
    EXPECT_EQ(flat.directional_lights, 1u);
    EXPECT_NEAR(flat.lights[0].area, 1.0, 1e-6);
    EXPECT_EQ(flat.lights[2].cos_outer, 0.5F);
    EXPECT_EQ(flat.features & ~std::uint32_t{FEATURE_ONE_SIDED},
              FEATURE_AREA_LIGHTS | FEATURE_PUNCTUAL_LIGHTS | FEATURE_DIRECTIONAL_LIGHTS |
                  FEATURE_ENVIRONMENT | FEATURE_LIGHT_TREE);
}

TEST(LightTable, IntensitiesAreInKernelUnits) {
    // The same light in a scene 8 times as large: kernel units are 1/8 of scene units, and
    // irradiance I / d^2 must not change.
    SceneBuilder builder;
    builder.add(square(16.0, {-8.0F, -8.0F, 0.0F}), builder.material(glm::vec3(0.5F)));
    builder.light(LightType::point, {0.0, 0.0, 4.0}, glm::vec3(64.0F));
    builder.light(LightType::directional, {}, glm::vec3(5.0F), {0.0, -3.0, 0.0});
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.units.scale, 0.125);
    ASSERT_EQ(flat.lights.size(), 2u);
    EXPECT_EQ(flat.lights[0].power.x, 1.0F);
    EXPECT_EQ(flat.lights[0].position.z, 0.5F);
    EXPECT_EQ(flat.lights[1].power.x, 5.0F);
    EXPECT_EQ(flat.lights[1].axis.y, -1.0F);
}

TEST(LightTable, BothSidesShineTwiceAsMuch) {
    SceneBuilder builder = unit_scene();
    const std::uint32_t single = builder.material(glm::vec3(0.0F), glm::vec3(1.0F));
    const std::uint32_t both = builder.material(glm::vec3(0.0F), glm::vec3(1.0F));
    builder.scene.materials[both].emission.both_sides = true;
    builder.add(square(0.5), single);
    builder.add(square(0.5), both);
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.lights.size(), 2u);
    EXPECT_EQ(flat.lights[0].both_sides, 0u);
    EXPECT_EQ(flat.lights[1].both_sides, 1u);
    EXPECT_NEAR(flat.lights[1].probability, 2.0 / 3.0, 1e-6);
}

TEST(LightTable, EmittersWithoutAreaOrPowerAreLeftOut) {
    SceneBuilder builder = unit_scene();
    const std::uint32_t bright = builder.material(glm::vec3(0.0F), glm::vec3(1.0F));
    builder.add(square(0.0), bright);
    builder.add(square(0.5), builder.material(glm::vec3(0.0F), glm::vec3(0.0F)));
    builder.light(LightType::point, {}, glm::vec3(0.0F));
    builder.light(LightType::directional, {}, glm::vec3(0.0F));
    builder.scene.environment = Environment{};
    const FlatScene dark = flatten(builder.scene);
    EXPECT_TRUE(dark.lights.empty());
    EXPECT_TRUE(dark.emissive.empty());
    EXPECT_EQ(dark.area_lights + dark.punctual_lights + dark.directional_lights, 0u);
    EXPECT_EQ(dark.features, 0u);

    // One flat triangle in a light that has area otherwise.
    Mesh mixed = square(1.0);
    mixed.triangles.push_back({0, 1, 1});
    builder.add(mixed, bright);
    const FlatScene lit = flatten(builder.scene);
    ASSERT_EQ(lit.lights.size(), 1u);
    EXPECT_EQ(lit.lights[0].count, 2u);
    EXPECT_EQ(lit.emissive.size(), 2u);
    expect_distribution(lit.emissive, 0, 2);
}

TEST(LightTable, EmissiveTrianglesGoByArea) {
    SceneBuilder builder = unit_scene();
    const std::uint32_t bright = builder.material(glm::vec3(0.0F), glm::vec3(1.0F));
    Mesh uneven;
    uneven.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5F, 0, 0}, {0, 0, 0.5F}};
    uneven.triangles = {{0, 1, 2}, {0, 3, 4}};  // areas 1/2 and 1/8
    builder.add(uneven, bright);
    builder.add(square(1.0), bright);
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.lights.size(), 2u);
    EXPECT_EQ(flat.lights[1].first, 2u);
    EXPECT_NEAR(flat.emissive[0].probability, 0.8, 1e-6);
    EXPECT_NEAR(flat.emissive[1].probability, 0.2, 1e-6);
    expect_distribution(flat.emissive, 0, 2);
    expect_distribution(flat.emissive, 2, 4);
    for (const shared::EmissiveTriangle& entry : flat.emissive)
        EXPECT_GT(triangle_area(flat, flat.triangles.at(entry.triangle)), 0.0);
}

TEST(LightTable, TexturedTrianglesGoByAreaTimesRadiance) {
    SceneBuilder builder = unit_scene();
    builder.scene.textures.push_back(test::black_beside(255, 255, 255));
    const std::uint32_t emitter = builder.material(glm::vec3(0.5F), glm::vec3(2.0F, 4.0F, 8.0F));
    builder.scene.materials[emitter].emission.texture = 0;
    // The first eighth of the columns is dark, the last one bright.
    builder.add(quad_mesh({-1, -1, 0.5F}, {2, 0, 0}, {0, 2, 0}, 8), emitter);
    const FlatScene flat = flatten(builder.scene);
    EXPECT_TRUE((flat.features & FEATURE_EMISSION_TEXTURES) != 0);
    ASSERT_EQ(flat.lights.size(), 1u);
    const shared::LightRecord& light = flat.lights[0];
    EXPECT_EQ(light.textured, 1u);
    EXPECT_EQ(light.count, 128u) << "entries follow the triangles";
    EXPECT_EQ(light.axis.z, 0.0F) << "no closed form";
    // Half of the area shines, a little more by the means, which are smoothed.
    EXPECT_GT(light.area, 2.0);
    EXPECT_LT(light.area, 2.5);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < light.count; ++i) {
        const shared::EmissiveTriangle& entry = flat.emissive[light.first + i];
        EXPECT_EQ(entry.triangle, flat.instances[1].first_triangle + i);
        const std::uint32_t column = i / 2 % 8;
        if (column == 0) {
            EXPECT_EQ(entry.probability, 0.0F);
        } else if (column == 7) {
            EXPECT_NEAR(entry.probability, 1.0 / 64.0, 1e-3);
        }
        EXPECT_NEAR(entry.density, static_cast<double>(entry.probability) / (4.0 / 128.0), 1e-6);
        sum += static_cast<double>(entry.probability);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(LightTable, TexturesThatAreBlackAreNoLights) {
    SceneBuilder builder = unit_scene();
    builder.scene.textures.push_back(test::black_beside(255, 255, 255));
    builder.scene.textures[0].rgba.assign(8, 0);
    const std::uint32_t emitter = builder.material(glm::vec3(0.5F), glm::vec3(1.0F));
    builder.scene.materials[emitter].emission.texture = 0;
    builder.add(square(1.0), emitter);
    EXPECT_TRUE(flatten(builder.scene).lights.empty());
}

TEST(LightTable, EmissionHasCoordinatesOfItsOwn) {
    SceneBuilder builder = unit_scene();
    builder.scene.textures.push_back(test::black_beside(255, 255, 255));
    const std::uint32_t emitter = builder.material(glm::vec3(0.5F), glm::vec3(1.0F));
    builder.scene.materials[emitter].emission.texture = 0;
    Mesh dark = square(1.0);
    dark.emission_uvs.assign(dark.uvs.size(), glm::vec2(0.0F));
    Mesh bright = square(1.0);
    bright.emission_uvs.assign(bright.uvs.size(), glm::vec2(1.0F));
    builder.add(std::move(dark), emitter);
    builder.add(std::move(bright), emitter);
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.lights.size(), 1u);
    EXPECT_EQ(flat.instances[1].light, INVALID_INDEX);
    EXPECT_EQ(flat.instances[2].light, 0u);
    const std::uint32_t vertex = flat.ranges[2].first_vertex + flat.instances[2].emission_uv;
    ASSERT_LT(2 * std::size_t{vertex} + 7, flat.texture_coordinates.size());
    for (std::size_t k = 0; k < 8; ++k)
        EXPECT_EQ(flat.texture_coordinates[2 * std::size_t{vertex} + k], 1.0F);
    EXPECT_EQ(flat.instances[0].emission_uv, 0u);
}

TEST(LightTable, ManyLightsKeepTheirShares) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> power(0.5F, 2.0F);
    SceneBuilder builder = unit_scene();
    double total = 0.0;
    std::vector<double> powers;
    for (int i = 0; i < 20000; ++i) {
        powers.push_back(static_cast<double>(power(random)));
        total += powers.back();
        builder.light(LightType::point, {0.0, 0.0, 1.0},
                      glm::vec3(static_cast<float>(powers.back())));
    }
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.lights.size(), powers.size());
    expect_distribution(flat.lights, 0, flat.lights.size());
    for (std::size_t i = 0; i < powers.size(); ++i)
        // The sums are floats near 1: a difference is off by a step of 2^-24 at most.
        EXPECT_NEAR(flat.lights[i].probability, powers[i] / total, 0x1.1p-24) << i;
}

TEST(LightTable, AreaLightsHaveATableOfTheirOwn) {
    // Together the area lights have 2^-30 of the power, too little for the table of all lights.
    SceneBuilder builder = unit_scene();
    for (int i = 1; i <= 65; ++i)
        builder.add(square(0.01), builder.material(glm::vec3(0.0F), glm::vec3(float(i))));
    builder.light(LightType::directional, {}, glm::vec3(1e9F));
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.area_lights, 65u);
    double sum = 0.0;
    float before = 0.0F;
    for (std::size_t i = 0; i < 65; ++i) {
        const shared::LightRecord& light = flat.lights[i];
        EXPECT_EQ(light.area_probability, light.area_cumulative - before);
        EXPECT_NEAR(light.area_probability, double(i + 1) / (65.0 * 66.0 / 2.0), 0x1.1p-24);
        before = light.area_cumulative;
        sum += static_cast<double>(light.area_probability);
    }
    EXPECT_EQ(before, 1.0F);
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_EQ(flat.lights[65].area_probability, 0.0F);
}

TEST(LightTable, OneLightIsCertain) {
    SceneBuilder builder = unit_scene();
    builder.light(LightType::spot, {}, glm::vec3(1e-20F)).cos_outer = 0.99F;
    const FlatScene flat = flatten(builder.scene);
    ASSERT_EQ(flat.lights.size(), 1u);
    EXPECT_EQ(flat.lights[0].probability, 1.0F);
    EXPECT_EQ(flat.lights[0].cumulative, 1.0F);
}

}  // namespace
}  // namespace weft::light_table_test
