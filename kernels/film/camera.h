// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays of the camera through points of the film, in pixels from its upper left corner. Those of a
// perspective camera begin in one point; those of an orthographic one (FEATURE_ORTHOGRAPHIC) are
// parallel, and begin on its near plane.
#ifndef WEFT_KERNELS_FILM_CAMERA_H
#define WEFT_KERNELS_FILM_CAMERA_H

#include "kernels/bvh/triangle.h"
#include "kernels/core/types.h"

/// The point (`x`, `y`) of the film relative to its centre, along the camera's `right` and `up`.
static inline float3 film_offset(const RenderParams* params, float x, float y) {
    float s = 2.0f * x / (float)params->camera.width - 1.0f;
    float t = 1.0f - 2.0f * y / (float)params->camera.height;
    return xyz(params->camera.right) * s + xyz(params->camera.up) * t;
}

/// Where the ray through the point (`x`, `y`) begins.
static inline float3 camera_origin(const RenderParams* params, float x, float y) {
    if (!HAS(params, FEATURE_ORTHOGRAPHIC)) return xyz(params->camera.origin);
    return xyz(params->camera.origin) + film_offset(params, x, y);
}

/// Direction of the ray through the point (`x`, `y`). Its component along the viewing axis is 1.
static inline float3 camera_direction(const RenderParams* params, float x, float y) {
    if (HAS(params, FEATURE_ORTHOGRAPHIC)) return xyz(params->camera.forward);
    float s = 2.0f * x / (float)params->camera.width - 1.0f;
    float t = 1.0f - 2.0f * y / (float)params->camera.height;
    return xyz(params->camera.forward) + xyz(params->camera.right) * s + xyz(params->camera.up) * t;
}

/// Distance from the camera along its viewing axis of a hit that lies `t` along a ray.
static inline float camera_depth(const RenderParams* params, float t) {
    return HAS(params, FEATURE_ORTHOGRAPHIC) ? t + params->camera.origin.w : t;
}

/// Width of a pixel, across the ray, that is seen at a distance.
static inline float pixel_width(const RenderParams* params, float distance) {
    return HAS(params, FEATURE_ORTHOGRAPHIC) ? params->camera.pixel_angle
                                             : distance * params->camera.pixel_angle;
}

/// The angle over which textures are averaged at a hit that lies `t` along a ray, where `angle` is
/// that of perspective cameras, and the width of orthographic ones.
static inline float seen_texture_angle(const RenderParams* params, float angle, float t) {
    return HAS(params, FEATURE_ORTHOGRAPHIC) ? angle / t : angle;
}

#endif
