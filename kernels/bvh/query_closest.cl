// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the closest hits of a buffer of rays, for benchmarks and tests of ray queries. A ray is its
// origin (w: t_max) and its direction, of any length; a hit is the bits of the triangle id, then t,
// u, v. One work-item per ray.
#include "kernels/bvh/trace.h"
#include "kernels/core/kernel.h"

WEFT_KERNEL(query_closest)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint i = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    float4 origin = ray_origin[i];
    Hit hit = trace_closest(scene, xyz(origin), xyz(ray_direction[i]), origin.w);
    hits[i] = f4(from_bits(hit.triangle), hit.t, hit.u, hit.v);
}
