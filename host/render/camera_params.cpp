// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/camera_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "plan/halton.h"
#include "render/automatic_camera.h"
#include "scene/field_of_view.h"
#include "scene/validate_scene.h"

namespace weft {
namespace {

shared::float4 to_float4(const glm::dvec3& v) {
    const glm::vec3 f(v);
    return {f.x, f.y, f.z, 0.0F};
}

}  // namespace

shared::RenderParams scene_params(const FlatScene& scene, const Camera& camera, std::uint32_t width,
                                  std::uint32_t height) {
    shared::RenderParams params{};
    params.camera.width = width;
    params.camera.height = height;
    set_camera(camera, scene.units, params);
    set_scene(scene, params);
    return params;
}

void set_scene(const FlatScene& scene, shared::RenderParams& params) {
    params.scene.environment = {scene.environment.r, scene.environment.g, scene.environment.b,
                                0.0F};
    params.scene.bounding_sphere = {0.0F, 0.0F, 0.0F, scene.radius};
    params.scene.extent = scene.extent;
    params.scene.lights = static_cast<std::uint32_t>(scene.lights.size());
    params.scene.area_lights = scene.area_lights;
    params.scene.delta_lights_first = scene.area_lights;
    params.scene.delta_lights = scene.punctual_lights;
    params.scene.directional_lights_first = scene.area_lights + scene.punctual_lights;
    params.scene.directional_lights = scene.directional_lights;
    params.scene.choice_lights = choice_lights(scene);
}

void set_camera(const Camera& camera, const KernelUnits& units, shared::RenderParams& params) {
    const glm::dmat3 axes(camera.to_world);
    const glm::dvec3 forward = glm::normalize(-axes[2]);
    const glm::dvec3 right = glm::normalize(axes[0] - glm::dot(axes[0], forward) * forward);
    const glm::dvec3 up = glm::normalize(axes[1] - glm::dot(axes[1], forward) * forward -
                                         glm::dot(axes[1], right) * right);
    const double aspect = static_cast<double>(params.camera.width) / params.camera.height;
    // Half the height of the image at the distance 1, or at any.
    const double tangent = camera.orthographic() ? half_height(camera, aspect) * units.scale
                                                 : vertical_tangent(camera, aspect);
    params.camera.origin = to_float4(units.point(ray_start(camera)));
    if (camera.orthographic())
        params.camera.origin.w = static_cast<float>(camera.near_plane * units.scale);
    params.camera.forward = to_float4(forward);
    params.camera.right = to_float4(right * tangent * aspect * (camera.mirror_x ? -1.0 : 1.0));
    params.camera.up = to_float4(up * tangent);
    params.camera.pixel_angle = static_cast<float>(2.0 * tangent / params.camera.height);
    params.scene.unit = static_cast<float>(units.scale);
}

std::uint32_t pixel_blocks(std::uint32_t width, std::uint32_t height, std::uint32_t lanes) {
    const std::uint32_t columns = shared::pixel_block_width(lanes);
    const std::uint32_t rows = lanes / columns;
    return ((width + columns - 1) / columns) * ((height + rows - 1) / rows);
}

std::uint32_t camera_features(const Camera& camera) {
    return camera.orthographic() ? FEATURE_ORTHOGRAPHIC : 0U;
}

bool starts_in_one_medium(const FlatScene& scene, const Camera& camera, std::uint32_t width,
                          std::uint32_t height) {
    if (!camera.orthographic() || !scene.media.present()) return true;
    const shared::CameraParams params = scene_params(scene, camera, width, height).camera;
    const auto vector = [](const shared::float4& v) { return glm::dvec3(v.x, v.y, v.z); };
    const std::uint32_t around = boundaries_around(scene.media, vector(params.origin));
    for (const double s : {-1.0, 1.0})
        for (const double t : {-1.0, 1.0})
            if (boundaries_around(scene.media, vector(params.origin) + s * vector(params.right) +
                                                   t * vector(params.up)) != around)
                return false;
    return true;
}

void set_jitter(std::uint32_t frame, bool single, std::uint32_t seed,
                shared::RenderParams& params) {
    params.camera.jitter_x = 0.5F;
    params.camera.jitter_y = 0.5F;
    if (single) return;
    const auto shifted = [&](std::uint32_t base, std::uint32_t axis) {
        const double x = shifted_halton(base, frame, shift_of(seed, axis));
        return std::min(static_cast<float>(x), 0.99999994F);
    };
    params.camera.jitter_x = shifted(2, 0);
    params.camera.jitter_y = shifted(3, 1);
}

Camera choose_camera(const Scene& scene, const FlatScene& flat, const std::string& name,
                     Diagnostics& diagnostics, const std::optional<SceneBounds>& bounds) {
    if (!name.empty()) {
        std::string names;
        for (const Camera& camera : scene.cameras) {
            if (camera.name == name) return camera;
            names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", camera.name);
        }
        throw Error(ExitCode::usage,
                    fmt::format("--camera \"{}\" is not in the scene, expected {}", name,
                                names.empty() ? "a scene with cameras" : "one of: " + names));
    }
    if (!scene.cameras.empty()) return scene.cameras.front();
    diagnostics.warn(scene.source, "no camera, one that shows the whole scene is used");
    return automatic_camera(flat, bounds ? *bounds : bounds_of(scene));
}

Camera camera_at(const Scene& scene, const Camera& camera, double time) {
    if (!camera.motion.moves()) return camera;
    Camera placed = camera;
    placed.to_world = to_world_at(scene.animation, camera.motion, time);
    validate_camera(scene, placed, fmt::format("at {:g} s", time));
    return placed;
}

}  // namespace weft
