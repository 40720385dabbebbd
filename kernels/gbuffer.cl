// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Primary visibility: one ray a pixel, through its centre or the frame's jittered point.
#include "gbuffer.h"
#include "surface.h"
#include "trace.h"

static inline float3 camera_direction(const Params* params, uint x, uint y) {
    float s = 2.0f * ((float)x + params->jitter_x) / (float)params->width - 1.0f;
    float t = 1.0f - 2.0f * ((float)y + params->jitter_y) / (float)params->height;
    return xyz(params->camera_forward) + xyz(params->camera_right) * s + xyz(params->camera_up) * t;
}

WEFT_KERNEL(gbuffer)
(PARAMS, SCENE_ARGS, GEOMETRY_ARGS, GBUFFER_ARGS) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    float3 origin = xyz(params.camera_origin);
    float3 direction = camera_direction(&params, pixel % params.width, pixel / params.width);
    Hit hit = trace_closest(scene, origin, direction, RAY_INFINITY);
    gb_ids[2u * pixel] = NO_TRIANGLE;
    gb_ids[2u * pixel + 1u] = hit.triangle;
    if (hit.triangle == NO_TRIANGLE) {
        gb_position[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        gb_normal[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        gb_shading[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        gb_albedo[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        gb_emission[pixel] =
            HAS(&params, FEATURE_ENVIRONMENT) ? params.environment : f4(0.0f, 0.0f, 0.0f, 0.0f);
        return;
    }
    Surface surface = surface_at(&params, &geometry, hit, direction, params.texture_angle);
    // The forward component of `direction` is 1, so t is the distance along the viewing axis.
    float depth = hit.t;
    float distance = depth * length3(direction);
    float facing = -dot3(surface.normal, direction) / length3(direction);
    float footprint = distance * params.pixel_angle / m_max(facing, 0.05f);
    float lit =
        surface.albedo.x > 0.0f || surface.albedo.y > 0.0f || surface.albedo.z > 0.0f ? 1.0f : 0.0f;
    gb_ids[2u * pixel] = surface.instance;
    gb_position[pixel] = f4(surface.position.x, surface.position.y, surface.position.z, depth);
    gb_normal[pixel] = f4(surface.normal.x, surface.normal.y, surface.normal.z, footprint);
    gb_shading[pixel] = f4(surface.shading.x, surface.shading.y, surface.shading.z, 0.0f);
    gb_albedo[pixel] = f4(surface.albedo.x, surface.albedo.y, surface.albedo.z, lit);
    gb_emission[pixel] = f4(surface.emission.x, surface.emission.y, surface.emission.z, 0.0f);
}
