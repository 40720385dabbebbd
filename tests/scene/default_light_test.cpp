// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/default_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/error.h"
#include "scene/load/load_scene.h"
#include "scene/validate_scene.h"
#include "tests/testing/temporary_folder.h"

namespace weft::default_light_test {
namespace {

/// One upright square that faces the automatic camera.
Scene square() {
    Scene scene;
    scene.source = "s";
    scene.materials.emplace_back();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(mesh);
    scene.instances.emplace_back();
    return scene;
}

bool stays_as_it_is(Scene scene) {
    Diagnostics diagnostics;
    const std::size_t lights = scene.lights.size();
    const bool environment = scene.environment.has_value();
    add_default_light(scene, DefaultLight::as_needed, diagnostics);
    return scene.lights.size() == lights && scene.environment.has_value() == environment &&
           diagnostics.warnings().empty();
}

TEST(DefaultLight, LightsABareMesh) {
    Scene scene = square();
    Diagnostics diagnostics;
    add_default_light(scene, DefaultLight::as_needed, diagnostics);
    validate_scene(scene);
    ASSERT_TRUE(scene.environment);
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(diagnostics.warnings(),
              std::vector<std::string>{
                  "s: no light, so a grey sky and a distant light from above are added (--light "
                  "none leaves them out)"});
    EXPECT_TRUE(scene.default_light);
    // Radiance of an unshadowed surface of albedo 0.8 that faces the camera.
    const double cosine = -scene.lights[0].direction.z;
    EXPECT_GT(cosine, 0.0);
    const double radiance =
        0.8 * (static_cast<double>(scene.environment->radiance.g) +
               static_cast<double>(scene.lights[0].intensity.g) * cosine / 3.14159265);
    EXPECT_GT(radiance, 0.3);
    EXPECT_LT(radiance, 0.6);
    // From above.
    EXPECT_LT(scene.lights[0].direction.y, -0.5);
}

TEST(DefaultLight, ShinesFromAboveTheCamera) {
    Scene scene = square();
    Camera camera;  // looks along +x, with +y up
    camera.to_world = {glm::dvec4(0, 0, 5, 0), glm::dvec4(0, 5, 0, 0), glm::dvec4(-5, 0, 0, 0),
                       glm::dvec4(-9, 0, 0, 1)};
    scene.cameras.push_back(camera);
    Diagnostics diagnostics;
    add_default_light(scene, DefaultLight::as_needed, diagnostics);
    validate_scene(scene);
    EXPECT_GT(scene.lights.at(0).direction.x, 0.3);
    EXPECT_LT(scene.lights.at(0).direction.y, -0.3);
    EXPECT_GT(scene.lights.at(0).direction.z, 0.0);
}

TEST(DefaultLight, LeavesScenesWithALightAlone) {
    EXPECT_FALSE(stays_as_it_is(square()));
    Scene punctual = square();
    punctual.lights.emplace_back();
    punctual.lights[0].intensity = glm::vec3(0.0F);
    EXPECT_TRUE(stays_as_it_is(punctual));
    Scene dark_sky = square();
    dark_sky.environment.emplace();
    EXPECT_TRUE(stays_as_it_is(dark_sky));
    Scene area_light = square();
    area_light.materials[0].emission.radiance = glm::vec3(0.0F, 0.0F, 1.0F);
    EXPECT_TRUE(stays_as_it_is(area_light));
    // An area light's material that nothing is made of gives no light.
    Scene unused = square();
    unused.materials.push_back(area_light.materials[0]);
    EXPECT_FALSE(stays_as_it_is(unused));
    // Nor does a medium that is nowhere.
    Scene emissive = square();
    emissive.media.emplace_back();
    emissive.media[0].emission = glm::vec3(0.0F, 1.0F, 0.0F);
    EXPECT_FALSE(stays_as_it_is(emissive));
    emissive.medium_boundaries.push_back({0, glm::dmat4(1.0), 0, -1});
    EXPECT_TRUE(stays_as_it_is(emissive));
    emissive.media[0].emission = glm::vec3(0.0F);
    EXPECT_FALSE(stays_as_it_is(emissive));
    EXPECT_TRUE(stays_as_it_is(Scene()));
}

/// The square with emission in a small part of its area or all of it, by a texture or without.
Scene glowing(float radiance, float share, bool textured) {
    Scene scene = square();
    scene.materials.emplace_back();
    scene.instances.emplace_back();
    scene.instances[1].to_world = glm::dmat4(static_cast<double>(std::sqrt(share)));
    scene.instances[1].to_world[3] = glm::dvec4(0.0, 0.0, 1.0, 1.0);
    scene.instances[1].material = 1;
    scene.materials[1].emission.radiance = glm::vec3(radiance, 0.0F, 0.0F);
    if (textured) {
        Texture texture;
        texture.width = texture.height = 16;
        texture.rgba.assign(4 * 16 * 16, 0);
        std::fill_n(texture.rgba.begin(), 4 * 16, std::uint8_t{255});  // one row of 16
        scene.textures.push_back(texture);
        scene.materials[1].emission.texture = 0;
        scene.meshes[0].uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    }
    validate_scene(scene);
    return scene;
}

TEST(DefaultLight, CountsEmissionThatLights) {
    EXPECT_EQ(own_light(square()), OwnLight::none);
    // An indicator lamp, and a label all over which letters shine.
    EXPECT_EQ(own_light(glowing(1.0F, 0.01F, false)), OwnLight::faint);
    EXPECT_EQ(own_light(glowing(1.0F, 1.0F, true)), OwnLight::faint);
    // A lamp by its radiance, however small; walls that shine; a texture as bright as a lamp.
    EXPECT_EQ(own_light(glowing(1.5F, 0.0001F, false)), OwnLight::emission);
    EXPECT_EQ(own_light(glowing(1.0F, 1.0F, false)), OwnLight::emission);
    EXPECT_EQ(own_light(glowing(20.0F, 1.0F, true)), OwnLight::emission);
    EXPECT_EQ(own_light(glowing(20.0F, 0.01F, true)), OwnLight::faint);
    Scene both = glowing(1.0F, 0.01F, false);
    both.lights.emplace_back();
    EXPECT_EQ(own_light(both), OwnLight::named);
}

TEST(DefaultLight, IsAddedToFaintEmissionAndSaysSo) {
    Scene scene = glowing(1.0F, 1.0F, true);
    Diagnostics diagnostics;
    add_default_light(scene, DefaultLight::as_needed, diagnostics);
    EXPECT_TRUE(scene.default_light);
    EXPECT_EQ(diagnostics.warnings(),
              std::vector<std::string>{
                  "s: its emission lights too little to see by, so a grey sky and a distant light "
                  "from above are added (--light none leaves them out)"});
    EXPECT_TRUE(stays_as_it_is(glowing(20.0F, 1.0F, true)));
}

TEST(DefaultLight, IsAddedOrNotAsTheUserSays) {
    Diagnostics said;
    Scene dark = square();
    add_default_light(dark, DefaultLight::never, said);
    EXPECT_TRUE(dark.lights.empty());
    EXPECT_FALSE(dark.environment);
    EXPECT_EQ(said.warnings(), std::vector<std::string>{
                                   "s: no light, which --light none leaves so: the image is dark"});
    Diagnostics silent;
    Scene faint = glowing(1.0F, 1.0F, true);
    add_default_light(faint, DefaultLight::never, silent);
    EXPECT_TRUE(faint.lights.empty());
    EXPECT_TRUE(silent.warnings().empty());
    // Beside what the file has; a sky that it names stays.
    Diagnostics added;
    Scene lit = square();
    lit.lights.emplace_back();
    lit.environment = Environment{glm::vec3(3.0F)};
    add_default_light(lit, DefaultLight::always, added);
    validate_scene(lit);
    EXPECT_EQ(lit.lights.size(), 2U);
    EXPECT_EQ(lit.environment->radiance, glm::vec3(3.0F));
    EXPECT_EQ(added.warnings(),
              std::vector<std::string>{"s: a grey sky and a distant light from above are added"});
}

TEST(DefaultLight, IsUsedForEveryFormatButNotAgainstTheFile) {
    const TemporaryFolder folder;
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const auto xml = [](const std::string& emitter) {
        return "<scene version=\"3.0.0\"><shape type=\"obj\"><string name=\"filename\" "
               "value=\"a.obj\"/>" +
               emitter + "</shape></scene>";
    };
    const auto is_lit = [&](const std::string& name, const std::string& text) {
        Diagnostics diagnostics;
        const Scene scene = load_scene(folder.write(name, text), diagnostics);
        EXPECT_EQ(scene.instances.size(), 1U) << name;
        return scene.environment.has_value() && diagnostics.warnings().size() == 1;
    };
    EXPECT_TRUE(is_lit("a.obj", obj));
    EXPECT_TRUE(is_lit("a.ply", ply));
    EXPECT_TRUE(is_lit("a.xml", xml("")));
    EXPECT_FALSE(is_lit("b.xml", xml("<emitter type=\"area\"><rgb name=\"radiance\" "
                                     "value=\"0\"/></emitter>")));
    EXPECT_FALSE(is_lit("b.obj", "mtllib b.mtl\nusemtl a\n" + obj)) << "two warnings";
    folder.write("c.mtl", "newmtl a\nKe 1 1 1\n");
    EXPECT_FALSE(is_lit("c.obj", "mtllib c.mtl\nusemtl a\n" + obj));
}

TEST(DefaultLight, PlyScenesAreGreyOrHaveTheirColours) {
    const TemporaryFolder folder;
    const auto ply = [](const std::string& properties, const std::string& values) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\n" +
               properties +
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0" +
               values + "\n1 0 0" + values + "\n0 1 0" + values + "\n3 0 1 2\n";
    };
    Diagnostics diagnostics;
    const Scene grey = load_scene(folder.write("g.ply", ply("", "")), diagnostics);
    EXPECT_EQ(diffuse_albedo(grey.materials.at(0)), glm::vec3(0.8F));
    const Scene red = load_scene(
        folder.write("r.ply", ply("property uchar red\nproperty uchar green\nproperty uchar blue\n",
                                  " 255 0 0")),
        diagnostics);
    EXPECT_EQ(diffuse_albedo(red.materials.at(0)), glm::vec3(1.0F));
    EXPECT_EQ(red.meshes.at(0).colours.at(2), glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace weft::default_light_test
