// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/smoky_room.h"

// Path tracing through media with density grids where the light is known, or is that of a
// homogeneous medium.
//
// Comparisons allow what sidak_limit gives for 400 of them (about 5.2 standard errors), more than
// this file makes; seeds are fixed, and standard errors are bounded.
namespace weft::path_grid_test {
namespace {

using test::add_boundary;
using test::add_grid;
using test::at;
using test::cube_mesh;
using test::foggy_room;
using test::medium_of;
using test::patchy_grid;
using test::Rendering;
using test::room_camera;
using test::SceneBuilder;
using test::TestBackend;
using test::Tolerance;
using test::turned;

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 400;

DensityGrid constant_grid(double density) {
    return make_grid({9, 6, 7}, [&](auto, auto, auto) { return density; });
}

/// Density 1 + z in [-1,1]^3, but constant within half a voxel of the faces.
DensityGrid linear_grid() {
    return make_grid({2, 3, 64}, [](auto, auto, std::uint32_t k) { return 2.0 * (k + 0.5) / 64; });
}

/// Two images of the same light: means of a layer differ by no more than chance explains.
void expect_same_light(const Rendering& a, const Rendering& b, const std::string& layer,
                       double error, const std::string& what) {
    for (std::uint32_t c = 0; c < 3; ++c) {
        const auto of = [&](const Rendering& r) {
            return layer.empty() ? test::beauty_of(r, c) : test::layer_of(r, layer, c);
        };
        const test::Estimate first = of(a);
        const test::Estimate second = of(b);
        test::expect_estimate({first.mean, std::hypot(first.error, second.error)}, second.mean,
                              Tolerance{comparisons, error, 1e-5},
                              what + " " + layer + " channel " + std::to_string(c));
    }
}

TEST(PathGrid, ConstantGridsAreHomogeneousMedia) {
    SceneBuilder fog = foggy_room();
    const glm::dmat4 box = test::placement(0.8, {0.0, 0.1, 0.0});
    add_boundary(fog.scene, cube_mesh(), box, 0);
    // Bounded by the same box, and by its own in a medium that fills the room.
    Scene bounded = fog.scene;
    add_grid(bounded, 0, constant_grid(0.5), test::placement(5.0, {0.0, 0.0, 0.0}));
    bounded.media[0].scale = 2.0F;
    Scene open = fog.scene;
    add_grid(open, 0, constant_grid(4.0), box);
    open.media[0].scale = 0.25F;
    open.medium_boundaries.clear();
    open.outer_medium = 0;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering expected = test::path_image(backend, fog.scene, room_camera(),
                                                    test::path_settings(24, 24, 256, 1));
        for (const Scene* const scene : {&bounded, &open}) {
            const Rendering found = test::path_image(backend, *scene, room_camera(),
                                                     test::path_settings(24, 24, 256, 2));
            // Blue is dim: the standard error of its difference is 2.8 % with these samples.
            expect_same_light(
                found, expected, "", 0.03,
                std::string(test::backend_name(backend)) + (scene == &open ? " open" : " bounded"));
        }
    }
}

TEST(PathGrid, WhiteGridsVanishInTheEnvironment) {
    const glm::vec3 radiance(1.0F, 2.0F, 0.5F);
    for (const auto& [sigma, g] :
         {std::pair{glm::vec3(3.0F), 0.0F}, std::pair{glm::vec3(20.0F), 0.8F},
          std::pair{glm::vec3(0.5F, 2.0F, 8.0F), -0.3F},
          std::pair{glm::vec3(0.0F, 5.0F, 0.0F), 0.0F}}) {
        SceneBuilder builder;
        builder.scene.environment = Environment{radiance};
        builder.scene.media.push_back(medium_of(sigma, glm::vec3(1.0F), g));
        add_grid(builder.scene, 0, patchy_grid(), turned(0.8, {0.1, 0.0, 0.0}));
        add_boundary(builder.scene, test::icosphere(1, false), glm::dmat4(1.0), 0);
        for (const TestBackend backend : test::light_backends())
            for (const double distance : {3.0, 0.4}) {
                const Rendering rendering =
                    test::path_image(backend, builder.scene,
                                     test::look_at({0.0, 0.1, distance}, {0.1, 0.0, -1.0}, 0.5),
                                     test::path_settings(24, 24, 64));
                for (std::uint32_t c = 0; c < 3; ++c)
                    test::expect_estimate(test::beauty_of(rendering, c), at(radiance, c),
                                          Tolerance{comparisons, 0.02, 1e-5},
                                          std::string(test::backend_name(backend)) +
                                              " furnace from " + std::to_string(distance));
            }
    }
}

TEST(PathGrid, LinearSlabsLeaveTheirTransmittance) {
    // An emitting wall behind a slab that absorbs, or scatters and absorbs; seen along the slab's
    // axis, through the whole of it and from its middle. The slab is turned with the camera.
    const glm::vec3 radiance(1.0F, 2.0F, 0.5F);
    const glm::vec3 sigma(0.25F, 1.0F, 2.0F);
    const auto depth_to = [](double z) {  // from -1
        const double edge = 1.0 / 64.0;   // half a voxel
        const double inner = std::clamp(z + 1.0, edge, 2.0 - edge);
        return edge * std::min(z + 1.0, edge) + 0.5 * (inner * inner - edge * edge) +
               (2.0 - edge) * std::max(0.0, z - 1.0 + edge);
    };
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.9, glm::dvec3(1.0, -2.0, 0.3));
    const auto placed = [&](const glm::dvec3& p) { return glm::dvec3(turn * glm::dvec4(p, 1.0)); };
    for (const float albedo : {0.0F, 0.9F})
        for (const double from : {3.0, 0.25}) {
            SceneBuilder builder;
            builder.add(
                test::quad_mesh({-9.0F, -9.0F, -2.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
                builder.material(glm::vec3(0.0F), radiance), turn);
            builder.scene.media.push_back(medium_of(sigma, glm::vec3(albedo)));
            add_grid(builder.scene, 0, linear_grid(), turn);
            builder.scene.outer_medium = 0;
            const double depth = depth_to(std::min(from, 1.0));
            for (const TestBackend backend : test::light_backends()) {
                const Rendering rendering =
                    test::path_image(backend, builder.scene,
                                     test::look_at(placed({0, 0, from}), placed({0, 0, -9}), 1e-4),
                                     test::path_settings(16, 16, 64));
                for (std::uint32_t c = 0; c < 3; ++c) {
                    const double expected = at(radiance, c) * std::exp(-depth * at(sigma, c));
                    test::expect_shine(rendering, c, expected, albedo > 0.0F,
                                       Tolerance{comparisons, 0.1, 1e-5}, 1e-5,
                                       test::backend_name(backend));
                }
            }
        }
}

TEST(PathGrid, LightsShineThroughGrids) {
    // A point light above a floor in a linear grid that absorbs, by ratio tracking.
    const glm::vec3 sigma(0.2F, 1.0F, 3.0F);
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1.0F, -1.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                builder.material(glm::vec3(0.5F)));
    builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.0F)));
    // Density 1 + y.
    add_grid(builder.scene, 0, make_grid({3, 64, 2}, [](auto, std::uint32_t j, auto) {
                 return 2.0 * (j + 0.5) / 64;
             }));
    add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
    PunctualLight light;
    light.intensity = glm::vec3(3.0F);
    light.position = {0.3, 0.2, 0.0};
    builder.scene.lights.push_back(light);
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(
            backend, builder.scene, test::look_at({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 1e-4),
            test::path_settings(16, 16, 64));
        const double d = std::sqrt(0.09 + 1.44);
        // Within half a voxel of the floor the density is 1/64.
        const double edge = 0.5 / 64.0 / 64.0;
        const double to_eye = 0.5 + edge;
        const double to_light = d / 1.2 * (0.5 * 1.44 + edge);
        for (std::uint32_t c = 0; c < 3; ++c)
            test::expect_estimate(test::layer_of(rendering, "direct", c),
                                  0.5 / pi * 3.0 * (1.2 / d) / (d * d) *
                                      std::exp(-(to_eye + to_light) * at(sigma, c)),
                                  Tolerance{comparisons, 0.02, 3e-4}, test::backend_name(backend));
    }
}

/// Light of a square of radiance 1 and of a point of intensity 1 that the ray from the origin along
/// -z receives by single scattering in density 1 + z / 4 of z in [-4, 0], by quadrature.
struct ScatteredOnce {
    double sigma, albedo, g;

    [[nodiscard]] static double depth(double z) {  // from 0 to -z
        return z - z * z / 8.0;
    }
    /// From a point on the ray, in units of the source.
    [[nodiscard]] double from(double t, const glm::dvec3& to) const {
        const double d = glm::length(to);
        const double cosine = glm::dot(to / d, glm::dvec3(0, 0, -1));
        const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
        // Along any line the density is linear too.
        const double mean = 1.0 - t / 4.0 + to.z / 8.0;
        return sigma * albedo * (1.0 - t / 4.0) * phase * std::exp(-sigma * (depth(t) + mean * d)) /
               (d * d);
    }
};

/// The mean of a function over (0, 1).
double mean_over(int steps, const std::function<double(double)>& value) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += value((i + 0.5) / steps);
    return sum / steps;
}

TEST(PathGrid, SingleScattering) {
    const glm::vec3 corner(0.3F, -0.5F, -2.0F);
    const glm::vec3 sigma(0.3F, 1.0F, 2.0F);
    const glm::vec3 albedo(0.8F, 1.0F, 0.5F);
    const glm::dvec3 area_light(0.05, 0.1, -1.5);
    for (const bool area : {true, false})
        for (const float g : {0.0F, 0.7F}) {
            SceneBuilder builder;
            if (area)
                builder.add(test::quad_mesh(corner, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}),
                            builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
            builder.add(
                test::quad_mesh({-0.1F, -0.1F, -3.0F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.2F, 0.0F}),
                builder.material(glm::vec3(0.0F)));
            if (!area) {
                PunctualLight light;
                light.position = area_light;
                builder.scene.lights.push_back(light);
            }
            builder.scene.media.push_back(medium_of(sigma, albedo, g));
            // Densities that are linear from centre to centre, over [-20,20]^2 x [-4.5,0.5].
            add_grid(builder.scene, 0,
                     make_grid({1, 1, 5}, [](auto, auto, std::uint32_t k) { return k / 4.0; }),
                     glm::translate(glm::dmat4(1.0), {0.0, 0.0, -2.0}) *
                         glm::scale(glm::dmat4(1.0), {20.0, 20.0, 2.5}));
            builder.scene.outer_medium = 0;
            PathSettings settings = test::path_settings(32, 32, 128);
            settings.indirect = false;
            for (const TestBackend backend : test::light_backends()) {
                const Rendering rendering = test::path_image(
                    backend, builder.scene, test::look_at({0, 0, 0}, {0, 0, -1}, 1e-4), settings);
                for (std::uint32_t c = 0; c < 3; ++c) {
                    const ScatteredOnce once{at(sigma, c), at(albedo, c), static_cast<double>(g)};
                    const double expected =
                        3.0 * mean_over(area ? 300 : 20000, [&](double s) {
                            const double t = 3.0 * s;
                            const glm::dvec3 place(0.0, 0.0, -t);
                            if (!area) return once.from(t, area_light - place);
                            return mean_over(40, [&](double a) {
                                return mean_over(40, [&](double b) {
                                    const glm::dvec3 to =
                                        glm::dvec3(corner) + glm::dvec3(0, b, a) - place;
                                    return once.from(t, to) * to.x / glm::length(to);
                                });
                            });
                        });
                    test::expect_estimate(test::layer_of(rendering, "direct", c), expected,
                                          Tolerance{comparisons, 0.015, 1e-3},
                                          std::string(test::backend_name(backend)) +
                                              (area ? " square" : " point") + " g " +
                                              std::to_string(g) + " channel " + std::to_string(c));
                }
            }
        }
}

TEST(PathGrid, GridsMoveWithTheirTransform) {
    // The same smoke in the same room, all of it turned and moved far away.
    SceneBuilder here = foggy_room();
    add_grid(here.scene, 0, patchy_grid(), turned(0.6, {0.0, 0.1, 0.0}));
    here.scene.outer_medium = 0;
    here.scene.media[0].scale = 5.0F;
    Scene there = here.scene;
    const glm::dmat4 move = glm::rotate(glm::translate(glm::dmat4(1.0), {1000.0, -300.0, 50.0}),
                                        1.1, glm::dvec3(0.3, -1.0, 0.5));
    for (Instance& instance : there.instances) instance.to_world = move * instance.to_world;
    for (PunctualLight& light : there.lights)
        light.position = glm::dvec3(move * glm::dvec4(light.position, 1.0));
    there.media[0].grid_to_world = move * there.media[0].grid_to_world;
    Camera moved = room_camera();
    moved.to_world = move * moved.to_world;
    for (const TestBackend backend : test::light_backends())
        expect_same_light(
            test::path_image(backend, there, moved, test::path_settings(24, 24, 256, 3)),
            test::path_image(backend, here.scene, room_camera(),
                             test::path_settings(24, 24, 256, 4)),
            "", 0.02, test::backend_name(backend));
}

}  // namespace
}  // namespace weft::path_grid_test
