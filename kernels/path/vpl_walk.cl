// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Traces the light paths of a frame and leaves virtual point lights at their vertices
// (light_path.h). With FEATURE_TEMPORAL the hits of segments are stored from frame to frame, and
// only invalid segments are traced again (vpl_invalidation.cl). One work-item per light path.
#include "kernels/bvh/trace.h"
#include "kernels/cache/cache.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/path/light_path.h"
#include "kernels/path/light_path_cache.h"

static inline void store_vpl(GLOBAL Vpl* vpl, uint kind, float3 position, float3 normal,
                             float3 flux, float bound, float roulette) {
    vpl->position = f4(position.x, position.y, position.z, bound);
    vpl->normal = f4(normal.x, normal.y, normal.z, from_bits(kind));
    vpl->flux = f4(flux.x, flux.y, flux.z, roulette);
    vpl->cone = f4(0.0f, 0.0f, 0.0f, 0.0f);
}

/// Empties the slot of a path that has ended, so that no VPL of an earlier frame stays there.
static inline void store_no_vpl(GLOBAL Vpl* vpl) {
    float3 none = f3(0.0f, 0.0f, 0.0f);
    store_vpl(vpl, VPL_SURFACE, none, f3(0.0f, 0.0f, 1.0f), none, 0.0f, 1.0f);
}

/// Random number of a VPL for roulette, in (0, 1]. Those of consecutive VPLs, and so of a pixel's,
/// cover it evenly.
static inline float roulette_number(uint seed, uint vpl) {
    uint bits = hash_bits(seed) + vpl * 2654435769u;  // 2^32 over the golden ratio
    return (float)((bits >> 8) + 1u) * 5.9604645e-8f;
}

/// Stores the VPL of a vertex, number `number` of all, with `share` of the path's flux. On a
/// surface that is divided by pi, as the radiance that the flux makes.
static inline void store_vertex(const RenderParams* params, GLOBAL Vpl* vpl, const LightPath* path,
                                const Vertex* vertex, float share, uint number) {
    float scale = vertex->kind == VPL_SURFACE ? LAMBERT_REFLECTANCE(share) : share;
    store_vpl(vpl, vertex->kind, path->origin, vertex->normal, vpl_flux(path, vertex) * scale,
              params->sampling.vpl_bound, roulette_number(params->sampling.seed, number));
    if (HAS(params, FEATURE_MEDIA)) {
        vpl->cone.x = vertex->g;
        vpl->cone.w =
            radical_inverse(PRIME_POSITION_U, number, hash_pair(params->sampling.seed, 0x51u));
    }
}

static inline int differ(float4 a, float4 b) {
    return as_bits(a.x) != as_bits(b.x) || as_bits(a.y) != as_bits(b.y) ||
                   as_bits(a.z) != as_bits(b.z) || as_bits(a.w) != as_bits(b.w)
               ? 1
               : 0;
}

static inline Vpl no_vpl(void) {
    Vpl vpl;
    vpl.position = f4(0.0f, 0.0f, 0.0f, 0.0f);
    vpl.normal = vpl.position;
    vpl.flux = vpl.position;
    vpl.cone = vpl.position;
    return vpl;
}

/// How a VPL has changed: VPL_* of cache.h. One that was dark counts as moved, since it is not
/// known which records see it.
static inline uint change_of(const Vpl* before, GLOBAL const Vpl* vpl) {
    uint change = differ(before->flux, vpl->flux) != 0 ? VPL_RECOLOURED : 0u;
    if (differ(before->position, vpl->position) != 0 || differ(before->normal, vpl->normal) != 0 ||
        differ(before->cone, vpl->cone) != 0 || !(max_component(xyz(before->flux)) > 0.0f))
        change |= VPL_MOVED;
    return change;
}

WEFT_KERNEL(vpl_walk)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    uint set = item / params.sampling.paths_per_set;
    uint path_in_set = item % params.sampling.paths_per_set;
    uint index = path_index(&params, item);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    MEDIA_MAKE(through);
    ENVIRONMENT_MAKE(environment);
    LightPath path = emit_path(&params, &geometry, lights, emissive, &environment, index);
    Random random = make_random(params.sampling.seed, index, 0x1F83D9ABu);
    float share = 1.0f / ((float)params.sampling.paths_per_set * (float)params.sampling.sets);
    uint block = params.sampling.sample * params.sampling.sets + set;
    uint known = 0u;
    if (HAS(&params, FEATURE_TEMPORAL)) {
        known = known_segments[item];
        store_start(&path, item, light_path_cache);
    }
    uint rays = 0u;
    int alive = 1;
    for (uint bounce = 0u; bounce < params.sampling.bounces; ++bounce) {
        if (path_in_set >= params.sampling.survivors[bounce]) break;
        uint place = params.sampling.first_vpl[bounce] + path_in_set;
        GLOBAL Vpl* vpl = vpls + set * params.sampling.walked_per_set + place;
        Vpl before = no_vpl();
        if (HAS(&params, FEATURE_TEMPORAL)) before = *vpl;
        if (max_component(path.flux) <= 0.0f) alive = 0;
        Vertex vertex;
        Hit hit = no_segment();
        if (alive != 0) {
            if (bounce < known) {
                hit = load_hit(&params, set, place, light_path_cache);
            } else {
                ++rays;
                hit = trace_closest(scene, path.origin, path.direction, RAY_INFINITY);
            }
            alive = scatter(&params, hit, &geometry, &through, &random, &path, &vertex);
        }
        if (HAS(&params, FEATURE_TEMPORAL)) store_hit(&params, hit, set, place, light_path_cache);
        if (alive == 0) {
            store_no_vpl(vpl);
        } else {
            float survival =
                (float)params.sampling.paths_per_set / (float)params.sampling.survivors[bounce];
            store_vertex(&params, vpl, &path, &vertex, share * survival,
                         block * params.sampling.walked_per_set + place);
            if (bounce + 1u < params.sampling.bounces)
                scatter_light_path(&params, &vertex, bounce, index, &path);
        }
        if (HAS(&params, FEATURE_TEMPORAL))
            vpl_changes[set * params.sampling.walked_per_set + place] = change_of(&before, vpl);
    }
    count_rays(counters + range.counter, rays);
}
