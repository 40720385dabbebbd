// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_MOVING_ROOM_H
#define WEFT_SELFTEST_MOVING_ROOM_H

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "scene/flat_scene.h"
#include "selftest/scene_builder.h"

namespace weft::selftest {

/// A scene with objects that may move, and its flattened form.
struct MovingRoom {
    Scene scene;
    FlatScene flat;
    std::vector<std::uint32_t> things;  ///< instances that may move

    void move(std::size_t thing, const glm::dvec3& by) {
        glm::dmat4& to_world = scene.instances[things[thing]].to_world;
        to_world[3] += glm::dvec4(by, 0.0);
    }

    /// Makes a random edit of any kind; returns its name.
    std::string edit(std::mt19937& random) {
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        const auto pick = [&](std::size_t count) { return random() % count; };
        const auto colour = [&] {
            const auto value = [&] { return static_cast<float>(0.5 + 0.45 * uniform(random)); };
            const float r = value();
            const float g = value();
            return glm::vec3(r, g, value());
        };
        Instance& thing = scene.instances[things[pick(things.size())]];
        switch (pick(9)) {
            case 0: {
                const double x = uniform(random);
                const double y = uniform(random);
                thing.to_world[3] = glm::dvec4(0.7 * x, 0.7 * y, 0.7 * uniform(random), 1.0);
                return "move";
            }
            case 8:
                // Half of the object lies in the floor, where records are.
                thing.to_world[3].y = -1.0;
                return "touch the floor";
            case 1:
                thing.to_world[3] += glm::dvec4(0.02 * uniform(random), 0.0, 0.0, 0.0);
                return "nudge";
            case 2: {
                const double angle = 3.0 * uniform(random);
                glm::dmat4 turn(1.0);
                turn[0] = {std::cos(angle), 0.0, -std::sin(angle), 0.0};
                turn[2] = {std::sin(angle), 0.0, std::cos(angle), 0.0};
                thing.to_world = thing.to_world * turn;
                return "rotate";
            }
            case 3: {
                const double factor = std::exp2(0.3 * uniform(random));
                for (int column = 0; column < 3; ++column) {
                    thing.to_world[column] *= factor;
                    const double length = glm::length(glm::dvec3(thing.to_world[column]));
                    if (length > 1.2 || length < 0.2) thing.to_world[column] *= 0.5 / length;
                }
                return "scale";
            }
            case 4:
                thing.present = !thing.present;
                return "come or go";
            case 5: {
                Material& material = scene.materials[pick(scene.materials.size())];
                set_diffuse_albedo(material, colour());
                return "colour";
            }
            case 6:
                for (Material& material : scene.materials)
                    material.emission.radiance *= static_cast<float>(1.0 + 0.3 * uniform(random));
                for (PunctualLight& light : scene.lights) light.intensity = 2.0F * colour();
                return "light";
            default:
                for (PunctualLight& light : scene.lights)
                    light.position += 0.05 * glm::dvec3(uniform(random), uniform(random), 0.0);
                return "light's place";
        }
    }
};

inline Camera room_camera() {
    return look_at({0.0, 0.0, 3.4}, {0.0, 0.0, 0.0}, 0.75);
}

/// Three rooms that are open to the camera, with a screen and an area light (0), a smooth ball and
/// a point light (1), or a screen, a ball and an area light that moves (2).
inline MovingRoom moving_room(unsigned which) {
    SceneBuilder builder;
    const std::uint32_t white = builder.material({0.7F, 0.7F, 0.7F});
    const std::uint32_t red = builder.material({0.7F, 0.1F, 0.1F});
    const std::uint32_t area_light = builder.material({0.0F, 0.0F, 0.0F}, {9.0F, 9.0F, 9.0F});
    builder.add(quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), white);
    builder.add(quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), red);
    builder.add(quad_mesh({1, -1, -1}, {0, 0, 2}, {0, 2, 0}), white);
    builder.add(quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), white);
    MovingRoom room;
    const auto add_moving = [&](Mesh mesh, std::uint32_t material, double scale,
                                const glm::dvec3& at) {
        room.things.push_back(static_cast<std::uint32_t>(builder.scene.instances.size()));
        builder.add(std::move(mesh), material, placement(scale, at));
        builder.scene.instances.back().may_move = true;
    };
    const Mesh screen = quad_mesh({-0.5F, -0.5F, 0.0F}, {1, 0, 0}, {0, 1, 0});
    Mesh ball = icosphere(1, false);
    ball.normals = ball.positions;
    if (which != 1)
        builder.add(quad_mesh({-0.3F, 0.99F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}), area_light);
    if (which != 0) add_moving(ball, white, 0.3, {-0.4, -0.6, 0.1});
    if (which != 1) add_moving(screen, white, 0.7, {0.3, -0.5, 0.2});
    if (which == 1) builder.light(LightType::point, {0.2, 0.6, 0.3}, glm::vec3(1.0F));
    if (which == 2)
        add_moving(quad_mesh({0, 0, 0}, {0, 0, 0.5F}, {0.5F, 0, 0}), area_light, 0.6,
                   {-0.8, 0.8, 0.0});
    room.scene = builder.scene;
    room.scene.materials[area_light].emission.both_sides = which == 2;
    room.flat = flatten(room.scene);
    return room;
}

}  // namespace weft::selftest

#endif
