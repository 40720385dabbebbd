// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds which shadow rays of a buffer are blocked before SHADOW_END, in packets, for benchmarks and
// tests of ray queries. PACKET_BLOCK consecutive rays start at one point. `rays` holds four planes
// of `slots` floats: x, y, z of the vector from the start to the end point, and 1 for rays to
// trace. The result is 1 for blocked rays, 0 for others. A work-item traces LANES rays.
#include "kernels/bvh/trace.h"
#include "kernels/core/kernel.h"

WEFT_KERNEL(query_packet)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = (range.first + WORK_ITEM(range)) * (uint)LANES;
    SCENE_MAKE(scene);
    WFloat3 d;
    d.x = wide_load(rays, slot);
    d.y = wide_load(rays, slots + slot);
    d.z = wide_load(rays, 2u * slots + slot);
    WMask active = wide_load(rays, 3u * slots + slot) > WIDE(0.0f);
    WFloat zero = WIDE(0.0f);
    WFloat answer = zero;
    if (mask_any(active)) {
        WMask found = trace_any_packet(scene, xyz(block_origin[slot / PACKET_BLOCK]), d, active);
        answer = SELECT(active & found, WIDE(1.0f), zero);
    }
    wide_store(answer, blocked, slot);
}
