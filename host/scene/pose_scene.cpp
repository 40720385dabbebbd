// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/pose_scene.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace weft {
namespace {

template <typename T>
const T& at(const std::vector<T>& values, int index) {
    return values[static_cast<std::size_t>(index)];
}

std::vector<double> weights_at(const Scene& scene, const Deformation& deformation, double time) {
    if (deformation.weights_track < 0) return deformation.weights;
    return numbers_at(at(scene.animation.tracks, deformation.weights_track), time);
}

void deform_meshes(const Scene& rest, double time, Scene& posed) {
    if (rest.deformations.empty()) return;
    const std::vector<glm::dmat4> nodes = nodes_to_world_at(rest.animation, time);
    std::vector<std::vector<glm::dmat4>> joints;
    for (const Skin& skin : rest.skins) joints.push_back(joint_matrices(skin, nodes));
    std::vector<bool> mirrored;
    for (const Deformation& deformation : rest.deformations) {
        Mesh& mesh = posed.meshes[deformation.mesh];
        std::span<const glm::dmat4> carriers;
        if (deformation.skin >= 0) carriers = at(joints, deformation.skin);
        mirrored.push_back(
            deform(*deformation.shape, weights_at(rest, deformation, time), carriers, mesh));
    }
    for (Instance& instance : posed.instances)
        if (instance.deformation >= 0)
            instance.flip_normals = mirrored[static_cast<std::size_t>(instance.deformation)];
}

}  // namespace

bool is_animated(const Scene& scene) {
    const auto moves = [](const auto& thing) { return thing.motion.moves(); };
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& instance) {
                           return moves(instance) || instance.deformation >= 0;
                       }) ||
           std::any_of(scene.lights.begin(), scene.lights.end(), moves);
}

void hold_still(Scene& scene) {
    for (Instance& instance : scene.instances) {
        instance.may_move = false;
        instance.motion = {};
        instance.deformation = -1;
    }
    scene.deformations.clear();
    scene.skins.clear();
    for (PunctualLight& light : scene.lights) light.motion = {};
}

void pose_scene(const Scene& rest, double time, Scene& posed) {
    posed.instances = rest.instances;
    posed.lights = rest.lights;
    posed.materials = rest.materials;
    posed.environment = rest.environment;
    for (Instance& instance : posed.instances)
        if (instance.motion.moves())
            instance.to_world = to_world_at(rest.animation, instance.motion, time);
    for (PunctualLight& light : posed.lights) {
        if (!light.motion.moves()) continue;
        const glm::dmat4 to_world = to_world_at(rest.animation, light.motion, time);
        light.position = glm::dvec3(to_world[3]);
        light.direction = -glm::normalize(glm::dvec3(to_world[2]));
    }
    deform_meshes(rest, time, posed);
}

}  // namespace weft
