// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/pose_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "scene/load/load_scene.h"
#include "scene/moving_scene.h"
#include "scene/validate_scene.h"
#include "tests/testing/edited_room.h"
#include "tests/testing/moving_frames.h"
#include "tests/testing/moving_room.h"
#include "tests/testing/render_fixture.h"

namespace weft::pose_scene_test {
namespace {

using test::TestBackend;

/// The tracks of a joint that turns by 90 degrees about x, and of a weight that becomes 1.
void add_tracks(Scene& scene) {
    const float quarter = std::sqrt(0.5F);
    scene.animation.tracks.push_back(
        {Interpolation::linear, 4, {0, 10}, {0, 0, 0, 1, quarter, 0, 0, quarter}});
    scene.animation.tracks.push_back({Interpolation::linear, 1, {0, 5}, {0, 1}});
}

/// A square in the plane z = 0, the upper edge of which belongs to joint 1 and the lower to joint
/// 0; a target makes it bulge.
MeshShape square_shape(const Mesh& mesh) {
    MeshShape shape;
    shape.positions = mesh.positions;
    shape.normals = mesh.normals;
    shape.targets.resize(1);
    shape.influences.width = 2;
    for (const glm::vec3& p : mesh.positions) {
        const float share = p.y + 0.5F;
        shape.targets[0].positions.emplace_back(0.0F, 0.0F, 0.3F * (1.0F - 4.0F * p.x * p.x));
        shape.targets[0].normals.emplace_back(2.4F * p.x, 0.0F, 0.0F);
        for (const auto joint : {std::uint16_t{0}, std::uint16_t{1}})
            shape.influences.joints.push_back(joint);
        shape.influences.weights.push_back(1.0F - share);
        shape.influences.weights.push_back(share);
    }
    return shape;
}

/// A room in which a sheet bends and bulges.
Scene bending_room() {
    test::MovingRoom room = test::moving_room(0);
    Scene scene = std::move(room.scene);
    Instance& sheet = scene.instances[room.things.front()];
    sheet.name = "sheet";
    sheet.deformation = 0;
    Mesh& mesh = scene.meshes[sheet.mesh];
    mesh = test::quad_mesh({-0.5F, -0.5F, 0.0F}, {1, 0, 0}, {0, 1, 0}, 6);
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0F, 0.0F, 1.0F));
    add_tracks(scene);
    MovingNode node;
    node.to_parent = sheet.to_world;
    node.rotation = 0;
    scene.animation.nodes.push_back(node);
    Skin skin;
    skin.frame = {-1, sheet.to_world};
    skin.joints = {{-1, sheet.to_world}, {0, glm::dmat4(1.0)}};
    skin.inverse_bind.assign(2, glm::dmat4(1.0));
    scene.skins.push_back(skin);
    Deformation deformation;
    deformation.mesh = sheet.mesh;
    deformation.shape = std::make_shared<const MeshShape>(square_shape(mesh));
    deformation.skin = 0;
    deformation.weights_track = 1;
    scene.deformations.push_back(deformation);
    validate_scene(scene);
    return scene;
}

using test::igi_settings;

/// The image of a frame after those that lead to it.
Image frame_after(const std::vector<std::uint32_t>& frames, TestBackend backend) {
    return test::frame_after(bending_room(), frames, backend);
}

TEST(PoseScene, VerticesAreWhereJointsAndWeightsPutThem) {
    const Scene scene = bending_room();
    Scene posed = scene;
    // In between, the scene is something else.
    for (const double time : {3.0, 10.0}) pose_scene(scene, time, posed);
    const Deformation& deformation = scene.deformations[0];
    const Mesh& mesh = posed.meshes[deformation.mesh];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p(deformation.shape->positions[i]);
        const double share = p.y + 0.5;
        const double bulge = 0.3 * (1.0 - 4.0 * p.x * p.x);
        // A quarter turn about x takes y to z and z to -y.
        const glm::dvec3 expected(p.x, (1.0 - share) * p.y - share * bulge,
                                  (1.0 - share) * bulge + share * p.y);
        EXPECT_LT(glm::length(glm::dvec3(mesh.positions[i]) - expected), 1e-6) << i;
    }
}

TEST(PoseScene, AFlatFrameDoesNotDependOnThoseBefore) {
    MovingScene one(bending_room(), {}, 1.0);
    MovingScene other(bending_room(), {}, 1.0);
    one.set_frame(4);
    for (const std::uint32_t frame : {9U, 0U, 4U}) other.set_frame(frame);
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
    };
    EXPECT_TRUE(same(one.flat().positions, other.flat().positions));
    EXPECT_TRUE(same(one.flat().normals, other.flat().normals));
    EXPECT_TRUE(same(one.flat().triangles, other.flat().triangles));
    other.set_frame(5);
    EXPECT_FALSE(same(one.flat().positions, other.flat().positions));
    EXPECT_FALSE(same(one.flat().normals, other.flat().normals));
}

TEST(PoseScene, AnImageDoesNotDependOnTheFramesBefore) {
    for (const TestBackend backend : test::backends()) {
        const Image alone = frame_after({4}, backend);
        EXPECT_EQ(test::differing_values(alone, frame_after({7, 1, 4}, backend)), 0U)
            << test::backend_name(backend);
        EXPECT_GT(test::differing_values(alone, frame_after({5}, backend)), 0U);
    }
}

TEST(PoseScene, ImagesShowWhatIsDeformed) {
    // As if the scene had been modelled that way: triangles only have other numbers, and origins of
    // rays are moved off surfaces by a share of an extent that is rounded up where things move.
    const Scene rest = bending_room();
    Scene modelled = rest;
    pose_scene(rest, 4.0, modelled);
    hold_still(modelled);
    const test::Rendering expected =
        test::render(TestBackend::own_bvh, modelled, test::room_camera(), igi_settings());
    const Image image = frame_after({0, 4}, TestBackend::own_bvh);
    for (const char* const layer : {"direct", "indirect", "albedo", "depth", "normal"})
        EXPECT_LT(test::relative_mse(expected.layer(layer), image.find(layer)->values), 1e-7)
            << layer;
}

TEST(PoseScene, RecordsThatAreKeptFollowWhatDeforms) {
    RenderSettings settings = test::small_settings(Algorithm::tic, 32, 24);
    settings.sampling.vpls_per_set = 14;
    settings.sampling.validate_cache = true;
    settings.direct = false;
    for (const TestBackend backend : test::backends()) {
        MovingScene moving(bending_room(), {}, 1.0);
        moving.set_frame(0);
        Renderer renderer(test::shared_executor(backend), moving.flat(), test::room_camera(),
                          settings);
        EXPECT_TRUE(renderer.render_frame({}));
        std::size_t kept = 0;
        // From frame 10 on all is at rest.
        for (std::uint32_t frame = 1; frame < 12; ++frame) {
            moving.set_frame(frame);
            renderer.update_scene();
            renderer.move_camera(test::room_camera());
            EXPECT_TRUE(renderer.render_frame({}));
            const FrameStats& stats = renderer.stats().back();
            ASSERT_TRUE(stats.cache.has_value());
            EXPECT_EQ(stats.cache->differing, 0U)
                << test::backend_name(backend) << ", frame " << frame;
            if (frame > 10) {
                EXPECT_EQ(stats.cache->updated, 0U);
            }
            kept += stats.cache->kept;
        }
        EXPECT_GT(kept, 0U);
    }
}

TEST(PoseScene, CopiesThatEditsMakeDeformAsWell) {
    Scene scene = bending_room();
    EditTimeline edits = test::read_text(
        R"({"edits": [{"frame": 0, "object": "sheet",
                       "add": {"name": "copy", "translation": [-0.3, 0.4, 0.1],
                               "scale": [0.7, 0.7, 0.7]}}]})",
        scene);
    // The original is scaled by as much, at another place.
    const auto original = static_cast<std::size_t>(scene.instances.size() - 2);
    const glm::dvec3 apart =
        glm::dvec3(-0.3, 0.4, 0.1) - glm::dvec3(scene.instances[original].to_world[3]);
    ASSERT_EQ(scene.instances[original].name, "sheet");
    MovingScene moving(std::move(scene), std::move(edits), 1.0);
    for (const std::uint32_t frame : {2U, 8U}) {
        moving.set_frame(frame);
        const FlatScene& flat = moving.flat();
        const InstanceRange& from = flat.ranges[original];
        const InstanceRange& to = flat.ranges[original + 1];
        ASSERT_EQ(from.vertices, to.vertices);
        for (std::uint32_t v = 0; v < from.vertices; ++v) {
            const shared::float4& a = flat.positions[from.first_vertex + v];
            const shared::float4& b = flat.positions[to.first_vertex + v];
            const glm::dvec3 difference(b.x - a.x, b.y - a.y, b.z - a.z);
            EXPECT_LT(glm::length(difference - apart * flat.units.scale), 1e-6);
        }
    }
}

TEST(PoseScene, HoldingStillDropsWhatDeforms) {
    Scene scene = bending_room();
    EXPECT_TRUE(is_animated(scene));
    hold_still(scene);
    EXPECT_FALSE(is_animated(scene));
    EXPECT_TRUE(scene.deformations.empty());
    MovingScene moving(scene, {}, 1.0);
    EXPECT_FALSE(moving.moves());
    EXPECT_EQ(moving.flat().first_moving_triangle, moving.flat().triangles.size());
}

TEST(PoseScene, TheFigureThatComesWithWeftMovesInALoop) {
    Diagnostics diagnostics;
    const Scene scene =
        load_scene(std::string(WEFT_SOURCE_DIR) + "/scenes/figure.gltf", diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    EXPECT_EQ(scene.skins.size(), 1U);
    ASSERT_EQ(scene.deformations.size(), 3U);
    const auto vertices_at = [&](double time) {
        Scene posed = scene;
        pose_scene(scene, time, posed);
        validate_pose(posed, "then");
        std::vector<glm::vec3> all;
        for (const Deformation& deformation : posed.deformations) {
            const Mesh& mesh = posed.meshes[deformation.mesh];
            all.insert(all.end(), mesh.positions.begin(), mesh.positions.end());
        }
        return all;
    };
    const auto apart = [](const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
        float most = 0.0F;
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::length(a[i] - b[i]));
        return most;
    };
    std::vector<glm::vec3> rest;
    for (const Deformation& deformation : scene.deformations) {
        const Mesh& mesh = scene.meshes[deformation.mesh];
        rest.insert(rest.end(), mesh.positions.begin(), mesh.positions.end());
    }
    const std::vector<glm::vec3> first = vertices_at(0.0);
    EXPECT_LT(apart(first, rest), 1e-5F);
    EXPECT_LT(apart(first, vertices_at(2.0)), 1e-5F);
    EXPECT_GT(apart(first, vertices_at(0.5)), 0.05F);
}

TEST(PoseScene, WhatOutgrowsTheSceneByFarIsRefused) {
    // Floats in the units of the scene at rest do not reach there.
    Scene scene;
    scene.source = "a.gltf";
    scene.materials.emplace_back();
    scene.meshes.push_back(test::quad_mesh({0, 0, 0}, {1e-20F, 0, 0}, {0, 1e-20F, 0}));
    scene.instances.emplace_back();
    scene.instances[0].name = "seed";
    scene.instances[0].may_move = true;
    scene.instances[0].motion.node = 0;
    scene.animation.tracks.push_back(
        {Interpolation::step, 3, {0, 1}, {1, 1, 1, 1e30F, 1e30F, 1e30F}});
    scene.animation.nodes.resize(1);
    scene.animation.nodes[0].scale = 0;
    validate_scene(scene);
    MovingScene moving(scene, {}, 1.0);
    moving.set_frame(0);
    try {
        moving.set_frame(1);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_STREQ(error.what(),
                     "a.gltf: instance 'seed' in frame 1 lies too far from the scene at rest");
    }
}

}  // namespace
}  // namespace weft::pose_scene_test
