// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Virtual point lights by a quasi-random walk (Keller 1997): set k of frame f always has the Halton
// indices of block f sets + k, paths_per_set each. Fractional absorption: of a set's paths a fixed
// number survives to each bounce, whatever they hit, and their flux is scaled up accordingly. Which
// ones survive starts at a random place of the block: were they always its first, then in every
// block whose length shares a factor with a base they would come from the same strata.
#include "counters.h"
#include "light.h"
#include "surface.h"
#include "trace.h"

// A light path under way.
typedef struct {
    float3 origin, direction;
    float3 flux;  // W
} LightPath;

static inline float3 power_of(LightRecord light) {
    return xyz(light.power);
}

/// First segment of a path: flux is the light's power over the probability of choosing it.
static inline LightPath emit_path(const Params* params, const Geometry* geometry,
                                  GLOBAL const LightRecord* lights,
                                  GLOBAL const EmissiveTriangle* emissive, uint index) {
    LightPath path;
    uint key = params->seed;
    float u = radical_inverse(PRIME_POSITION_U, index, key);
    float v = radical_inverse(PRIME_POSITION_V, index, key);
    float s = radical_inverse(PRIME_DIRECTION_U, index, key);
    float t = radical_inverse(PRIME_DIRECTION_V, index, key);
    float choice = radical_inverse(PRIME_LIGHT, index, key);
    LightRecord light = lights[choose_light(lights, params->lights, &choice)];
    float weight = 1.0f / light.probability;
    if (light.kind == EMITTER_AREA) {
        LightPoint point = sample_area(geometry, light, emissive, u, v);
        float3 normal = point.normal;
        if (light.both_sides != 0u) {
            normal = choice < 0.5f ? normal : -normal;
            weight *= 2.0f;
        }
        path.direction = turn_to(cosine_direction(s, t), normal);
        path.origin = point.position + normal * surface_offset(point.position, params->extent);
        path.flux = power_of(light) * (weight * 3.14159265f * light.area);
    } else if (light.kind == EMITTER_POINT || light.kind == EMITTER_SPOT) {
        float limit = light.kind == EMITTER_SPOT ? light.cos_outer : -1.0f;
        float3 about_z = cone_direction(s, t, limit);
        path.direction = turn_to(about_z, xyz(light.axis));
        path.origin = xyz(light.position);
        weight *= 6.28318531f * (1.0f - limit);
        if (light.kind == EMITTER_SPOT)
            weight *= spot_falloff(about_z.z, light.cos_inner, light.cos_outer);
        path.flux = power_of(light) * weight;
    } else {
        float radius = params->scene_centre.w;
        path.direction = xyz(light.axis);
        if (light.kind == EMITTER_ENVIRONMENT) {
            path.direction = cone_direction(s, t, -1.0f);
            weight *= 12.5663706f;
        }
        float x, y;
        concentric_disk(u, v, &x, &y);
        float3 disk = turn_to(f3(x, y, 0.0f), path.direction);
        path.origin = xyz(params->scene_centre) + (disk - path.direction * 1.5f) * radius;
        path.flux = power_of(light) * (weight * 3.14159265f * radius * radius);
    }
    return path;
}

static inline void store_vpl(GLOBAL Vpl* vpl, float3 position, float3 normal, float3 flux,
                             float bound, float roulette) {
    vpl->position = f4(position.x, position.y, position.z, bound);
    vpl->normal = f4(normal.x, normal.y, normal.z, from_bits(VPL_SURFACE));
    vpl->flux = f4(flux.x, flux.y, flux.z, roulette);
    vpl->cone = f4(0.0f, 0.0f, 0.0f, 0.0f);
}

/// Number of a VPL in (0, 1]: those of consecutive VPLs, and so of a pixel's, cover it evenly.
static inline float roulette_number(uint seed, uint vpl) {
    uint bits = hash_bits(seed) + vpl * 2654435769u;  // 2^32 over the golden ratio
    return (float)((bits >> 8) + 1u) * 5.9604645e-8f;
}

WEFT_KERNEL(vpl_walk)
(PARAMS, SCENE_ARGS, GEOMETRY_ARGS, LIGHT_ARGS, GLOBAL Vpl* vpls, GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint item = params.first + GLOBAL_ID;
    uint set = item / params.paths_per_set;
    uint path_in_set = item % params.paths_per_set;
    uint block = params.frame * params.sets + set;
    uint turn = hash_pair(params.seed, block) % params.paths_per_set;
    uint index = block * params.paths_per_set + (path_in_set + turn) % params.paths_per_set;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    LightPath path = emit_path(&params, &geometry, lights, emissive, index);
    float share = 1.0f / ((float)params.paths_per_set * (float)params.sets);
    GLOBAL Vpl* set_vpls = vpls + set * params.vpls_per_set;
    uint rays = 0u;
    int alive = 1;
    for (uint bounce = 0u; bounce < params.bounces; ++bounce) {
        if (path_in_set >= params.survivors[bounce]) break;
        GLOBAL Vpl* vpl = set_vpls + params.first_vpl[bounce] + path_in_set;
        if (max_component(path.flux) <= 0.0f) alive = 0;
        Hit hit;
        hit.triangle = NO_TRIANGLE;
        if (alive != 0) {
            hit = trace_closest(scene, path.origin, path.direction, RAY_INFINITY);
            ++rays;
        }
        if (hit.triangle == NO_TRIANGLE) {
            // Every survivor's slot is written, so that no VPL of an earlier frame stays.
            store_vpl(vpl, f3(0.0f, 0.0f, 0.0f), f3(0.0f, 0.0f, 1.0f), f3(0.0f, 0.0f, 0.0f), 0.0f,
                      1.0f);
            alive = 0;
            continue;
        }
        Surface surface = surface_at(&params, &geometry, hit, path.direction, 0.0f);
        path.flux = path.flux * surface.albedo;
        // One bad value would reach every pixel that sees this VPL.
        if (is_finite3(path.flux) == 0) path.flux = f3(0.0f, 0.0f, 0.0f);
        path.origin =
            surface.position + surface.normal * surface_offset(surface.position, params.extent);
        float survival = (float)params.paths_per_set / (float)params.survivors[bounce];
        store_vpl(vpl, path.origin, surface.normal, path.flux * (share * survival * 0.318309886f),
                  params.vpl_bound,
                  roulette_number(params.seed, block * params.vpls_per_set +
                                                   params.first_vpl[bounce] + path_in_set));
        if (bounce + 1u < params.bounces) {
            float u = radical_inverse(bounce_primes[2u * bounce], index, params.seed);
            float v = radical_inverse(bounce_primes[2u * bounce + 1u], index, params.seed);
            path.direction = turn_to(cosine_direction(u, v), surface.normal);
        }
    }
    count_rays(counters + params.counter, rays);
}
