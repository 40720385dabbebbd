// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/default_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/emission_means.h"

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

/// Mean radiance that surfaces emit over all their area, the largest channel.
double mean_emission(const Scene& scene) {
    double all = 0.0;
    glm::dvec3 emitted(0.0);
    EmissionMeans emission_means(scene);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Emission& emission = scene.materials[instance.material].emission;
        std::vector<glm::vec3> means;
        if (emission.texture >= 0) means = emission_means.of(mesh, emission.texture);
        const double sides = emission.both_sides ? 2.0 : 1.0;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto corner = [&](std::size_t k) {
                const glm::vec3& p = mesh.positions[mesh.triangles[i][k]];
                return glm::dvec3(instance.to_world * glm::dvec4(glm::dvec3(p), 1.0));
            };
            const glm::dvec3 a = corner(0);
            const double area = glm::length(glm::cross(corner(1) - a, corner(2) - a));
            const glm::vec3 mean = means.empty() ? glm::vec3(1.0F) : means[i];
            all += area;
            emitted += sides * area * glm::dvec3(emission.radiance) * glm::dvec3(mean);
        }
    }
    if (!(all > 0.0)) return 0.0;
    emitted /= all;
    return std::max({emitted.r, emitted.g, emitted.b});
}

bool is_named(const Scene& scene) {
    return scene.light_named || !scene.lights.empty() || scene.environment || media_emit(scene);
}

}  // namespace

OwnLight own_light(const Scene& scene) {
    if (is_named(scene)) return OwnLight::named;
    bool emits = false;
    for (const Instance& instance : scene.instances) {
        const Emission& emission = scene.materials[instance.material].emission;
        const float most =
            std::max({emission.radiance.r, emission.radiance.g, emission.radiance.b});
        if (most > 1.0F && emission.texture < 0) return OwnLight::emission;
        emits |= most > 0.0F;
    }
    if (!emits) return OwnLight::none;
    constexpr double albedo = 0.5;
    constexpr double least = 0.1;
    return albedo * mean_emission(scene) < least ? OwnLight::faint : OwnLight::emission;
}

void add_default_light(Scene& scene, DefaultLight choice, Diagnostics& diagnostics) {
    if (scene.instances.empty()) return;
    const OwnLight own = own_light(scene);
    const bool lit = own == OwnLight::named || own == OwnLight::emission;
    if (choice == DefaultLight::never && own == OwnLight::none)
        diagnostics.warn(scene.source, "no light, which --light none leaves so: the image is dark");
    if (choice == DefaultLight::never || (choice == DefaultLight::as_needed && lit)) return;
    const glm::dvec3 to_light = key_direction(scene);
    if (!std::isfinite(glm::dot(to_light, to_light))) return;
    // A sky of the file stays what it is.
    if (!scene.environment) {
        scene.environment = Environment{glm::vec3(sky_radiance)};
        scene.default_sky = true;
    }
    PunctualLight key;
    key.name = "default key light";
    key.type = LightType::directional;
    key.direction = -to_light;
    key.intensity = glm::vec3(key_irradiance);
    scene.lights.push_back(key);
    scene.default_light = true;
    const char* const why = own == OwnLight::faint ? "its emission lights too little to see by, so "
                                                   : (own == OwnLight::none ? "no light, so " : "");
    const char* const how = choice == DefaultLight::always ? "" : " (--light none leaves them out)";
    diagnostics.warn(
        scene.source,
        fmt::format("{}a grey sky and a distant light from above are added{}", why, how));
}

}  // namespace weft
