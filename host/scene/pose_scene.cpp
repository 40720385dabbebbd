// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/pose_scene.h"

#include <algorithm>

namespace weft {

bool is_animated(const Scene& scene) {
    const auto moves = [](const auto& thing) { return thing.motion.moves(); };
    return std::any_of(scene.instances.begin(), scene.instances.end(), moves) ||
           std::any_of(scene.lights.begin(), scene.lights.end(), moves);
}

void hold_still(Scene& scene) {
    for (Instance& instance : scene.instances) {
        instance.may_move = false;
        instance.motion = {};
    }
    for (PunctualLight& light : scene.lights) light.motion = {};
}

void pose_scene(const Scene& rest, double time, Scene& posed) {
    posed.instances = rest.instances;
    posed.lights = rest.lights;
    posed.materials = rest.materials;
    for (Instance& instance : posed.instances)
        if (instance.motion.moves())
            instance.to_world = to_world_at(rest.animation, instance.motion, time);
    for (PunctualLight& light : posed.lights) {
        if (!light.motion.moves()) continue;
        const glm::dmat4 to_world = to_world_at(rest.animation, light.motion, time);
        light.position = glm::dvec3(to_world[3]);
        light.direction = -glm::normalize(glm::dvec3(to_world[2]));
    }
}

}  // namespace weft
