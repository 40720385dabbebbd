// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_FIELD_OF_VIEW_H
#define WEFT_SCENE_FIELD_OF_VIEW_H

#include <cmath>

#include "scene/scene.h"

namespace weft {

/// Tangent of half the vertical field of view; `aspect`: width of the image over its height.
[[nodiscard]] inline double vertical_tangent(const Camera& camera, double aspect) {
    const double tangent = std::tan(0.5 * camera.fov);
    switch (camera.fov_axis) {
        case FovAxis::y:
            return tangent;
        case FovAxis::x:
            return tangent / aspect;
        case FovAxis::smaller:
            return aspect >= 1.0 ? tangent : tangent / aspect;
        case FovAxis::larger:
            return aspect >= 1.0 ? tangent / aspect : tangent;
        case FovAxis::diagonal:
            return tangent / std::sqrt(1.0 + aspect * aspect);
    }
    return tangent;
}

}  // namespace weft

#endif
