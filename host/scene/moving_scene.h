// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MOVING_SCENE_H
#define WEFT_SCENE_MOVING_SCENE_H

#include <cstdint>

#include "scene/flat_scene.h"
#include "scene/scene_edits.h"

namespace weft {

/// A scene over the frames of its animation and of edits, flattened. What it is at a frame does not
/// depend on the frames before.
class MovingScene {
  public:
    /// The validated scene at rest, whose instances that may move are marked; `edits` were read for
    /// it. `frame_rate` in frames per second.
    MovingScene(Scene scene, EditTimeline edits, double frame_rate);

    /// Whether frames can differ by anything but the camera.
    [[nodiscard]] bool moves() const { return moves_; }
    /// Throws Error as set_frame does, and changes nothing.
    void check_frame(std::uint32_t frame);
    /// Brings the scene to a frame. Throws Error (exit code 2) that names the frame where a
    /// transform is singular or not finite then, a vertex not finite or too far away, or a number
    /// of a light or material unusable; the scene stays what it was.
    void set_frame(std::uint32_t frame);

    [[nodiscard]] const Scene& at_rest() const { return rest_; }
    /// Stays the same object. Its vertices and triangles keep their places in memory.
    [[nodiscard]] const FlatScene& flat() const { return flat_; }

  private:
    void pose(std::uint32_t frame);

    Scene rest_, posed_;
    EditTimeline edits_;
    double frame_rate_;
    bool moves_;
    FlatScene flat_;
};

}  // namespace weft

#endif
