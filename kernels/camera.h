// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CAMERA_H
#define WEFT_CAMERA_H

#include "triangle.h"
#include "types.h"

/// Direction of the camera ray through the point (`x`, `y`) of the film, in pixels from its upper
/// left corner. Its component along the viewing axis is 1.
static inline float3 camera_direction(const Params* params, float x, float y) {
    float s = 2.0f * x / (float)params->width - 1.0f;
    float t = 1.0f - 2.0f * y / (float)params->height;
    return xyz(params->camera_forward) + xyz(params->camera_right) * s + xyz(params->camera_up) * t;
}

#endif
