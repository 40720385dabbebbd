// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Tests against what has moved since the frame before, by boxes: RecordUpdate::moved_boxes pairs of
// lower and upper corners, each pair about an object at its old or new place.
#ifndef WEFT_KERNELS_BVH_MOVED_H
#define WEFT_KERNELS_BVH_MOVED_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"

/// 1 where any of the boxes meets that from `lower` to `upper`.
static inline int meets_moved(uint count, GLOBAL const float4* boxes, float3 lower, float3 upper) {
    for (uint i = 0u; i < count; ++i) {
        float4 low = boxes[2u * i];
        float4 high = boxes[2u * i + 1u];
        if (lower.x <= high.x && lower.y <= high.y && lower.z <= high.z && upper.x >= low.x &&
            upper.y >= low.y && upper.z >= low.z)
            return 1;
    }
    return 0;
}

/// 1 where any of them is within `reach` of a place, or not much further.
static inline int is_near_moved(uint count, GLOBAL const float4* boxes, float3 place, float reach) {
    float3 about = f3(reach, reach, reach);
    return meets_moved(count, boxes, place - about, place + about);
}

#endif
