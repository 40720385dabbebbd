// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_ROOM_SCENES_H
#define WEFT_SELFTEST_ROOM_SCENES_H

#include <cstdint>

#include "scene/flat_scene.h"
#include "selftest/scene_builder.h"

namespace weft::selftest {

/// The room [-1,1]^3 with an area light below its ceiling and a ball on the left.
inline const FlatScene& room_with_ball() {
    static const FlatScene flat = [] {
        SceneBuilder builder;
        builder.add(room_mesh(), builder.material({0.7F, 0.6F, 0.5F}));
        builder.add(quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                    builder.material(glm::vec3(0.5F), {5.0F, 6.0F, 7.0F}));
        builder.add(icosphere(3, false), builder.material({0.3F, 0.5F, 0.8F}),
                    placement(0.3, {-0.4, -0.6, -0.3}));
        return flatten(builder.scene);
    }();
    return flat;
}

/// Adds floor, ceiling, back and a red left wall of [-1,1]^3, which is open to the right and front.
inline void add_open_room(SceneBuilder& builder) {
    const std::uint32_t white = builder.material({0.7F, 0.7F, 0.7F});
    builder.add(quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), white);
    builder.add(quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), white);
    builder.add(quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}),
                builder.material({0.6F, 0.1F, 0.1F}));
}

/// Adds a screen that stands obliquely on the right of the open room's floor.
inline void add_screen(SceneBuilder& builder) {
    builder.add(quad_mesh({0.2F, -1.0F, -0.3F}, {0.5F, 0, 0.3F}, {0, 0.8F, 0.1F}),
                builder.material({0.5F, 0.5F, 0.9F}));
}

}  // namespace weft::selftest

#endif
