// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_surfaces.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "scene/flat_scene.h"
#include "tests/testing/path_fixture.h"
#include "tests/testing/surface_scenes.h"

namespace weft::flat_surfaces_test {
namespace {

using test::TestBackend;

/// A room of walls that are metal, glass and plastic.
Scene surfaces() {
    test::SceneBuilder builder;
    PlasticSurface plastic;
    plastic.roughness.value.factor = 0.3F;
    const std::uint32_t metal = test::add_surface(builder, test::metal(0.5F));
    const std::uint32_t glass =
        test::add_surface(builder, test::absorbing_glass(1.5F, glm::vec3(0.5F), 1.0, 0.4F));
    const std::uint32_t coated = test::add_surface(builder, {plastic, {}, {}});
    builder.add(test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), metal);
    builder.add(test::quad_mesh({-1, -1, -0.5F}, {1, 0, 0}, {0, 1, 0}), glass);
    builder.add(test::quad_mesh({0, 0, -0.5F}, {1, 0, 0}, {0, 1, 0}), coated);
    builder.scene.environment = Environment{glm::vec3(0.7F)};
    return builder.scene;
}

void edit(Scene& scene, double roughness, const glm::vec3& albedo) {
    for (Material& material : scene.materials) {
        fade_roughness(material, roughness);
        set_diffuse_albedo(material, albedo);
    }
}

bool same_bytes(const FlatSurfaces& a, const FlatSurfaces& b) {
    return a.records.size() == b.records.size() && a.values == b.values &&
           std::memcmp(a.records.data(), b.records.data(),
                       a.records.size() * sizeof(shared::SurfaceRecord)) == 0 &&
           a.maps.size() == b.maps.size() &&
           std::memcmp(a.maps.data(), b.maps.data(), a.maps.size() * sizeof(shared::SurfaceMap)) ==
               0;
}

TEST(FlatSurfaces, FollowEditsAsIfFlattenedAnew) {
    for (const double roughness : {0.0, 0.001, 0.2, 0.5, 1.0}) {
        Scene scene = surfaces();
        FlatScene flat = flatten(scene);
        edit(scene, roughness, {0.2F, 0.4F, 0.6F});
        update_flat(scene, flat);
        const FlatScene anew = flatten(scene);
        EXPECT_TRUE(same_bytes(flat.surfaces, anew.surfaces)) << roughness;
        EXPECT_EQ(flat.features, anew.features) << roughness;
        // And back again.
        scene = surfaces();
        update_flat(scene, flat);
        EXPECT_TRUE(same_bytes(flat.surfaces, flatten(surfaces()).surfaces)) << roughness;
    }
}

TEST(FlatSurfaces, WhatNoInstanceShowsCostsNothing) {
    Scene scene = surfaces();
    const auto shown_by = [&](std::uint32_t material) {
        for (Instance& instance : scene.instances) instance.material = material;
        return flatten(scene).surfaces;
    };
    const std::uint32_t metal = scene.instances[0].material;
    const std::uint32_t glass = scene.instances[1].material;
    const FlatSurfaces with_glass = shown_by(glass);
    EXPECT_TRUE(with_glass.rough_glass);
    EXPECT_EQ(with_glass.values.size(), 2 * glass_table_size);
    EXPECT_NE(with_glass.records[glass].table, INVALID_INDEX);
    const FlatSurfaces without = shown_by(metal);
    EXPECT_TRUE(without.glossy);
    EXPECT_FALSE(without.rough_glass);
    EXPECT_FALSE(without.lets_through);
    EXPECT_TRUE(without.values.empty());
    EXPECT_EQ(without.records.size(), scene.materials.size());
}

TEST(FlatSurfaces, FollowRoughnessThatBecomesTheSameInBothDirections) {
    const auto brushed = [] {
        // Both directions have one texture, which is named once where their factors agree.
        ConductorSurface metal;
        metal.roughness_u.value = {0.2F, {.texture = 0}};
        metal.roughness_v.value = {0.4F, {.texture = 0}};
        Scene scene = surfaces();
        scene.textures.resize(1);
        scene.textures[0].width = scene.textures[0].height = 1;
        scene.textures[0].rgba = {128, 128, 128, 255};
        scene.materials[0].description = SurfaceDescription{metal, {}, {}};
        auto& coated = std::get<PlasticSurface>(scene.materials[2].description->model);
        coated.specular.map.texture = 0;
        return scene;
    };
    Scene scene = brushed();
    FlatScene flat = flatten(scene);
    edit(scene, 0.3, glm::vec3(0.5F));
    update_flat(scene, flat);
    EXPECT_TRUE(same_bytes(flat.surfaces, flatten(scene).surfaces));
    EXPECT_EQ(flat.surfaces.maps.size(), 2U);
    update_flat(brushed(), flat);
    EXPECT_TRUE(same_bytes(flat.surfaces, flatten(brushed()).surfaces));
    EXPECT_EQ(flat.surfaces.maps.size(), 3U);
}

TEST(FlatSurfaces, AnEditedSceneRendersAsIfItWereUploadedAnew) {
    const Camera camera = test::look_at({0, 0, 2}, {0, 0, 0}, 1.0);
    PathSettings settings;
    settings.width = settings.height = 24;
    settings.samples = {0, 4};
    for (const TestBackend backend : test::backends()) {
        Executor& executor = test::shared_executor(backend);
        for (const double roughness : {0.0, 0.7}) {
            // From surfaces without tables to those with some, and the other way.
            Scene scene = surfaces();
            edit(scene, 0.7 - roughness, glm::vec3(0.3F));
            FlatScene flat = flatten(scene);
            auto buffers = std::make_shared<SceneBuffers>(upload_scene(executor, flat));
            edit(scene, roughness, {0.2F, 0.4F, 0.6F});
            update_flat(scene, flat);
            update_scene(executor, flat, *buffers);
            PathRenderer renderer(executor, flat, buffers, camera, settings, {});
            while (renderer.render_frame({})) continue;
            const Image anew = test::path_image(executor, flatten(scene), camera, settings).image;
            EXPECT_EQ(test::differing_values(renderer.image(), anew), 0U)
                << test::backend_name(backend) << ' ' << roughness;
        }
    }
}

}  // namespace
}  // namespace weft::flat_surfaces_test
