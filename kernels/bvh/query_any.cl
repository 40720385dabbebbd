// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds which rays of a buffer are blocked before their t_max, for benchmarks and tests of ray
// queries. The rays are those of query_closest.cl; the result is 1 or 0. One work-item per ray.
#include "kernels/bvh/trace.h"
#include "kernels/core/kernel.h"

WEFT_KERNEL(query_any)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint i = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    float4 origin = ray_origin[i];
    blocked[i] = trace_any(scene, xyz(origin), xyz(ray_direction[i]), origin.w);
}
