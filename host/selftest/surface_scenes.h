// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Mirrors, glass and sheets, and scenes of them whose light is known in closed form.
#ifndef WEFT_SELFTEST_SURFACE_SCENES_H
#define WEFT_SELFTEST_SURFACE_SCENES_H

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "scene/surface/surface_description.h"
#include "selftest/scene_builder.h"

namespace weft::selftest {

/// Adds a material with that description; returns its index.
inline std::uint32_t add_surface(SceneBuilder& builder, const SurfaceDescription& description,
                                 const glm::vec3& emission = glm::vec3(0.0F)) {
    const std::uint32_t number = builder.material(glm::vec3(0.5F), emission);
    builder.scene.materials[number].description = description;
    return number;
}

/// A metal of that colour; a roughness of 0 is a mirror.
inline SurfaceDescription metal(float roughness, const glm::vec3& colour = glm::vec3(1.0F)) {
    MetallicSurface surface;
    surface.base_colour.factor = colour;
    surface.metallic.factor = 1.0F;
    surface.roughness.value.factor = roughness;
    return {surface, {}, {}};
}

/// A mirror that reflects the same share from all directions.
inline SurfaceDescription grey_mirror(float reflectance) {
    ConductorSurface surface;
    surface.reflectance.factor = glm::vec3(reflectance);
    return {surface, {}, {}};
}

/// Clear, smooth and solid.
inline SurfaceDescription glass(double inside, double outside = 1.0) {
    DielectricSurface surface;
    surface.ior_inside = inside;
    surface.ior_outside = outside;
    return {surface, {}, {}};
}

/// Solid glass of which `colour` is left after the way `distance`.
inline SurfaceDescription absorbing_glass(float index, const glm::vec3& colour, double distance,
                                          float roughness = 0.0F) {
    MetallicSurface surface;
    surface.ior = index;
    surface.metallic.factor = 0.0F;
    surface.roughness.value.factor = roughness;
    surface.transmission.factor = 1.0F;
    surface.solid = true;
    surface.absorption.colour = colour;
    surface.absorption.distance = distance;
    return {surface, {}, {}};
}

/// Black where it is there, which is the share `alpha` of it.
inline SurfaceDescription sheet(float alpha) {
    LambertSurface surface;
    surface.colour.factor = glm::vec3(0.0F);
    SurfaceDescription description{surface, {}, {}};
    description.opacity.mode = OpacityMode::blend;
    description.opacity.alpha.factor = alpha;
    return description;
}

/// The unit sphere with the normals of a sphere, outwards.
inline Mesh smooth_sphere(std::uint32_t level) {
    Mesh mesh = icosphere(level, false);
    mesh.normals = mesh.positions;
    return mesh;
}

/// The cube [-1, 1]^3 with normals outwards.
inline Mesh block_mesh() {
    Mesh block = room_mesh();
    for (auto& triangle : block.triangles) std::swap(triangle[1], triangle[2]);
    return block;
}

/// Adds a slab from height `low` to `high` that is so wide that its edges are not seen.
inline void add_slab(SceneBuilder& builder, const SurfaceDescription& surface, double low,
                     double high) {
    glm::dmat4 place = glm::dmat4(1.0);
    place[0][0] = place[1][1] = 30.0;
    place[2][2] = 0.5 * (high - low);
    place[3][2] = 0.5 * (high + low);
    builder.add(block_mesh(), add_surface(builder, surface), place);
}

/// Nothing but a wall of radiance 1 at z = -3, seen from above.
inline SceneBuilder bright_wall() {
    SceneBuilder builder;
    builder.add(quad_mesh({-40, -40, -3}, {80, 0, 0}, {0, 80, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    return builder;
}

/// A slab of thickness 0.2 before a wall of radiance 1; all else is black.
inline Scene slab_before_a_wall(const SurfaceDescription& surface) {
    SceneBuilder builder = bright_wall();
    add_slab(builder, surface, -0.1, 0.1);
    return std::move(builder.scene);
}

/// A camera above the origin that looks at it from an angle with that cosine to the axis z, with a
/// view so narrow that all of its rays are the same.
inline Camera oblique_camera(double cosine) {
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return look_at({5.0 * sine, 0.0, 5.0 * cosine}, {0.0, 0.0, 0.0}, 1e-3);
}

/// Share of unpolarised light that a boundary reflects, from the index `before` to `beyond`
/// (Fresnel 1823).
inline double fresnel_reflectance(double before, double beyond, double cosine) {
    const double sine = before / beyond * std::sqrt((1.0 - cosine) * (1.0 + cosine));
    if (sine >= 1.0) return 1.0;
    const double other = std::sqrt((1.0 - sine) * (1.0 + sine));
    const double s = (before * cosine - beyond * other) / (before * cosine + beyond * other);
    const double p = (beyond * cosine - before * other) / (beyond * cosine + before * other);
    return 0.5 * (s * s + p * p);
}

/// A layer of a stack: its index, and the share of light that is left after one way through it.
struct Layer1d {
    double index;
    double left = 1.0;
};

/// Share of the light that a stack of parallel layers in air lets pass, with all reflections
/// between boundaries, which are thick enough not to interfere: boundaries are added one by one
/// (Stokes 1862). `cosine` is that of the way through air.
inline double stack_transmittance(const std::vector<Layer1d>& layers, double cosine = 1.0) {
    double passes = 1.0;     // of light from the first side
    double reflected = 0.0;  // of light from the last side
    Layer1d before{1.0};
    for (std::size_t i = 0; i <= layers.size(); ++i) {
        const Layer1d beyond = i < layers.size() ? layers[i] : Layer1d{1.0};
        const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine)) / before.index;
        const double f =
            fresnel_reflectance(before.index, beyond.index, std::sqrt((1.0 - sine) * (1.0 + sine)));
        const double back = reflected * before.left * before.left;
        const double rest = 1.0 / (1.0 - back * f);
        passes *= before.left * (1.0 - f) * rest;
        reflected = f + (1.0 - f) * (1.0 - f) * back * rest;
        before = beyond;
    }
    return passes;
}

}  // namespace weft::selftest

#endif
