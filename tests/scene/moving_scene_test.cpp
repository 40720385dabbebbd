// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "render/path_renderer.h"
#include "scene/moving_scene.h"
#include "scene/pose_scene.h"
#include "tests/testing/moving_frames.h"
#include "tests/testing/moving_room.h"
#include "tests/testing/render_fixture.h"

namespace weft::moving_scene_test {
namespace {

using test::igi_settings;
using test::sliding_room;
using test::TestBackend;

/// The image of a frame after those that lead to it.
Image frame_after(const std::vector<std::uint32_t>& frames, TestBackend backend) {
    return test::frame_after(sliding_room(), frames, backend);
}

TEST(MovingScene, AnImageDoesNotDependOnTheFramesBefore) {
    for (const TestBackend backend : test::backends()) {
        const Image alone = frame_after({4}, backend);
        EXPECT_EQ(test::differing_values(alone, frame_after({0, 1, 4}, backend)), 0U)
            << test::backend_name(backend);
        EXPECT_EQ(test::differing_values(alone, frame_after({7, 4}, backend)), 0U)
            << test::backend_name(backend);
        EXPECT_GT(test::differing_values(alone, frame_after({5}, backend)), 0U);
    }
}

/// Indirect light of a room after its surfaces have had these albedos, one in each frame.
std::vector<float> indirect_after(const std::vector<float>& albedos, TestBackend backend) {
    test::MovingRoom room = test::moving_room(0);
    const auto paint = [&](float albedo) {
        for (Material& material : room.scene.materials)
            set_diffuse_albedo(material, glm::vec3(albedo));
    };
    paint(albedos.front());
    room.flat = flatten(room.scene);
    Renderer renderer(test::shared_executor(backend), room.flat, test::room_camera(),
                      igi_settings());
    for (std::size_t i = 0; i < albedos.size(); ++i) {
        if (i > 0) {
            paint(albedos[i]);
            update_flat(room.scene, room.flat);
            renderer.update_scene();
            renderer.move_camera(test::room_camera());
        }
        EXPECT_TRUE(renderer.render_frame({}));
    }
    return renderer.image().find("indirect")->values;
}

TEST(MovingScene, SurfacesThatWereBlackAtFirstReflectLight) {
    for (const TestBackend backend : test::backends()) {
        const std::vector<float> lit = indirect_after({0.0F, 0.6F}, backend);
        EXPECT_GT(test::mean_of(lit), 0.0);
        EXPECT_EQ(lit, indirect_after({0.0F, 0.2F, 0.0F, 0.6F}, backend));
        EXPECT_EQ(test::mean_of(indirect_after({0.6F, 0.0F}, backend)), 0.0);
        EXPECT_EQ(indirect_after({0.6F}, backend), indirect_after({0.6F, 0.0F, 0.6F}, backend));
    }
}

TEST(MovingScene, AllThatMovesMayBeAbsent) {
    // Embree's builder fails an assertion where all of a mesh has shrunk to a point.
    for (const unsigned which : {0U, 1U, 2U})
        for (const TestBackend backend : test::backends()) {
            test::MovingRoom room = test::moving_room(which);
            Renderer renderer(test::shared_executor(backend), room.flat, test::room_camera(),
                              igi_settings());
            const auto image = [&](bool present) {
                for (const std::uint32_t thing : room.things)
                    room.scene.instances[thing].present = present;
                update_flat(room.scene, room.flat);
                renderer.update_scene();
                renderer.move_camera(test::room_camera());
                EXPECT_TRUE(renderer.render_frame({}));
                return renderer.image();
            };
            const Image with = image(true);
            const Image without = image(false);
            EXPECT_GT(test::differing_values(with, without), 0U);
            EXPECT_EQ(test::differing_values(with, image(true)), 0U)
                << test::backend_name(backend) << ", room " << which;
            EXPECT_EQ(test::differing_values(without, image(false)), 0U);
        }
}

TEST(MovingScene, ThingsAreWhereTheirNodesAre) {
    // As if the scene had been modelled that way: triangles only have other numbers.
    Scene modelled = sliding_room();
    hold_still(modelled);
    for (Instance& instance : modelled.instances)
        if (instance.mesh + 1 == modelled.meshes.size()) instance.to_world[3].x += 0.4;
    const test::Rendering expected =
        test::render(TestBackend::own_bvh, modelled, test::room_camera(), igi_settings());
    const Image image = frame_after({0, 4}, TestBackend::own_bvh);
    for (const char* const layer : {"direct", "indirect", "albedo", "depth"})
        EXPECT_LT(test::relative_mse(expected.layer(layer), image.find(layer)->values), 1e-8)
            << layer;
}

TEST(MovingScene, PathTracingFollowsAsWell) {
    const auto render = [](std::uint32_t first) {
        MovingScene moving(sliding_room(), {}, 1.0);
        moving.set_frame(first);
        PathSettings settings;
        settings.width = 24;
        settings.height = 18;
        settings.samples = {0, 2};
        PathRenderer renderer(test::shared_executor(TestBackend::own_bvh), moving.flat(),
                              test::room_camera(), settings, {});
        if (first != 4) {
            moving.set_frame(4);
            renderer.update_scene();
            renderer.set_camera(test::room_camera());
        }
        while (renderer.render_frame({})) {
        }
        return renderer.image();
    };
    EXPECT_EQ(test::differing_values(render(4), render(0)), 0U);
}

TEST(MovingScene, ASceneThatRestsPaysNothing) {
    Scene still = sliding_room();
    hold_still(still);
    MovingScene moving(still, {}, 30.0);
    EXPECT_FALSE(moving.moves());
    EXPECT_EQ(moving.flat().first_moving_triangle, moving.flat().triangles.size());
    moving.set_frame(10);
    const FlatScene flat = flatten(still);
    EXPECT_EQ(moving.flat().extent, flat.extent);
    EXPECT_EQ(moving.flat().radius, flat.radius);
}

TEST(MovingScene, UnusableTransformsAreRefusedAndTheFrameBeforeStaysValid) {
    struct Case {
        const char* text;
        std::vector<float> scales;  ///< of the node at 0 s and 2 s
    };
    const Case cases[] = {{"inverted", {1, 1, 1, 0, 0, 0}},
                          {"inverted", {1, 1, 1, 1, 0, 1}},
                          {"finite", {1, 1, 1, 3e38F, 3e38F, 3e38F}},
                          {"too far", {1, 1, 1, 1e20F, 1, 1}}};
    for (const Case& wrong : cases) {
        Scene scene = sliding_room();
        KeyTrack track;
        track.interpolation = Interpolation::step;
        track.times = {0.0F, 2.0F};
        track.values = wrong.scales;
        scene.animation.tracks.push_back(track);
        scene.animation.nodes[0].scale = 1;
        // Squares of numbers that are too large for doubles.
        if (std::string(wrong.text) == "finite")
            for (int i = 0; i < 8; ++i) {
                MovingNode node = scene.animation.nodes[0];
                node.parent = i;
                scene.animation.nodes.push_back(node);
                scene.instances.back().motion.node = i + 1;
            }
        MovingScene moving(scene, {}, 1.0);
        moving.set_frame(1);
        const FlatScene before = moving.flat();
        try {
            moving.set_frame(2);
            ADD_FAILURE() << wrong.text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find("in frame 2"), std::string::npos)
                << error.what();
        }
        for (std::size_t i = 0; i < before.positions.size(); ++i) {
            EXPECT_EQ(before.positions[i].x, moving.flat().positions[i].x);
            EXPECT_EQ(before.positions[i].y, moving.flat().positions[i].y);
        }
        Renderer renderer(test::shared_executor(TestBackend::own_bvh), moving.flat(),
                          test::room_camera(), igi_settings());
        EXPECT_TRUE(renderer.render_frame({}));
    }
}

TEST(MovingScene, LightsMoveWithTheirNodes) {
    Scene scene = test::moving_room(1).scene;
    scene.animation.nodes.push_back(test::sliding_node(scene));
    scene.lights[0].motion = {0, glm::dmat4(1.0)};
    Scene posed = scene;
    pose_scene(scene, 5.0, posed);
    EXPECT_NEAR(posed.lights[0].position.x, 0.5, 1e-12);
    EXPECT_NEAR(posed.lights[0].direction.z, -1.0, 1e-12);
    EXPECT_TRUE(is_animated(scene));
}

TEST(MovingScene, LightsMayGoOutAndComeOn) {
    // An area light that is dark at first: the renderer builds what it needs when it shines.
    test::MovingRoom room = test::moving_room(0);
    const Scene lit = room.scene;
    for (Material& material : room.scene.materials) material.emission.radiance = glm::vec3(0.0F);
    room.flat = flatten(room.scene);
    Renderer renderer(test::shared_executor(TestBackend::own_bvh), room.flat, test::room_camera(),
                      igi_settings());
    EXPECT_TRUE(renderer.render_frame({}));
    EXPECT_EQ(test::mean_of(renderer.image().find("direct")->values), 0.0);
    for (const bool shines : {true, false, true}) {
        update_flat(lit, room.flat);
        Scene scene = lit;
        if (!shines)
            for (Material& material : scene.materials) material.emission.radiance = glm::vec3(0.0F);
        update_flat(scene, room.flat);
        renderer.update_scene();
        renderer.move_camera(test::room_camera());
        EXPECT_TRUE(renderer.render_frame({}));
        EXPECT_EQ(test::mean_of(renderer.image().find("direct")->values) > 0.0, shines);
        EXPECT_EQ(test::mean_of(renderer.image().find("indirect")->values) > 0.0, shines);
    }
}

}  // namespace
}  // namespace weft::moving_scene_test
