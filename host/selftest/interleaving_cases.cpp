// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "adaptive/level_overlay.h"
#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/room_scenes.h"

// Algorithms that interleaved and adaptive sampling must agree with.
namespace weft::selftest {
namespace {

FlatScene room() {
    SceneBuilder builder;
    add_open_room(builder);
    Mesh ball = icosphere(3, false);
    ball.normals = ball.positions;
    builder.add(std::move(ball), builder.material({0.3F, 0.6F, 0.8F}),
                placement(0.35, {-0.4, -0.6, -0.2}));
    add_screen(builder);
    for (const float x : {-0.6F, 0.2F})
        builder.add(quad_mesh({x, 0.95F, -0.2F}, {0.4F, 0, 0}, {0, 0, 0.4F}),
                    builder.material(glm::vec3(0.2F), {8.0F, 7.0F, 6.0F}));
    return flatten(builder.scene);
}

Camera camera() {
    return look_at({0.35, 0.1, 2.9}, {0.0, -0.05, 0.0}, 0.75);
}

RenderSettings settings_of(Algorithm algorithm, double threshold = 4.0) {
    RenderSettings settings = small_settings(algorithm, 61, 43);
    settings.sampling.threshold = threshold;
    settings.sampling.vpls_per_set = 24;
    settings.sampling.edge_samples = 0;  // igi has none
    settings.sampling.candidates = 1;    // igi gathers all VPLs that its paths leave
    settings.seed = 5;
    return settings;
}

/// The image without the layers that only ais has.
Image without_levels(Image image) {
    std::erase_if(image.layers, [](const Layer& layer) { return is_overlay_layer(layer.name); });
    return image;
}

double unlike_amax(Executor& executor, const FlatScene& flat, const RenderSettings& settings) {
    const Rendering amax = render_flat(executor, flat, camera(),
                                       settings_of(Algorithm::amax, settings.sampling.threshold));
    if (!(mean_of(amax.layer("direct")) > 0.0 && mean_of(amax.layer("indirect")) > 0.0)) return NAN;
    const Rendering other = render_flat(executor, flat, camera(), settings);
    return static_cast<double>(differing_values(amax.image, without_levels(other.image)));
}

/// Direct light of a floor under an area light so far above that every pixel gets the same light
/// from each of its points: cosines and distances differ by less than (1/2000)^2.
std::vector<float> constant_light(Executor& executor, Algorithm algorithm, double threshold) {
    SceneBuilder builder;
    builder.add(quad_mesh({-0.5F, 0, -0.5F}, {0, 0, 1}, {1, 0, 0}),
                builder.material(glm::vec3(0.5F)));
    builder.add(quad_mesh({-0.5F, 2000, -0.5F}, {1, 0, 0}, {0, 0, 1}),
                builder.material(glm::vec3(0.0F), glm::vec3(4e6F)));
    RenderSettings settings = unbounded(settings_of(algorithm, threshold));
    settings.indirect = false;
    return render(executor, builder.scene, look_at({0, 2, 0}, {0, 0, 0}, 0.3), settings)
        .layer("direct");
}

std::vector<Measured> measure_constant(Executor& executor) {
    const std::vector<float> all = constant_light(executor, Algorithm::ir, 0.0);
    const auto farthest_ratio = [&](const std::vector<float>& other) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < all.size(); ++i)
            ratios.push_back(static_cast<double>(other[i]) / static_cast<double>(all[i]));
        return farthest_from(1.0, ratios);
    };
    return {mean_of(all), farthest_ratio(constant_light(executor, Algorithm::amax, 0.0)),
            farthest_ratio(constant_light(executor, Algorithm::ais, 12.0))};
}

}  // namespace

std::vector<SelftestCase> interleaving_cases() {
    const std::string order = "the same samples in the same order make the same bits";
    const std::string sums = "sums of as many equal terms, in another order";
    return {{26,
             "amax is interleaved sampling",
             RunsOn::devices,
             {{"values of igi unlike those of amax", 0.0, within(0.0), order}},
             [](Executor& executor) -> std::vector<Measured> {
                 return {unlike_amax(executor, room(), settings_of(Algorithm::igi))};
             }},
            {27,
             "ais without a threshold is amax",
             RunsOn::devices,
             {{"values of ais unlike those of amax", 0.0, within(0.0), order}},
             [](Executor& executor) -> std::vector<Measured> {
                 return {unlike_amax(executor, room(), settings_of(Algorithm::ais, 0.0))};
             }},
            {28,
             "interleaving of constant light",
             RunsOn::devices,
             {{"ir, all sets at every pixel", 0.5 / std::numbers::pi, within(1e-6),
               "light varies by (1/2000)^2 over floor and area light"},
              {"amax over ir, worst pixel", 1.0, within(1e-6), sums},
              {"ais over ir, worst pixel", 1.0, within(1e-6), sums}},
             measure_constant}};
}

}  // namespace weft::selftest
