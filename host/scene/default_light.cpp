// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/default_light.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr float sky_radiance = 0.28F;
constexpr float key_irradiance = 1.5F;

/// Unit vector to the key light.
glm::dvec3 key_direction(const Scene& scene) {
    if (scene.cameras.empty()) return glm::normalize(glm::dvec3(-0.2, 1.0, 0.7));
    const Camera& camera = scene.cameras.front();
    const glm::dmat3 axes(camera.to_world);
    const double left = camera.mirror_x ? 1.0 : -1.0;
    return glm::normalize(left * 0.5 * glm::normalize(axes[0]) + 0.9 * glm::normalize(axes[1]) +
                          0.7 * glm::normalize(axes[2]));
}

/// Whether a medium that is somewhere in the scene emits light.
bool media_emit(const Scene& scene) {
    const auto emits = [&](int medium) {
        return medium >= 0 &&
               scene.media[static_cast<std::size_t>(medium)].emission != glm::vec3(0.0F);
    };
    return emits(scene.outer_medium) || emits(scene.camera_medium) ||
           std::any_of(scene.medium_boundaries.begin(), scene.medium_boundaries.end(),
                       [&](const MediumBoundary& boundary) {
                           return emits(boundary.interior) || emits(boundary.exterior);
                       });
}

}  // namespace

bool has_light(const Scene& scene) {
    return scene.light_named || !scene.lights.empty() || scene.environment ||
           std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& instance) {
                           return scene.materials[instance.material].emission.radiance !=
                                  glm::vec3(0.0F);
                       }) ||
           media_emit(scene);
}

void add_default_light(Scene& scene, Diagnostics& diagnostics) {
    if (has_light(scene) || scene.instances.empty()) return;
    const glm::dvec3 to_light = key_direction(scene);
    if (!std::isfinite(glm::dot(to_light, to_light))) return;
    scene.environment = Environment{glm::vec3(sky_radiance)};
    PunctualLight key;
    key.name = "default key light";
    key.type = LightType::directional;
    key.direction = -to_light;
    key.intensity = glm::vec3(key_irradiance);
    scene.lights.push_back(key);
    diagnostics.warn(scene.source, "no light, a grey sky and a distant light from above are used");
}

}  // namespace weft
