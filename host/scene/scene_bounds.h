// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SCENE_BOUNDS_H
#define WEFT_SCENE_SCENE_BOUNDS_H

#include <glm/glm.hpp>
#include <limits>

#include "scene/scene.h"

namespace weft {

/// A box in world space; empty until points are added.
struct SceneBounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const SceneBounds& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
};

/// The box of all vertices that triangles of present instances use, as the scene stands; of all
/// instances, or of those that may move, or of the others.
enum class BoundsOf { all, moving, still };
[[nodiscard]] SceneBounds bounds_of(const Scene& scene, BoundsOf which = BoundsOf::all);

}  // namespace weft

#endif
