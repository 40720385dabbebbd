// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the closest hits of a buffer of rays as query_closest.cl, in packets of LANES consecutive
// rays, which start at the origin of the first of them. Rays whose t_max is 0 are not traced, and
// miss; that of the others is infinite. One work-item per packet.
#include "kernels/bvh/trace.h"
#include "kernels/core/kernel.h"

WEFT_KERNEL(query_closest_packet)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint first = (range.first + WORK_ITEM(range)) * (uint)LANES;
    SCENE_MAKE(scene);
    PacketDirections directions;
    uint active = 0u;
    for (uint lane = 0u; lane < LANES; ++lane) {
        directions.x[lane] = ray_direction[first + lane].x;
        directions.y[lane] = ray_direction[first + lane].y;
        directions.z[lane] = ray_direction[first + lane].z;
        if (ray_origin[first + lane].w > 0.0f) active |= 1u << lane;
    }
    Hit found[LANES];
    trace_closest_packet(scene, xyz(ray_origin[first]), &directions, active, RAY_INFINITY, found);
    for (uint lane = 0u; lane < LANES; ++lane) {
        Hit hit = {INVALID_INDEX, 0.0f, 0.0f, 0.0f};
        if ((active >> lane & 1u) != 0u) hit = found[lane];
        hits[first + lane] = f4(from_bits(hit.triangle), hit.t, hit.u, hit.v);
    }
}
