// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_SCENE_PROBE_H
#define WEFT_BENCH_DYNAMIC_SCENE_PROBE_H

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "device/executor.h"
#include "render/renderer.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft::bench {

/// Finds out what is where in a scene as it is at rest, to place things there. A question takes
/// about as long as an image of one pixel, which it is.
class SceneProbe {
  public:
    /// Builds an acceleration structure.
    SceneProbe(FlatScene flat, const Camera& camera);

    /// How far from a point anything is in a direction, which need not be of length 1; in scene
    /// units. Empty where there is nothing.
    [[nodiscard]] std::optional<double> distance(const glm::dvec3& from,
                                                 const glm::dvec3& direction);

  private:
    FlatScene flat_;
    Camera camera_;
    std::unique_ptr<Executor> executor_;
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace weft::bench

#endif
