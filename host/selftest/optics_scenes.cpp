// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/optics_scenes.h"

#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <span>

namespace weft::selftest {
namespace {

constexpr double ray_angle = 1e-5;  // of the view, so that all of it is one ray
constexpr float mirror_share = 0.9F;

/// The direction of a ray that travels along `along` behind a boundary with the normal `normal`,
/// both unit vectors, by Snell's law for the indices before it and beyond.
glm::dvec3 refracted(const glm::dvec3& along, const glm::dvec3& normal, double before,
                     double beyond) {
    const glm::dvec3 facing = glm::dot(along, normal) < 0.0 ? normal : -normal;
    const glm::dvec3 sideways = (along - facing * glm::dot(along, facing)) * (before / beyond);
    return sideways - facing * std::sqrt(1.0 - glm::dot(sideways, sideways));
}

/// A prism whose base is a convex polygon in the plane y = 0, counter-clockwise seen from -y, which
/// reaches from y = -1 to y = 1.
Mesh prism_mesh(std::span<const glm::dvec2> corners) {
    Mesh mesh;
    const auto count = static_cast<std::uint32_t>(corners.size());
    for (const double y : {-1.0, 1.0})
        for (const glm::dvec2& c : corners) mesh.positions.emplace_back(c.x, y, c.y);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        mesh.triangles.push_back({i, count + next, next});
        mesh.triangles.push_back({i, count + i, count + next});
        if (i < 2) continue;
        mesh.triangles.push_back({0, i - 1, i});
        mesh.triangles.push_back({count, count + i, count + i - 1});
    }
    return mesh;
}

/// Adds a square of radiance 1 that faces a ray along `along` at `centre`.
void add_target(SceneBuilder& builder, const glm::dvec3& centre, const glm::dvec3& along,
                double half_width) {
    const glm::dvec3 u = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), along));
    const glm::dvec3 v = glm::cross(u, along);
    builder.add(quad_mesh(glm::vec3(centre - half_width * (u + v)), glm::vec3(2.0 * half_width * u),
                          glm::vec3(2.0 * half_width * v)),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
}

/// Adds the things in the cell of the box that lies `cell` cells away, dimmed.
void add_shining_things(SceneBuilder& builder, const glm::ivec3& cell, float share) {
    const Mesh things[] = {quad_mesh({-0.6F, -0.5F, -0.4F}, {0.5F, 0.1F, 0}, {0, 0.7F, 0.2F}),
                           quad_mesh({0.3F, -0.7F, 0.2F}, {0, 0, -0.6F}, {0.2F, 0.6F, 0}),
                           quad_mesh({-0.2F, 0.6F, 0.3F}, {0.3F, 0, 0.3F}, {0.4F, 0.1F, -0.2F})};
    const glm::vec3 colours[] = {{1.0F, 0.3F, 0.2F}, {0.2F, 0.8F, 0.4F}, {0.3F, 0.4F, 1.0F}};
    glm::dmat4 place(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        place[axis][axis] = cell[axis] % 2 == 0 ? 1.0 : -1.0;
        place[3][axis] = 2.0 * cell[axis];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t material = builder.material(glm::vec3(0.0F), share * colours[i]);
        builder.scene.materials[material].emission.both_sides = true;
        builder.add(things[i], material, place);
    }
}

}  // namespace

SeenByRay target_behind_a_prism(double aside) {
    constexpr double index = 1.5;
    constexpr double degree = std::numbers::pi / 180.0;
    // The apex is above; a ray from the left meets the left face in its middle.
    const double tangent = std::tan(30.0 * degree);
    const glm::dvec2 corners[] = {{-2.0 * tangent, -1.0}, {2.0 * tangent, -1.0}, {0.0, 1.0}};
    SceneBuilder builder;
    builder.add(prism_mesh(corners), add_surface(builder, glass(index)));
    const glm::dvec3 left(-std::cos(30.0 * degree), 0.0, std::sin(30.0 * degree));
    const glm::dvec3 right(-left.x, 0.0, left.z);
    const glm::dvec3 entry(-tangent, 0.0, 0.0);
    // Turned from the normal by 50 degrees, from the side of the base.
    const double turn = 50.0 * degree;
    const glm::dvec3 up(std::sin(30.0 * degree), 0.0, std::cos(30.0 * degree));
    const glm::dvec3 along = -left * std::cos(turn) + up * std::sin(turn);
    const glm::dvec3 inside = refracted(along, left, 1.0, index);
    const double way =
        glm::dot(glm::dvec3(tangent, 0.0, 0.0) - entry, right) / glm::dot(inside, right);
    const glm::dvec3 exit = entry + inside * way;
    const glm::dvec3 beyond = refracted(inside, right, index, 1.0);
    constexpr double half_width = 0.02;
    const glm::dvec3 across = glm::normalize(glm::cross(beyond, glm::dvec3(0.0, 1.0, 0.0)));
    add_target(builder, exit + 4.0 * beyond + across * (aside * half_width), beyond, half_width);
    const double passes = (1.0 - fresnel_reflectance(1.0, index, -glm::dot(along, left))) *
                          (1.0 - fresnel_reflectance(index, 1.0, glm::dot(inside, right)));
    return {std::move(builder.scene), look_at(entry - 3.0 * along, entry, ray_angle), passes};
}

SeenByRay target_at_a_focus(double index, double farther) {
    constexpr double height = 0.05;
    SceneBuilder builder;
    builder.add(smooth_sphere(5), add_surface(builder, glass(index)));
    const double focus = 0.5 * index / (index - 1.0);
    add_target(builder, {0.0, 0.0, -focus * farther}, {0.0, 0.0, -1.0}, height * height);
    const double cosine = std::sqrt(1.0 - height * height);
    const double passes = 1.0 - fresnel_reflectance(1.0, index, cosine);
    return {std::move(builder.scene), look_at({height, 0.0, 4.0}, {height, 0.0, 0.0}, ray_angle),
            passes * passes};
}

SeenByRay wall_by_total_reflection() {
    const glm::dvec2 corners[] = {{-1.0, -1.0}, {1.0, -1.0}, {-1.0, 1.0}};
    SceneBuilder builder;
    builder.add(prism_mesh(corners), add_surface(builder, glass(1.5)));
    builder.add(quad_mesh({-4, -5, -5}, {0, 10, 0}, {0, 0, 10}),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    builder.add(quad_mesh({-3, -5, 4}, {0, 10, 0}, {8, 0, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(1000.0F)));
    return {std::move(builder.scene), look_at({-0.2, 0.1, -4.0}, {-0.2, 0.1, 0.0}, ray_angle),
            stack_transmittance({{1.5}})};
}

SeenByRay lamp_in_glass(double index) {
    SceneBuilder builder;
    builder.add(quad_mesh({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(2.0F)));
    add_slab(builder, glass(index), -0.5, 0.5);
    return {std::move(builder.scene), oblique_camera(1.0),
            2.0 * (1.0 - fresnel_reflectance(1.0, index, 1.0)) / (index * index)};
}

WaterInGlass water_in_glass(double overlap) {
    constexpr double thickness = 0.3;
    constexpr double inner = 0.2;  // height of each glass above the middle
    const glm::vec3 colour(0.9F, 0.5F, 0.7F);
    SceneBuilder builder = bright_wall();
    const SurfaceDescription walls = absorbing_glass(1.5F, colour, thickness);
    add_slab(builder, walls, inner, inner + thickness);
    add_slab(builder, walls, -inner - thickness, -inner);
    add_slab(builder, glass(1.33), -inner - overlap, inner + overlap);
    glm::dvec3 radiance;
    for (int c = 0; c < 3; ++c) {
        const Layer1d wall{1.5, static_cast<double>(colour[c])};
        radiance[c] = overlap < 0.0 ? stack_transmittance({wall, {1.0}, {1.33}, {1.0}, wall})
                                    : stack_transmittance({wall, {1.33}, wall});
    }
    return {std::move(builder.scene), radiance};
}

Scene box_of_mirrors() {
    SceneBuilder builder;
    builder.add(room_mesh(), add_surface(builder, grey_mirror(mirror_share)));
    add_shining_things(builder, {0, 0, 0}, 1.0F);
    return std::move(builder.scene);
}

Scene unfolded_box_of_mirrors() {
    SceneBuilder builder;
    constexpr int most = static_cast<int>(most_mirrors);
    for (int x = -most; x <= most; ++x)
        for (int y = -most; y <= most; ++y)
            for (int z = -most; z <= most; ++z) {
                const int mirrors = std::abs(x) + std::abs(y) + std::abs(z);
                if (mirrors > most) continue;
                add_shining_things(builder, {x, y, z}, std::pow(mirror_share, float(mirrors)));
            }
    return std::move(builder.scene);
}

Camera camera_among_mirrors() {
    return look_at({0.85, 0.1, 0.9}, {-0.3, -0.1, -0.2}, 1.4);
}

}  // namespace weft::selftest
