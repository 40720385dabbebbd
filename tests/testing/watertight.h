// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_WATERTIGHT_H
#define WEFT_TESTS_TESTING_WATERTIGHT_H

#include <algorithm>
#include <iostream>

#include "selftest/watertight.h"
#include "tests/testing/bvh_meshes.h"
#include "tests/testing/ray_batch.h"

// For the everyday and the slow test of watertightness.
namespace weft::test {

/// Every mesh at every place, `count` rays each, on all backends. Embree promises nothing for
/// vertices, and where Weft's own test does not confirm its hit the distance is Embree's: what it
/// misses is only told.
inline void expect_watertight(std::size_t count) {
    std::size_t embree = 0;
    std::size_t rays = 0;
    double worst = 0.0;
    std::uint32_t seed = 100;
    for (const ClosedMesh& mesh : closed_meshes())
        for (const Placement& placement : placements()) {
            const Room room = place(mesh.mesh, placement);
            ASSERT_GT(room.radius, 0.4 * room.scale) << mesh.name << ' ' << placement.name;
            seed += 1000;
            for (const TestBackend backend : backends()) {
                const Leaks leaks = leaks_of(shared_executor(backend), mesh, room, count, seed);
                EXPECT_EQ(leaks.rays, count);
                if (backend == TestBackend::embree) {
                    embree += leaks.closest + leaks.any;
                    rays += 2 * leaks.rays;
                    continue;
                }
                EXPECT_EQ(leaks.apart, 0U)
                    << mesh.name << ", " << placement.name << ", " << backend_name(backend)
                    << ": a hit is off by " << leaks.worst << " of the size";
                worst = std::max(worst, leaks.worst);
                EXPECT_EQ(leaks.closest, 0U)
                    << mesh.name << ", " << placement.name << ", " << backend_name(backend);
                EXPECT_EQ(leaks.any, 0U)
                    << mesh.name << ", " << placement.name << ", " << backend_name(backend);
            }
        }
    std::cout << "Embree misses " << embree << " of " << rays << " rays\n"
              << "largest distance of a hit from its triangle, in sizes of the mesh: " << worst
              << '\n';
}

}  // namespace weft::test

#endif
