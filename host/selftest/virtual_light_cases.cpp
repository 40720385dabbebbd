// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/scene_builder.h"

// Virtual lights close to what they light: the light that their bound leaves out, and the residual.
namespace weft::selftest {
namespace {

constexpr double rho = 0.5;
constexpr double bound_share = 0.3;

/// Irradiance by all bounces in a sphere of radius 1 around a light of intensity 1. The geometry
/// term is 1/4 between any two points, so a bound of a share of that keeps this share of the light.
constexpr double bounded = bound_share * rho / (1.0 - rho);

std::vector<double> sphere_irradiance(Executor& executor, const FlatScene& flat,
                                      bool compensation) {
    RenderSettings settings = small_settings(Algorithm::ir, 64, 48);
    settings.sampling.interleave = 1;
    settings.sampling.compensation = compensation;
    settings.sampling.local_bounds = false;
    // The bound is pi n / (c^2 4 pi R^2).
    settings.sampling.bound_spacing =
        std::sqrt(plan_for(flat, settings).vpls_per_set / bound_share);
    const Camera camera = look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2);
    return irradiances(render_flat(executor, flat, camera, settings), "indirect");
}

/// An area light of 5e-5 that faces a corner of a room from 5e-4, so that virtual lights lie as
/// close to each other and to the walls that the camera sees from 2e-4.
double bad_corner(Executor& executor) {
    constexpr float edge = 5e-5F;
    const glm::vec3 corner(-1.0F);
    SceneBuilder builder;
    builder.add(room_mesh(), builder.material(glm::vec3(0.7F)));
    builder.add(quad_mesh(corner + 3e-4F, edge * glm::vec3(1.0F, -1.0F, 0.0F),
                          edge * glm::vec3(-0.5F, -0.5F, 1.0F)),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    const glm::dvec3 at(corner);
    const Rendering rendering = render(executor, builder.scene, look_at(at + 1e-4, at, 1.4),
                                       unbounded(small_settings(Algorithm::ir, 16, 12)));
    return bad_values(rendering) + (mean_of(rendering.layer("indirect")) > 0.0 ? 0.0 : 1.0);
}

std::vector<Measured> measure_touching(Executor& executor) {
    SceneBuilder builder;
    builder.add(icosphere(5, true), builder.material(glm::vec3(static_cast<float>(rho))));
    builder.light(LightType::point, {0, 0, 0}, glm::vec3(1.0F));
    const FlatScene flat = flatten(builder.scene);
    return {bad_corner(executor), estimate(sphere_irradiance(executor, flat, false)).mean,
            estimate(sphere_irradiance(executor, flat, true))};
}

}  // namespace

std::vector<SelftestCase> virtual_light_cases() {
    return {{21,
             "virtual lights at touching distance",
             RunsOn::devices,
             {{"bad values in a corner, without bound", 0.0, within(0.0),
               "distances are above 0 wherever a cosine is"},
              {"irradiance under a bound of 3/10", bounded, share(4e-3),
               "facets reach 2.5e-4 of the radius inside, beside few virtual lights"},
              {"the same with the residual", rho / (1.0 - rho), by_chance(0.03, 8e-3),
               "facets, twice; one path a pixel brings what is left out"}},
             measure_touching}};
}

}  // namespace weft::selftest
