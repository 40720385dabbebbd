// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes ambient occlusion: the cosine-weighted share of the hemisphere above each receiver that
// is open, as the irradiance of a white sky of radiance 1. That is pi times the share of the
// directions of its sample set (unit vectors about +z with pdf cos / pi) along which nothing lies
// within the reach, their w. A direction below the surface counts as occluded. One work-item per
// slot. It traces its rays one at a time, because those of the receivers of a packet have no common
// end point.
#include "kernels/adaptive/sample_sets.h"
#include "kernels/bvh/trace.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/core/receiver_values.h"
#include "kernels/core/sampling.h"

WEFT_KERNEL(ambient_occlusion)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = range.first + WORK_ITEM(range);
    uint stride = slots;
    uint open = 0u;
    uint rays = 0u;
    if (receiver_planes[RECEIVER_VALID * stride + slot] > 0.0f) {
        SCENE_MAKE(scene);
        float3 position = receiver_vector(receiver_planes, RECEIVER_X, stride, slot);
        float3 shading = receiver_vector(receiver_planes, RECEIVER_SHADING_X, stride, slot);
        float3 normal = shading;
        if (HAS(&params, FEATURE_SMOOTH_NORMALS))
            normal = receiver_vector(receiver_planes, RECEIVER_NORMAL_X, stride, slot);
        uint set = receiver_set(&params, block_set, slot);
        GLOBAL const float4* first = directions + list.first + set * list.stride;
        for (uint i = 0u; i < list.length; ++i) {
            float4 local_vector = first[i];
            float3 direction = to_world(xyz(local_vector), shading);
            if (!(dot3(direction, normal) > 0.0f)) continue;
            ++rays;
            if (trace_any(scene, position, direction, local_vector.w) == 0) ++open;
        }
    }
    float sky = COSINE_IRRADIANCE * ((float)open / (float)list.length);
    irradiance[slot] = sky;
    irradiance[stride + slot] = sky;
    irradiance[2u * stride + slot] = sky;
    count_rays(counters + range.counter, rays);
}
