// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Traces packets of the camera's rays.
#ifndef WEFT_KERNELS_FILM_CAMERA_RAYS_H
#define WEFT_KERNELS_FILM_CAMERA_RAYS_H

#include "kernels/bvh/trace.h"
#include "kernels/film/camera.h"

// Points of the film, in pixels, and the directions of the rays through them.
typedef struct {
    float x[LANES], y[LANES];
    PacketDirections directions;
} CameraPacket;

/// Sets the ray of a lane to that through the point (`x`, `y`).
static inline void set_camera_ray(const RenderParams* params, CameraPacket* packet, uint lane,
                                  float x, float y) {
    float3 direction = camera_direction(params, x, y);
    packet->x[lane] = x;
    packet->y[lane] = y;
    packet->directions.x[lane] = direction.x;
    packet->directions.y[lane] = direction.y;
    packet->directions.z[lane] = direction.z;
}

static inline float3 lane_direction(const CameraPacket* packet, uint lane) {
    return f3(packet->directions.x[lane], packet->directions.y[lane], packet->directions.z[lane]);
}

/// Closest hits of the lanes of `active`. Packets are of rays from one point: those of an
/// orthographic camera are traced one by one.
static inline void trace_camera_packet(const RenderParams* params, Scene scene,
                                       const CameraPacket* packet, uint active, Hit* hits) {
    if (!HAS(params, FEATURE_ORTHOGRAPHIC)) {
        trace_closest_packet(scene, xyz(params->camera.origin), &packet->directions, active,
                             RAY_INFINITY, hits);
        return;
    }
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        Hit hit = {INVALID_INDEX, 0.0f, 0.0f, 0.0f};
        if ((active >> lane & 1u) != 0u)
            hit = trace_closest(scene, camera_origin(params, packet->x[lane], packet->y[lane]),
                                lane_direction(packet, lane), RAY_INFINITY);
        hits[lane] = hit;
    }
}

#endif
