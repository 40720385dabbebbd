// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A floor without interreflection under lights whose irradiance is known in closed form.
#ifndef WEFT_SELFTEST_FLOOR_SCENES_H
#define WEFT_SELFTEST_FLOOR_SCENES_H

#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "scene/shapes.h"
#include "selftest/scene_builder.h"

namespace weft::selftest {

inline const glm::vec3 receiver_albedo{0.8F, 0.5F, 0.25F};
inline const glm::vec3 radiance{1.0F, 2.0F, 0.5F};  ///< of the lights

/// Position of the camera relative to the floor point that it sees: near enough to stay below the
/// lights.
inline const glm::dvec3 eye_offset{0.05, -0.1, 0.2};

/// A floor z = 0 of edge 6.
inline SceneBuilder floor_scene() {
    SceneBuilder builder;
    builder.add(quad_mesh({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), builder.material(receiver_albedo));
    return builder;
}

inline std::vector<glm::dvec3> corners_of(const Mesh& quad) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(quad.positions.at(i)); };
    return {corner(0), corner(1), corner(3), corner(2)};
}

/// The unit square at height 1 that shines down.
inline Mesh area_light_mesh() {
    return quad_mesh({-0.5F, -0.5F, 1.0F}, {0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F});
}

/// Two parallelograms over the floor, neither of them level.
inline std::vector<Mesh> tilted_parallelograms() {
    return {quad_mesh({0.4F, -0.2F, 0.6F}, {0.1F, 0.3F, 0.4F}, {0.5F, -0.2F, 0.1F}),
            quad_mesh({-1.5F, 0.5F, 0.3F}, {1.2F, 0.4F, 0.0F}, {0.0F, 0.1F, 1.4F})};
}

/// A scene and the irradiance of the floor at the origin, by the light's true shape.
struct LitFloor {
    Scene scene;
    glm::dvec3 irradiance;
    double bias;  ///< relative error of the irradiance by the mesh instead of that shape
};

/// A disk that faces the origin from above.
inline LitFloor disk_over_floor() {
    SceneBuilder builder = floor_scene();
    const double radius = 0.6;
    const double height = 0.8;
    glm::dmat4 down = placement(radius, {0.0, 0.0, height});
    down[1] = -down[1];
    down[2] = -down[2];
    builder.add(make_disk(), builder.material(glm::vec3(0.0F), radiance), down);
    const double of_one = std::numbers::pi * radius * radius / (radius * radius + height * height);
    // 128 chords leave out 1 - sinc(2 pi / 128) = 4e-4 of the disk.
    return {std::move(builder.scene), of_one * glm::dvec3(radiance), 5e-4};
}

/// A sphere wholly above the horizon, off the axis.
inline LitFloor sphere_over_floor() {
    SceneBuilder builder = floor_scene();
    const double radius = 0.4;
    const glm::dvec3 centre(0.5, -0.3, 1.1);
    builder.add(icosphere(4, false), builder.material(glm::vec3(0.0F), radiance),
                placement(radius, centre));
    const double distance = glm::length(centre);
    const double of_one =
        std::numbers::pi * radius * radius / (distance * distance) * (centre.z / distance);
    // Triangles with edges of 0.075 radii lie up to 1e-3 radii inside: the outline loses about as
    // much of its radius.
    return {std::move(builder.scene), of_one * glm::dvec3(radiance), 2e-3};
}

}  // namespace weft::selftest

#endif
