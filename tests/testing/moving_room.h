// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_MOVING_ROOM_H
#define WEFT_TESTS_TESTING_MOVING_ROOM_H

#include <utility>

#include "selftest/moving_room.h"

namespace weft::test {

using namespace selftest;

/// A node that moves along x by 0.1 a second, for 10 s; its track is added to the scene, it is not.
inline MovingNode sliding_node(Scene& scene) {
    KeyTrack track;
    track.times = {0.0F, 10.0F};
    track.values = {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F};
    scene.animation.tracks.push_back(track);
    MovingNode node;
    node.translation = static_cast<int>(scene.animation.tracks.size() - 1);
    return node;
}

/// The room of a block and an area light: the block slides.
inline Scene sliding_room() {
    MovingRoom room = moving_room(0);
    Scene scene = std::move(room.scene);
    scene.animation.nodes.push_back(sliding_node(scene));
    Instance& block = scene.instances[room.things.front()];
    block.motion = {0, block.to_world};
    return scene;
}

}  // namespace weft::test

#endif
