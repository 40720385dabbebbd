// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "plan/algorithm.h"
#include "tests/testing/moving_room.h"
#include "tests/testing/render_fixture.h"

namespace weft::stage_times_test {
namespace {

using test::TestBackend;

/// That no time is counted in two stages: together they take no longer than their frame.
void expect_disjoint(const FrameStats& frame, const std::string& when) {
    double sum = 0.0;
    bool has_store = false;
    for (const StageStats& stage : frame.stages) {
        sum += stage.ms;
        has_store = has_store || stage.stage == Stage::record_store;
    }
    EXPECT_TRUE(has_store) << when;
    EXPECT_LE(sum, frame.ms) << when;
}

TEST(StageTimes, OfRecordsAddUpToNoMoreThanTheFrame) {
    for (const TestBackend backend : test::backends())
        for (const Algorithm algorithm :
             {Algorithm::ic, Algorithm::tic, Algorithm::irradiance_cache}) {
            test::MovingRoom room = test::moving_room(2);
            Renderer renderer(test::shared_executor(backend), room.flat, test::room_camera(),
                              test::small_settings(algorithm, 96, 72));
            const std::string name =
                std::string(to_string(algorithm)) + " on " + test::backend_name(backend);
            ASSERT_TRUE(renderer.render_frame({}));
            expect_disjoint(renderer.stats().back(), name);
            room.move(0, {0.1, 0.1, 0.0});
            update_flat(room.scene, room.flat);
            renderer.update_scene();
            renderer.move_camera(test::room_camera());
            ASSERT_TRUE(renderer.render_frame({}));
            expect_disjoint(renderer.stats().back(), name + ", after a change");
        }
}

}  // namespace
}  // namespace weft::stage_times_test
