// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/validate_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/limits.h"

namespace weft::validate_scene_test {
namespace {

Scene good_scene() {
    Scene scene;
    scene.source = "a.gltf";
    Texture texture;
    texture.name = "t";
    texture.width = 2;
    texture.height = 1;
    texture.rgba.resize(8);
    scene.textures.push_back(texture);
    Material material;
    material.name = "m";
    set_albedo_texture(material, 0);
    scene.materials.push_back(material);
    Mesh mesh;
    mesh.name = "g";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    mesh.uvs.assign(3, glm::vec2(0));
    mesh.colours.assign(3, glm::vec3(1));
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
    Instance instance;
    instance.name = "i";
    scene.instances.push_back(instance);
    PunctualLight light;
    light.name = "l";
    scene.lights.push_back(light);
    Camera camera;
    camera.name = "c";
    scene.cameras.push_back(camera);
    scene.environment = Environment{};
    scene.media.emplace_back();
    scene.media[0].name = "fog";
    scene.medium_boundaries.emplace_back();
    scene.medium_boundaries[0].interior = 0;
    scene.camera_medium = 0;
    scene.film = FilmSize{4, 4};
    return scene;
}

std::string error_after(const std::function<void(Scene&)>& change) {
    Scene scene = good_scene();
    change(scene);
    try {
        validate_scene(scene);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(ValidateScene, AcceptsGoodAndEmptyScenes) {
    EXPECT_EQ(error_after([](Scene&) {}), "no error");
    EXPECT_EQ(error_after([](Scene& s) { s = Scene{}; }), "no error");
}

TEST(ValidateScene, ChecksTexturesAndMaterials) {
    EXPECT_EQ(error_after([](Scene& s) { s.textures[0].height = 0; }),
              "a.gltf: texture 't' is empty");
    EXPECT_EQ(error_after([](Scene& s) { s.textures[0].rgba.pop_back(); }),
              "a.gltf: texture 't' has the wrong number of bytes");
    EXPECT_EQ(error_after([](Scene& s) { set_albedo_texture(s.materials[0], 1); }),
              "a.gltf: material 'm' refers to a texture that does not exist");
    for (const float value : {nan, -0.1F, 1.1F})
        EXPECT_EQ(error_after([&](Scene& s) {
                      set_diffuse_albedo(s.materials[0], {0.5F, value, 0.5F});
                  }),
                  "a.gltf: material 'm' has an albedo outside [0, 1]");
    for (const float value : {nan, -1.0F, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(error_after([&](Scene& s) { s.materials[0].emission.radiance.z = value; }),
                  "a.gltf: material 'm' has an emission that is negative or not finite");
}

/// The good scene with a description whose normal map needs one set of texture coordinates.
void describe(Scene& scene) {
    SurfaceDescription surface;
    surface.normal_map.map.texture = 0;
    scene.materials[0].description = surface;
    scene.meshes[0].uv_sets.emplace_back(3, glm::vec2(0.0F));
}

TEST(ValidateScene, ChecksDescriptionsOfSurfaces) {
    const auto error_of = [](const std::function<void(Scene&, SurfaceDescription&)>& change) {
        return error_after([&](Scene& s) {
            describe(s);
            change(s, *s.materials[0].description);
        });
    };
    using Surface = SurfaceDescription;
    EXPECT_EQ(error_of([](Scene&, Surface&) {}), "no error");
    EXPECT_EQ(error_of([](Scene&, Surface& d) { d.normal_map.map.texture = 1; }),
              "a.gltf: material 'm' refers to a texture that does not exist");
    EXPECT_EQ(error_of([](Scene&, Surface& d) { d.normal_map.map.uv_set = 4; }),
              "a.gltf: material 'm' refers to a set of texture coordinates that does not exist");
    EXPECT_EQ(error_of([](Scene&, Surface& d) { d.normal_map.map.uv_set = 1; }),
              "a.gltf: instance 'i' lacks the texture coordinates that its material asks for");
    EXPECT_EQ(error_of([](Scene&, Surface& d) { d.normal_map.map.to_uv[2].x = 1e300; }),
              "a.gltf: material 'm' has a texture transform that is not finite");
    EXPECT_EQ(error_of([](Scene&, Surface& d) { d.normal_map.scale = nan; }),
              "a.gltf: material 'm' has normals scaled beyond 1000");
    EXPECT_EQ(error_of([](Scene& s, Surface&) { s.meshes[0].uv_sets[0].pop_back(); }),
              "a.gltf: mesh 'g' has texture coordinates of the wrong number");
    EXPECT_EQ(error_of([](Scene& s, Surface&) { s.meshes[0].uv_sets[0][1].y = nan; }),
              "a.gltf: mesh 'g' has a texture coordinate that is not finite");
    EXPECT_EQ(
        error_of([](Scene& s, Surface&) { s.meshes[0].uv_sets.resize(5, s.meshes[0].uv_sets[0]); }),
        "a.gltf: mesh 'g' has more sets of texture coordinates than the limit");
    EXPECT_EQ(error_of([](Scene& s, Surface&) { s.meshes[0].alphas = {1.0F}; }),
              "a.gltf: mesh 'g' has vertex alphas of the wrong number");
    EXPECT_EQ(error_of([](Scene& s, Surface&) {
                  s.meshes[0].alphas = {1.0F, nan, 0.0F};
              }),
              "a.gltf: mesh 'g' has a vertex alpha outside [0, 1]");
}

TEST(ValidateScene, ChecksMeshes) {
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].normals.pop_back(); }),
              "a.gltf: mesh 'g' has normals of the wrong number");
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].uvs.pop_back(); }),
              "a.gltf: mesh 'g' has texture coordinates of the wrong number");
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].colours.pop_back(); }),
              "a.gltf: mesh 'g' has vertex colours of the wrong number");
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].triangles[0][1] = 3; }),
              "a.gltf: mesh 'g' has a triangle with a vertex that does not exist");
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].positions[2].x = nan; }),
              "a.gltf: mesh 'g' has a vertex that is not finite");
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].normals[2].x = nan; }),
              "a.gltf: mesh 'g' has a normal that is not finite");
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].uvs[2].x = nan; }),
              "a.gltf: mesh 'g' has a texture coordinate that is not finite");
    EXPECT_EQ(error_after([](Scene& s) { s.meshes[0].colours[2].x = 2; }),
              "a.gltf: mesh 'g' has a vertex colour outside [0, 1]");
}

TEST(ValidateScene, ChecksInstances) {
    EXPECT_EQ(error_after([](Scene& s) { s.instances[0].mesh = 1; }),
              "a.gltf: instance 'i' refers to a mesh that does not exist");
    EXPECT_EQ(error_after([](Scene& s) { s.instances[0].material = 1; }),
              "a.gltf: instance 'i' refers to a material that does not exist");
    EXPECT_EQ(error_after([](Scene& s) { s.instances[0].to_world[1][1] = 0; }),
              "a.gltf: instance 'i' has a transform that cannot be inverted");
    EXPECT_EQ(error_after([](Scene& s) { s.instances[0].to_world[1][1] = double{nan}; }),
              "a.gltf: instance 'i' has a transform that is not finite");
    EXPECT_EQ(error_after([](Scene& s) { s.instances[0].to_world[1][3] = 1; }),
              "a.gltf: instance 'i' has a transform that is not affine");
    EXPECT_EQ(error_after([](Scene& s) { s.instances[0].to_world[0][0] = 1.1e15; }),
              "a.gltf: instance 'i' lies too far from the origin");
    EXPECT_EQ(error_after([](Scene& s) { s.instances[0].to_world[0][0] = 0.9e15; }), "no error");
}

TEST(ValidateScene, CountsPlacedTriangles) {
    const auto change = [](std::size_t instances) {
        return [=](Scene& s) {
            s.meshes[0].triangles.assign(1U << 20, {0, 1, 2});
            s.instances.assign(instances, s.instances[0]);
        };
    };
    EXPECT_EQ(error_after(change(limits::max_triangles >> 20)), "no error");
    EXPECT_EQ(error_after(change((limits::max_triangles >> 20) + 1)),
              "a.gltf: instance 'i' brings the scene above the limit of 134217728 triangles");
}

TEST(ValidateScene, ChecksLightsCamerasMediaAndFilm) {
    EXPECT_EQ(error_after([](Scene& s) { s.lights[0].direction.x = 1; }),
              "a.gltf: light 'l' has a direction that is not of unit length");
    EXPECT_EQ(error_after([](Scene& s) { s.lights[0].position.x = double{nan}; }),
              "a.gltf: light 'l' lies too far from the origin");
    EXPECT_EQ(error_after([](Scene& s) { s.lights[0].intensity.x = -1; }),
              "a.gltf: light 'l' has an intensity that is negative or not finite");
    EXPECT_EQ(error_after([](Scene& s) { s.lights[0].cos_inner = -0.5F; }),
              "a.gltf: light 'l' has impossible cone angles");
    EXPECT_EQ(error_after([](Scene& s) { s.cameras[0].fov = 3.2; }),
              "a.gltf: camera 'c' has a field of view outside (0, 180) degrees");
    EXPECT_EQ(error_after([](Scene& s) { s.environment->radiance.x = nan; }),
              "a.gltf: environment has a radiance that is negative or not finite");
    EXPECT_EQ(error_after([](Scene& s) { s.media[0].sigma_t.x = -1; }),
              "a.gltf: medium 'fog' has an extinction that is negative or not finite");
    for (const float value : {nan, -1.0F, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(error_after([&](Scene& s) { s.media[0].emission.y = value; }),
                  "a.gltf: medium 'fog' has an emission that is negative or not finite");
    EXPECT_EQ(error_after([](Scene& s) { s.media[0].anisotropy = 1; }),
              "a.gltf: medium 'fog' has an anisotropy outside (-1, 1)");
    EXPECT_EQ(error_after([](Scene& s) { s.media[0].grid = 0; }),
              "a.gltf: medium 'fog' refers to a density grid that does not exist");
    EXPECT_EQ(
        error_after([](Scene& s) {
            s.grids.push_back({{1, 1, 2}, {0, -1}});
        }),
        "a.gltf: density grid: voxel (0, 0, 1) is -1, expected a finite density of at least 0");
    EXPECT_EQ(error_after([](Scene& s) {
                  s.grids.push_back({{1, 1, 1}, {1}});
                  s.media[0].grid = 0;
                  s.media[0].grid_to_world[0][0] = 0.0;
              }),
              "a.gltf: medium 'fog' has a transform that cannot be inverted");
    EXPECT_EQ(error_after([](Scene& s) { s.medium_boundaries[0].exterior = 1; }),
              "a.gltf: medium boundary refers to a medium that does not exist");
    EXPECT_EQ(error_after([](Scene& s) { s.camera_medium = 1; }),
              "a.gltf: camera lies in a medium that does not exist");
    EXPECT_EQ(error_after([](Scene& s) { s.film->height = 40000; }),
              "a.gltf: film is larger than the limit");
}

/// A camera that is carried by the second of two moving nodes.
void move_camera(Scene& scene) {
    scene.animation.tracks = {{Interpolation::linear, 3, {0, 1}, {0, 0, 0, 1, 0, 0}}};
    scene.animation.nodes.resize(2);
    scene.animation.nodes[0].translation = 0;
    scene.animation.nodes[1].parent = 0;
    scene.cameras[0].motion.node = 1;
}

TEST(ValidateScene, ChecksAnimations) {
    const auto error_of = [](const std::function<void(Animation&, Camera&)>& change) {
        return error_after([&](Scene& s) {
            move_camera(s);
            change(s.animation, s.cameras[0]);
        });
    };
    const std::string values = "a.gltf: animation track has the wrong number of values";
    EXPECT_EQ(error_of([](Animation&, Camera&) {}), "no error");
    EXPECT_EQ(error_of([](Animation& a, Camera&) { a.tracks[0].values.pop_back(); }), values);
    EXPECT_EQ(error_of([](Animation& a, Camera&) { a.tracks[0].width = 4; }), values);
    EXPECT_EQ(
        error_of([](Animation& a, Camera&) { a.tracks[0].interpolation = Interpolation::cubic; }),
        values);
    EXPECT_EQ(error_of([](Animation& a, Camera&) { a.tracks[0] = {}; }), values);
    EXPECT_EQ(error_of([](Animation& a, Camera&) { a.nodes[1].scale = 1; }),
              "a.gltf: moving node refers to a track that does not exist");
    EXPECT_EQ(error_of([](Animation& a, Camera&) { a.nodes[1].parent = 1; }),
              "a.gltf: moving node refers to a parent that does not come before it");
    EXPECT_EQ(error_of([](Animation&, Camera& c) { c.motion.node = 2; }),
              "a.gltf: camera 'c' moves with a node that does not exist");
}

TEST(ValidateScene, ChecksACameraAtAnotherTime) {
    const Scene scene = good_scene();
    Camera camera = scene.cameras[0];
    EXPECT_NO_THROW(validate_camera(scene, camera, "at 3 s"));
    camera.to_world[2] = glm::dvec4(0.0);
    try {
        validate_camera(scene, camera, "at 3 s");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "a.gltf: camera 'c' at 3 s has a transform that cannot be inverted");
    }
}

}  // namespace
}  // namespace weft::validate_scene_test
