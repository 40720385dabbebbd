// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_DYNAMIC_SEQUENCES_H
#define WEFT_BENCH_COMMON_DYNAMIC_SEQUENCES_H

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace weft::bench {

/// What happens over the frames of a sequence.
enum class Happening : std::uint8_t {
    box,     ///< a small box slides across the middle of the picture
    lamp,    ///< all lights become dimmer and redder
    camera,  ///< the camera turns
    still,   ///< nothing
};

[[nodiscard]] const char* to_string(Happening happening);
[[nodiscard]] const std::vector<Happening>& all_happenings();

/// A scene over frames: what it is at each follows from what it is at first.
class DynamicSequence {
  public:
    /// `middle`: what the middle of the picture shows, scene units. A box that is to slide is added
    /// to the scene, in front of that.
    DynamicSequence(Scene scene, const Camera& camera, const glm::dvec3& middle,
                    Happening happening);

    /// The scene at a frame: a copy of `first` with other transforms, lights and materials.
    [[nodiscard]] const Scene& at(std::uint32_t frame);
    [[nodiscard]] Camera camera_at(std::uint32_t frame) const;

  private:
    Scene first_, now_;
    Camera camera_;
    Happening happening_;
    glm::dvec3 step_{0.0};  ///< of the box, from frame to frame
};

}  // namespace weft::bench

#endif
