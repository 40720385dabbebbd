// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Shadow rays that are traced one at a time.
#ifndef WEFT_KERNELS_BVH_VISIBILITY_H
#define WEFT_KERNELS_BVH_VISIBILITY_H

#include "kernels/bvh/trace.h"
#include "kernels/core/offset.h"

/// 1 where nothing lies between a point off a surface and infinity. The ray starts a little along
/// its way, because a point on the edge of two faces lies in the plane of both.
static inline int sees_infinity(Scene scene, const RenderParams* params, float3 position,
                                float3 direction) {
    float3 start = position + direction * (4.0f * surface_offset(position, params->scene.extent));
    return trace_any(scene, start, direction, RAY_INFINITY) == 0 ? 1 : 0;
}

/// 1 where nothing lies between a point off a surface and the end of `towards`. Both ends are left
/// out, as in sees_infinity: the far one by SHADOW_END.
static inline int sees_point(Scene scene, const RenderParams* params, float3 position,
                             float3 towards) {
    float length = length3(towards);
    if (!(length > 0.0f)) return 1;
    float3 ahead = towards * (4.0f * surface_offset(position, params->scene.extent) / length);
    return trace_any(scene, position + ahead, towards - ahead, SHADOW_END) == 0 ? 1 : 0;
}

#endif
