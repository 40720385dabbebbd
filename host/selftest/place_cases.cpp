// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/placed_scene.h"

// One scene at several scales and places, which must not change its image.
namespace weft::selftest {
namespace {

constexpr double allowed_mse = 1e-4;

std::vector<Measured> measure_places(Executor& executor) {
    const RenderSettings settings = small_settings(Algorithm::igi, 61, 45);
    const glm::dvec3 far_away(1e5, 1e3, -2e5);
    const Placed base = placed_scene(1.0, {});
    const Rendering reference = render(executor, base.scene, base.camera, settings);
    std::vector<Measured> measured;
    double dark = 0.0;
    const auto compare = [&](double scale, const glm::dvec3& move) {
        const Placed placed = placed_scene(scale, move);
        const Rendering rendering = render(executor, placed.scene, placed.camera, settings);
        dark += static_cast<double>(isolated_dark_pixels(reference, rendering));
        double worst = 0.0;
        for (const char* layer : {"", "direct", "indirect"})
            worst = std::max(worst, relative_mse(reference.layer(layer), rendering.layer(layer)));
        measured.emplace_back(worst);
    };
    for (const double scale : {1e-3, 1e3}) compare(scale, glm::dvec3(0.0));
    for (const double scale : {1e-3, 1.0, 1e3}) compare(scale, far_away);
    measured.emplace_back(dark);
    return measured;
}

}  // namespace

std::vector<SelftestCase> place_cases() {
    SelftestCase made{19, "a scene of any size, anywhere", RunsOn::devices, {}, measure_places};
    for (const char* const where :
         {"scaled by 1e-3", "scaled by 1e3", "scaled by 1e-3 and moved by 1e5", "moved by 1e5",
          "scaled by 1e3 and moved by 1e5"})
        made.checks.push_back({std::string("relMSE, ") + where, 0.0, within(allowed_mse),
                               "rays that graze an edge may pass where they did not"});
    made.checks.push_back({"dark pixels alone among others, all places", 0.0, within(0.0),
                           "a surface that shadows itself shows as such pixels"});
    return {made};
}

}  // namespace weft::selftest
