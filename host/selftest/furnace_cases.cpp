// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/path_rendering.h"
#include "selftest/scene_builder.h"

// White furnaces: surroundings in which radiance is known everywhere.
namespace weft::selftest {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float grey = 0.5F;

Camera inside() {
    return look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2);
}

SelftestCase white_furnace() {
    const std::string exact = "every sample has the whole radiance, so only rounding is left";
    return {
        1,
        "white body in white surroundings",
        RunsOn::devices,
        {{"path tracing, worst pixel", 1.0, share(2e-6), exact},
         {"igi, worst pixel", 1.0, share(1e-5),
          "every ray has the whole radiance; weights of nine sets add up in floats"},
         {"ic, worst pixel", 1.0, share(1e-5),
          "every ray has the whole radiance, and a convex body sends itself none"}},
        [](Executor& executor) -> std::vector<Measured> {
            SceneBuilder builder;
            builder.scene.environment = Environment{glm::vec3(1.0F)};
            builder.add(icosphere(2, false), builder.material(glm::vec3(1.0F)));
            const FlatScene flat = flatten(builder.scene);
            const Camera camera = look_at({0, 0, 3}, {0, 0, 0}, 0.9);
            const auto worst = [](const Rendering& rendering) {
                return farthest_from(1.0, channel_of(rendering, "", 0));
            };
            return {
                worst(trace_flat(executor, flat, camera, path_settings(24, 24, 8))),
                worst(render_flat(executor, flat, camera, small_settings(Algorithm::igi, 24, 24))),
                worst(render_flat(executor, flat, camera, small_settings(Algorithm::ic, 24, 24)))};
        }};
}

Estimate furnace_mean(Executor& executor, const FlatScene& flat, Algorithm algorithm) {
    return over_seeds([&](std::uint32_t seed) {
        RenderSettings settings = unbounded(small_settings(algorithm, 8, 8));
        settings.sampling.vpls_per_set = 128;
        settings.sampling.samples_per_light = 32;
        settings.sampling.roulette = 0.0;
        settings.sampling.cache_error = 0.02;
        settings.sampling.cache_rays = 128;
        settings.seed = seed;
        return estimate(channel_of(render_flat(executor, flat, inside(), settings), "", 0)).mean;
    });
}

SelftestCase grey_furnace() {
    const std::string paths = "paths are random, with a fixed seed; 1e-5 is for sums of floats";
    return {2,
            "closed room that emits everywhere",
            RunsOn::devices,
            {{"path tracing, albedo 1/2", 2.0, by_chance(0.02, 1e-5), paths},
             {"path tracing, albedo 9/10", 10.0, by_chance(0.02, 1e-5), paths},
             {"ir, all bounces", 2.0, by_chance(2e-3, 5e-6, image_seeds),
              "samples differ by seed; the last bounce has the light of all that follow"},
             {"ic, all bounces", 2.0, by_chance(2e-3, 0.005, image_seeds),
              "as ir, and records may be off by 2 % in indirect light, a quarter of all"},
             {"irradiance-cache, all bounces", 2.0, by_chance(3e-3, 1e-5, image_seeds),
              "rays of records go on as random paths; every pixel is a record"}},
            [](Executor& executor) -> std::vector<Measured> {
                SceneBuilder room;
                room.add(room_mesh(), room.material({grey, 0.9F, 0.0F}, glm::vec3(1.0F)));
                const Rendering traced = trace_paths(
                    executor, room.scene, look_at({0.2, 0.1, 0.7}, {-0.1, -0.2, -0.5}, 1.4),
                    path_settings(16, 16, 128));
                SceneBuilder sphere;
                sphere.add(icosphere(3, true), sphere.material(glm::vec3(grey), glm::vec3(1.0F)));
                const FlatScene flat = flatten(sphere.scene);
                return {beauty_of(traced, 0), beauty_of(traced, 1),
                        furnace_mean(executor, flat, Algorithm::ir),
                        furnace_mean(executor, flat, Algorithm::ic),
                        furnace_mean(executor, flat, Algorithm::irradiance_cache)};
            }};
}

/// Indirect irradiance by irradiance-cache, whose records trace rays into their hemispheres.
Estimate by_hemispheres(Executor& executor, const FlatScene& flat) {
    return over_seeds([&](std::uint32_t seed) {
        RenderSettings settings = small_settings(Algorithm::irradiance_cache, 16, 12);
        settings.sampling.cache_error = 0.2;
        settings.direct = false;
        settings.seed = seed;
        return mean_irradiance(render_flat(executor, flat, inside(), settings), "indirect");
    });
}

std::vector<Measured> measure_sphere(Executor& executor) {
    SceneBuilder builder;
    builder.add(icosphere(5, true), builder.material(glm::vec3(grey)));
    builder.light(LightType::point, {0, 0, 0}, glm::vec3(std::numbers::pi_v<float>));
    const FlatScene flat = flatten(builder.scene);
    const RenderSettings all = unbounded(small_settings(Algorithm::ir, 32, 24));
    RenderSettings cached = unbounded(small_settings(Algorithm::ic, 32, 24));
    cached.sampling.roulette = 0.0;
    cached.sampling.cache_error = 0.02;
    const Rendering gathered = render_flat(executor, flat, inside(), all);
    return {farthest_from(pi, irradiances(gathered, "direct")), mean_of(gathered.layer("")),
            mean_irradiance(render_flat(executor, flat, inside(), cached), "indirect"),
            beauty_of(trace_flat(executor, flat, inside(), path_settings(24, 24, 64, 2)), 0),
            by_hemispheres(executor, flat)};
}

SelftestCase integrating_sphere() {
    const std::string facets = "facets reach 2.5e-4 of the radius into the sphere";
    return {3,
            "sphere around a point light",
            RunsOn::devices,
            {{"direct irradiance, worst pixel", pi, share(6e-4), facets + ", twice in 1/R^2"},
             {"ir, all bounces", 1.0, share(2e-3), facets + ", and tilt normals beside lights"},
             {"ic, irradiance by all", pi, share(0.02),
              "2 % are what the settings let records be off by"},
             {"path tracing, all bounces", 1.0, by_chance(0.01, 2e-3),
              facets + ", which every bounce sees; paths are random"},
             {"irradiance-cache, irradiance by all", pi, by_chance(0.01, 2e-3, image_seeds),
              facets + ", which every bounce sees; rays of records are random"}},
            measure_sphere};
}

SelftestCase parallel_plates() {
    const double e1 = 1.0, e2 = 0.3, rho1 = 0.5, rho2 = 0.7;
    return {11,
            "parallel plates, 1000 gaps wide",
            RunsOn::devices,
            {{"path tracing", (e1 + rho1 * e2) / (1.0 - rho1 * rho2), by_chance(0.015, 2e-5),
              "paths are random; 4e-6 of the light leaves at the edges"}},
            [](Executor& executor) -> std::vector<Measured> {
                SceneBuilder builder;
                builder.add(quad_mesh({-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}),
                            builder.material(glm::vec3(0.5F), glm::vec3(1.0F)));
                builder.add(quad_mesh({-500, -500, 1}, {0, 1000, 0}, {1000, 0, 0}),
                            builder.material(glm::vec3(0.7F), glm::vec3(0.3F)));
                return {beauty_of(
                    trace_paths(executor, builder.scene, look_at({0, 0, 0.6}, {0, 0, 0}, 1.0),
                                path_settings(16, 16, 128, 4)),
                    0)};
            }};
}

}  // namespace

std::vector<SelftestCase> furnace_cases() {
    return {white_furnace(), grey_furnace(), integrating_sphere(), parallel_plates()};
}

}  // namespace weft::selftest
