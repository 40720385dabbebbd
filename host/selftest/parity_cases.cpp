// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <memory>
#include <vector>

#include "device/native/native_executor.h"
#include "selftest/case_groups.h"
#include "selftest/hard_rays.h"
#include "selftest/measurements.h"
#include "selftest/placed_scene.h"
#include "selftest/ray_packets.h"

// Compares devices with the native build that traces with Weft's own traversal, at another packet
// width so that the native backend is not compared with itself: the same seed must give the same
// light.
namespace weft::selftest {
namespace {

std::uint32_t ulps_between(float a, float b) {
    const auto x = std::bit_cast<std::uint32_t>(a);
    const auto y = std::bit_cast<std::uint32_t>(b);
    return x > y ? x - y : y - x;
}

/// The native build that traces with Weft's own traversal, at another packet width than
/// `executor`'s: at one lane, or at four where that has one.
std::unique_ptr<Executor> at_other_lanes(const Executor& executor) {
    return make_native_executor(NativeTraversal::own_bvh, 0, executor.lanes() == 1 ? 4 : 1);
}

/// Number of hits of another triangle, at a distance that differs by more than 4 ulp.
double other_hits(const std::vector<RayHit>& expected, const std::vector<RayHit>& found) {
    double others = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        others += found[i].triangle == expected[i].triangle ||
                          ulps_between(found[i].t, expected[i].t) <= 4
                      ? 0.0
                      : 1.0;
    return others;
}

/// Numbers of differing answers: to single rays, to rays in packets (compared with single rays),
/// and to shadow rays in packets.
std::vector<Measured> measure_rays(Executor& executor, Executor& reference) {
    const BvhMesh soup = random_soup(400, 0.3F, 5);
    const RayGeometry geometry{soup.positions, soup.triangles};
    const RayQueries expected(reference, geometry);
    const RayQueries found(executor, geometry);
    const RayBatch rays = all_rays(geometry, 4000, 70);
    const RayBatch packets = in_packets(all_rays(geometry, 768, 80));
    const std::vector<int> blocked = blocked_in_packets(expected, packets);
    const std::vector<int> answers = blocked_in_packets(found, packets);
    double unlike = 0.0;
    for (std::size_t i = 0; i < blocked.size(); ++i) unlike += answers[i] == blocked[i] ? 0.0 : 1.0;
    return {other_hits(expected.closest(rays), found.closest(rays)),
            other_hits(expected.closest(packets), found.closest_packets(packets)), unlike};
}

std::vector<Measured> measure_parity(Executor& executor) {
    const std::unique_ptr<Executor> reference = at_other_lanes(executor);
    const Placed placed = placed_scene(1.0, {});
    const FlatScene flat = flatten(placed.scene);
    const RenderSettings settings = small_settings(Algorithm::igi, 97, 70);
    const Rendering expected = render_flat(*reference, flat, placed.camera, settings);
    const Rendering found = render_flat(executor, flat, placed.camera, settings);
    const auto mse = [&](const char* layer) {
        return relative_mse(expected.layer(layer), found.layer(layer));
    };
    const std::vector<Measured> rays = measure_rays(executor, *reference);
    return {rays[0], rays[1], rays[2], mse("direct"), mse("indirect"), mse("albedo")};
}

}  // namespace

std::vector<SelftestCase> parity_cases() {
    const std::string bits =
        "products and sums are never fused, and no function of drivers is used";
    const Tolerance of_embree = within(1e-5);
    const std::string at_origins = "the same source; Embree may err at origins of rays";
    SelftestCase made{
        33,
        "devices against the native build",
        RunsOn::devices,
        {{"hits elsewhere, of 12000 rays", 0.0, within(0.0), at_origins, within(36.0)},
         {"packet hits elsewhere, of 4608 rays", 0.0, within(0.0), at_origins, within(14.0)},
         {"shadow packets unlike, of 4608 rays", 0.0, within(0.0),
          "the same source, at another number of lanes"},
         {"relMSE of direct light", 0.0, within(0.0), bits, of_embree},
         {"relMSE of indirect light", 0.0, within(0.0), bits, of_embree},
         {"relMSE of albedo", 0.0, within(0.0), bits, of_embree}},
        measure_parity};
    // Rays that graze a triangle are decided by the packet test of Weft's own traversal.
    made.checks[2].own_traversal = true;
    return {made};
}

}  // namespace weft::selftest
