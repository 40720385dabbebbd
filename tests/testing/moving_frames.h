// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_MOVING_FRAMES_H
#define WEFT_TESTS_TESTING_MOVING_FRAMES_H

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/moving_scene.h"
#include "tests/testing/moving_room.h"
#include "tests/testing/render_fixture.h"

namespace weft::test {

/// Settings of small images in which every sample set counts.
inline RenderSettings igi_settings() {
    return small_settings(Algorithm::igi, 48, 36);
}

/// The image of the last of these frames after all that lead to it, one a second.
inline Image frame_after(Scene scene, const std::vector<std::uint32_t>& frames,
                         TestBackend backend) {
    MovingScene moving(std::move(scene), {}, 1.0);
    moving.set_frame(frames.front());
    Renderer renderer(shared_executor(backend), moving.flat(), room_camera(), igi_settings());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i > 0) {
            moving.set_frame(frames[i]);
            renderer.update_scene();
            renderer.move_camera(room_camera());
        }
        EXPECT_TRUE(renderer.render_frame({}));
    }
    return renderer.image();
}

}  // namespace weft::test

#endif
