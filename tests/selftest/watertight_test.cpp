// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/testing/watertight.h"

#include <gtest/gtest.h>

// No ray from inside of a closed mesh gets out, wherever the mesh lies.
namespace weft::watertight_test {
namespace {

TEST(Watertight, NoRayLeavesAClosedMesh) {
    test::expect_watertight(40000);
}

TEST(Watertight, BoxesWithoutPaddingAreMetAllTheSame) {
    // The padding of boxes hides what the box test rounds, which that has to cover by itself. Far
    // from the origin boxes are a few floats thick.
    for (const test::ClosedMesh& mesh : test::closed_meshes())
        for (const test::Placement& placement : test::placements()) {
            const test::Room room = test::place(mesh.mesh, placement);
            const test::Leaks leaks = test::leaks_of(
                test::shared_executor(test::TestBackend::own_bvh), mesh, room, 100000, 7, 0.0F);
            EXPECT_EQ(leaks.closest, 0U) << mesh.name << ", " << placement.name;
            EXPECT_EQ(leaks.any, 0U) << mesh.name << ", " << placement.name;
        }
}

TEST(Watertight, ARayThroughAHoleIsNoticed) {
    // The count is of rays that get out, so one triangle taken away has to show.
    for (const test::TestBackend backend : test::backends()) {
        test::ClosedMesh mesh = test::closed_meshes().front();
        mesh.mesh.triangles.erase(mesh.mesh.triangles.begin() + 100);
        const test::Room room = test::place(mesh.mesh, test::placements().front());
        const test::Leaks leaks =
            test::leaks_of(test::shared_executor(backend), mesh, room, 100000, 1);
        EXPECT_GT(leaks.closest, 1U);
        EXPECT_EQ(leaks.any, leaks.closest);
    }
}

}  // namespace
}  // namespace weft::watertight_test
