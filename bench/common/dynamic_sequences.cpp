// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/dynamic_sequences.h"

#include <array>
#include <cmath>
#include <utility>

namespace weft::bench {
namespace {

// Of the distance from the camera to what it looks at.
constexpr double box_distance = 0.75;
constexpr double box_edge = 0.08;
constexpr double box_step = 0.01;

constexpr double degrees_a_frame = 0.25;
constexpr float dimming = 0.97F;  // from frame to frame

/// The unit cube about the origin.
Mesh cube() {
    Mesh mesh;
    mesh.name = "box";
    for (unsigned corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back((corner & 1U) != 0 ? 0.5F : -0.5F,
                                    (corner & 2U) != 0 ? 0.5F : -0.5F,
                                    (corner & 4U) != 0 ? 0.5F : -0.5F);
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& f : faces) {
        mesh.triangles.push_back({f[0], f[1], f[2]});
        mesh.triangles.push_back({f[0], f[2], f[3]});
    }
    return mesh;
}

void add_box(Scene& scene, const glm::dvec3& at, double edge) {
    Material material;
    material.name = "box";
    material.albedo = {0.7F, 0.5F, 0.3F};
    scene.materials.push_back(material);
    scene.meshes.push_back(cube());
    Instance box;
    box.name = "box";
    box.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    box.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    for (int axis = 0; axis < 3; ++axis) box.to_world[axis] *= edge;
    box.to_world[3] = glm::dvec4(at, 1.0);
    box.may_move = true;
    scene.instances.push_back(box);
}

}  // namespace

const char* to_string(Happening happening) {
    switch (happening) {
        case Happening::box:
            return "box";
        case Happening::lamp:
            return "lamp";
        case Happening::camera:
            return "camera";
        case Happening::still:
            return "still";
    }
    return "";
}

const std::vector<Happening>& all_happenings() {
    static const std::vector<Happening> all{Happening::box, Happening::lamp, Happening::camera,
                                            Happening::still};
    return all;
}

DynamicSequence::DynamicSequence(Scene scene, const Camera& camera, const glm::dvec3& middle,
                                 Happening happening)
    : first_(std::move(scene)), camera_(camera), happening_(happening) {
    for (Instance& instance : first_.instances) instance.may_move = false;
    if (happening == Happening::box) {
        const glm::dvec3 eye(camera.to_world[3]);
        const double distance = glm::length(middle - eye);
        const glm::dvec3 right = glm::normalize(glm::dvec3(camera.to_world[0]));
        step_ = right * (box_step * distance);
        add_box(first_, eye + (middle - eye) * box_distance - 6.0 * step_, box_edge * distance);
    }
    now_ = first_;
}

const Scene& DynamicSequence::at(std::uint32_t frame) {
    if (happening_ == Happening::box)
        now_.instances.back().to_world[3] = first_.instances.back().to_world[3] +
                                            glm::dvec4(step_ * static_cast<double>(frame), 0.0);
    if (happening_ != Happening::lamp) return now_;
    const float factor = std::pow(dimming, static_cast<float>(frame));
    const glm::vec3 tint(factor, factor * factor, factor * factor);
    for (std::size_t i = 0; i < now_.materials.size(); ++i)
        now_.materials[i].emission = first_.materials[i].emission * tint;
    for (std::size_t i = 0; i < now_.lights.size(); ++i)
        now_.lights[i].intensity = first_.lights[i].intensity * tint;
    return now_;
}

Camera DynamicSequence::camera_at(std::uint32_t frame) const {
    Camera camera = camera_;
    if (happening_ != Happening::camera) return camera;
    constexpr double radians = 3.14159265358979 / 180.0;
    const double angle = degrees_a_frame * radians * frame;
    const glm::dvec4 x = camera_.to_world[0];
    const glm::dvec4 z = camera_.to_world[2];
    camera.to_world[0] = x * std::cos(angle) - z * std::sin(angle);
    camera.to_world[2] = x * std::sin(angle) + z * std::cos(angle);
    return camera;
}

}  // namespace weft::bench
