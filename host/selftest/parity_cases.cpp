// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <bit>

#include "device/native/native_executor.h"
#include "selftest/case_groups.h"
#include "selftest/hard_rays.h"
#include "selftest/measurements.h"
#include "selftest/placed_scene.h"

// Devices against the native build that traces with Weft's own traversal: the same seed, the same
// light.
namespace weft::selftest {
namespace {

std::uint32_t ulps_between(float a, float b) {
    const auto x = std::bit_cast<std::uint32_t>(a);
    const auto y = std::bit_cast<std::uint32_t>(b);
    return x > y ? x - y : y - x;
}

/// Rays that meet another triangle, at a distance that is not the same within 4 ulp.
double other_hits(Executor& executor, Executor& reference) {
    const BvhMesh soup = random_soup(400, 0.3F, 5);
    const RayGeometry geometry{soup.positions, soup.triangles};
    const RayBatch rays = all_rays(geometry, 4000, 70);
    const std::vector<RayHit> expected = RayQueries(reference, geometry).closest(rays);
    const std::vector<RayHit> found = RayQueries(executor, geometry).closest(rays);
    double others = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        others += found[i].triangle == expected[i].triangle ||
                          ulps_between(found[i].t, expected[i].t) <= 4
                      ? 0.0
                      : 1.0;
    return others;
}

std::vector<Measured> measure_parity(Executor& executor) {
    const auto reference = make_native_executor(NativeTraversal::own_bvh, 0);
    const Placed placed = placed_scene(1.0, {});
    const FlatScene flat = flatten(placed.scene);
    const RenderSettings settings = small_settings(Algorithm::igi, 97, 70);
    const Rendering expected = render_flat(*reference, flat, placed.camera, settings);
    const Rendering found = render_flat(executor, flat, placed.camera, settings);
    const auto mse = [&](const char* layer) {
        return relative_mse(expected.layer(layer), found.layer(layer));
    };
    return {other_hits(executor, *reference), mse("direct"), mse("indirect"), mse("albedo")};
}

}  // namespace

std::vector<SelftestCase> parity_cases() {
    const std::string bits =
        "products and sums are never fused, and no function of drivers is used";
    const Tolerance of_embree = within(1e-5);
    return {{33,
             "devices against the native build",
             RunsOn::devices,
             {{"hits elsewhere, of 12000 rays", 0.0, within(0.0),
               "the same source; Embree may err at origins of rays", within(36.0)},
              {"relMSE of direct light", 0.0, within(0.0), bits, of_embree},
              {"relMSE of indirect light", 0.0, within(0.0), bits, of_embree},
              {"relMSE of albedo", 0.0, within(0.0), bits, of_embree}},
             measure_parity}};
}

}  // namespace weft::selftest
