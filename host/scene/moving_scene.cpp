// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/moving_scene.h"

#include <fmt/format.h>

#include <utility>

#include "scene/pose_scene.h"
#include "scene/validate_scene.h"

namespace weft {

MovingScene::MovingScene(Scene scene, EditTimeline edits, double frame_rate)
    : rest_(std::move(scene)),
      edits_(std::move(edits)),
      frame_rate_(frame_rate),
      moves_(!edits_.edits.empty() || is_animated(rest_)),
      flat_(flatten(rest_)) {
    if (moves_) posed_ = rest_;
}

void MovingScene::pose(std::uint32_t frame) {
    pose_scene(rest_, frame / frame_rate_, posed_);
    apply_edits(edits_, frame, posed_);
    validate_pose(posed_, fmt::format("in frame {}", frame));
}

void MovingScene::check_frame(std::uint32_t frame) {
    if (moves_) pose(frame);
}

void MovingScene::set_frame(std::uint32_t frame) {
    if (!moves_) return;
    pose(frame);
    update_flat(posed_, flat_);
}

}  // namespace weft
