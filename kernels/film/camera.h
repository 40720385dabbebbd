// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_KERNELS_FILM_CAMERA_H
#define WEFT_KERNELS_FILM_CAMERA_H

#include "kernels/bvh/triangle.h"
#include "kernels/core/types.h"

/// Direction of the camera ray through the point (`x`, `y`) of the film, in pixels from its upper
/// left corner. Its component along the viewing axis is 1.
static inline float3 camera_direction(const RenderParams* params, float x, float y) {
    float s = 2.0f * x / (float)params->camera.width - 1.0f;
    float t = 1.0f - 2.0f * y / (float)params->camera.height;
    return xyz(params->camera.forward) + xyz(params->camera.right) * s + xyz(params->camera.up) * t;
}

#endif
