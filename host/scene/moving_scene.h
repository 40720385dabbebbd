// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MOVING_SCENE_H
#define WEFT_SCENE_MOVING_SCENE_H

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "scene/flat_scene.h"
#include "scene/scene_bounds.h"
#include "scene/scene_edits.h"

namespace weft {

/// The parts of a scene that can be edited without a copy of all its meshes and textures.
struct SceneParts {
    std::vector<Instance>& instances;
    std::vector<Material>& materials;
    std::vector<PunctualLight>& lights;
    std::optional<Environment>& environment;
};

/// A scene over the frames of its animation and of edits, flattened. Its state at a frame does not
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
    /// The box of all that is in the scene in frames [first, end): in all of them where they are no
    /// more than 64, else in as many that are evenly spaced. Throws Error as set_frame does.
    [[nodiscard]] SceneBounds bounds(std::uint32_t first, std::uint32_t end);
    /// Brings the scene to a frame. Throws Error (exit code 2) that names the frame where a
    /// transform is singular or not finite then, a vertex not finite or too far away, or a number
    /// of a light or material unusable; the scene stays what it was.
    void set_frame(std::uint32_t frame);

    /// Changes the scene at rest, and its state in the present frame. Returns whether the old
    /// flattened scene could be brought up to date (update_flat), which is so where only places of
    /// instances that may move, lights and colours have changed. Otherwise it has been flattened
    /// anew, with all its memory; instances that were moved may move from then on. Throws Error
    /// (exit code 2) as validate_scene, validate_pose and set_frame do, and where a frame's edits
    /// change what is no longer there; the scene stays what it was.
    bool edit(const std::function<void(const SceneParts&)>& change);
    /// Replaces all edits by those that `read` finds for the scene at rest, in which it marks and
    /// adds instances as read_scene_edits does, and brings the scene to a frame. From then on the
    /// scene is what one made with these edits is, whatever it was before. Returns as `edit` does.
    /// Throws what `read` throws, and Error as set_frame does; the scene stays what it was.
    bool set_edits(const std::function<EditTimeline(Scene&)>& read, std::uint32_t frame);
    /// As `edit` for any changes, meshes and textures included; always flattens anew.
    void rebuild(const std::function<void(Scene&)>& change);

    [[nodiscard]] const Scene& at_rest() const { return rest_; }
    /// The scene in the present frame; at rest where it does not move, or no frame was chosen.
    [[nodiscard]] const Scene& now() const { return moves_ && posed_once_ ? posed_ : rest_; }
    /// Stays the same object. Its vertices and triangles keep their places in memory, unless an
    /// edit flattens anew.
    [[nodiscard]] const FlatScene& flat() const { return flat_; }

  private:
    void pose(std::uint32_t frame);
    void flatten_anew();
    void update_in_place();

    Scene rest_, posed_;
    EditTimeline edits_;
    double frame_rate_;
    std::uint32_t frame_ = 0;  ///< the present one
    bool posed_once_ = false;  ///< false: the scene is at rest
    bool moves_;
    FlatScene flat_;
    std::vector<double> first_powers_;  ///< those of flat_ when it was flattened
    /// Those at rest without edits; empty where set_edits has not been called since `edit`.
    std::optional<std::vector<Instance>> unedited_;
};

}  // namespace weft

#endif
