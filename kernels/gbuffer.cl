// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Primary visibility: one ray a pixel, through its centre or the frame's jittered point.
#include "camera.h"
#include "gbuffer.h"
#include "surface.h"
#include "trace.h"

WEFT_KERNEL(gbuffer)
(PARAMS, SCENE_ARGS, GEOMETRY_ARGS, GBUFFER_ARGS) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    float3 origin = xyz(params.camera_origin);
    float3 direction = camera_direction(&params, (float)(pixel % params.width) + params.jitter_x,
                                        (float)(pixel / params.width) + params.jitter_y);
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
