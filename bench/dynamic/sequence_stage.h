// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_SEQUENCE_STAGE_H
#define WEFT_BENCH_DYNAMIC_SEQUENCE_STAGE_H

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "bench/dynamic/scene_probe.h"
#include "scene/scene.h"

namespace weft::bench {

/// How far the middle of the image is from the camera; scene units.
[[nodiscard]] double view_distance(const Camera& camera, SceneProbe& probe);

/// Where things can be put in a scene so that a camera sees them: found by looking around.
class SequenceStage {
  public:
    SequenceStage(const Camera& camera, SceneProbe& probe);

    /// Axes of the world as the camera has them: up is one of its axes, ahead and right are level.
    [[nodiscard]] const glm::dvec3& up() const { return up_; }
    [[nodiscard]] const glm::dvec3& ahead() const { return ahead_; }
    [[nodiscard]] const glm::dvec3& right() const { return right_; }
    /// How far the middle of the image is, on the level.
    [[nodiscard]] double depth() const { return depth_; }
    /// Of the camera above the floor; scene units.
    [[nodiscard]] double eye_height() { return depth_to_floor(eye_); }

    /// The floor below a point that lies that far ahead and to the right, as shares of `depth`.
    [[nodiscard]] glm::dvec3 floor_at(double ahead, double right);
    /// The places for things that stand on the floor with the most room above it, at most `count`;
    /// the camera sees the space above each, and nothing else stands there.
    [[nodiscard]] std::vector<glm::dvec3> free_places(std::size_t count);

    /// A line at the foot of a wall to the side.
    struct Side {
        glm::dvec3 foot{0.0};
        glm::dvec3 inwards{0.0};  ///< away from the wall, unit
        double height = 0.0;      ///< of the room, scene units
    };
    [[nodiscard]] Side side();

    /// To the world from a space with +y up whose origin is `foot` and whose +x is `x`, level and
    /// unit; `size`: of its unit.
    [[nodiscard]] glm::dmat4 standing(const glm::dvec3& foot, const glm::dvec3& x,
                                      double size) const;

  private:
    [[nodiscard]] glm::dvec3 level_point(double ahead, double right) const;
    /// Of a point above the floor; where things stand about it, the floor beside them counts.
    [[nodiscard]] double depth_to_floor(const glm::dvec3& point);

    SceneProbe& probe_;
    glm::dvec3 eye_, up_, ahead_, right_;
    double depth_ = 1.0;
    double tangent_ = 1.0;  ///< of half the field of view of a square image
};

}  // namespace weft::bench

#endif
