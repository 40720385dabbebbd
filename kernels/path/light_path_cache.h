// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Layout of the light paths that are stored from frame to frame: where each begins, two float4, and
// then the hit of each segment, a float4 for each VPL.
#ifndef WEFT_KERNELS_PATH_LIGHT_PATH_CACHE_H
#define WEFT_KERNELS_PATH_LIGHT_PATH_CACHE_H

#include "kernels/path/light_path.h"

// In place of a triangle: the segment has not been traced.
#define NOT_TRACED 0xFFFFFFFEu

static inline Hit no_segment(void) {
    Hit hit;
    hit.triangle = NOT_TRACED;
    hit.t = 0.0f;
    hit.u = 0.0f;
    hit.v = 0.0f;
    return hit;
}

static inline uint segment_memory(const RenderParams* params, uint set, uint place) {
    return 2u * params->sampling.sets * params->sampling.paths_per_set +
           set * params->sampling.walked_per_set + place;
}

static inline void store_start(const LightPath* path, uint item, GLOBAL float4* memory) {
    memory[2u * item] = f4(path->origin.x, path->origin.y, path->origin.z, 0.0f);
    memory[2u * item + 1u] = f4(path->direction.x, path->direction.y, path->direction.z, 0.0f);
}

/// 1 where the path begins exactly as the stored one.
static inline int starts_alike(const LightPath* path, uint item, GLOBAL const float4* memory) {
    float4 o = memory[2u * item];
    float4 d = memory[2u * item + 1u];
    float3 from = path->origin;
    float3 way = path->direction;
    return as_bits(o.x) == as_bits(from.x) && as_bits(o.y) == as_bits(from.y) &&
                   as_bits(o.z) == as_bits(from.z) && as_bits(d.x) == as_bits(way.x) &&
                   as_bits(d.y) == as_bits(way.y) && as_bits(d.z) == as_bits(way.z)
               ? 1
               : 0;
}

static inline void store_hit(const RenderParams* params, Hit hit, uint set, uint place,
                             GLOBAL float4* memory) {
    memory[segment_memory(params, set, place)] = f4(from_bits(hit.triangle), hit.t, hit.u, hit.v);
}

static inline Hit load_hit(const RenderParams* params, uint set, uint place,
                           GLOBAL const float4* memory) {
    float4 kept = memory[segment_memory(params, set, place)];
    Hit hit;
    hit.triangle = as_bits(kept.x);
    hit.t = kept.y;
    hit.u = kept.z;
    hit.v = kept.w;
    return hit;
}

#endif
