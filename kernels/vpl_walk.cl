// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Virtual point lights by a quasi-random walk (Keller 1997): set k of frame f always has the Halton
// indices of block f sets + k, paths_per_set each. Fractional absorption: of a set's paths a fixed
// number survives to each bounce, whatever they hit, and their flux is scaled up accordingly. Which
// ones survive starts at a random place of the block: were they always its first, then in every
// block whose length shares a factor with a base they would come from the same strata.
//
// In participating media a path may be scattered before it meets a surface; its VPL is then that
// point of the medium.
#include "counters.h"
#include "light.h"
#include "medium_flight.h"
#include "surface.h"
#include "trace.h"

// A light path under way.
typedef struct {
    float3 origin, direction;
    float3 flux;  // W
    uint inside;  // boundaries of media around the origin
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
    path.inside = light.inside;
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

static inline void store_vpl(GLOBAL Vpl* vpl, uint kind, float3 position, float3 normal,
                             float3 flux, float bound, float roulette) {
    vpl->position = f4(position.x, position.y, position.z, bound);
    vpl->normal = f4(normal.x, normal.y, normal.z, from_bits(kind));
    vpl->flux = f4(flux.x, flux.y, flux.z, roulette);
    vpl->cone = f4(0.0f, 0.0f, 0.0f, 0.0f);
}

/// A slot whose path has ended: no VPL of an earlier frame stays there.
static inline void store_no_vpl(GLOBAL Vpl* vpl) {
    float3 none = f3(0.0f, 0.0f, 0.0f);
    store_vpl(vpl, VPL_SURFACE, none, f3(0.0f, 0.0f, 1.0f), none, 0.0f, 1.0f);
}

/// Number of a VPL in (0, 1]: those of consecutive VPLs, and so of a pixel's, cover it evenly.
static inline float roulette_number(uint seed, uint vpl) {
    uint bits = hash_bits(seed) + vpl * 2654435769u;  // 2^32 over the golden ratio
    return (float)((bits >> 8) + 1u) * 5.9604645e-8f;
}

// A path's place where it is scattered.
typedef struct {
    uint kind;
    float3 normal;  // of a surface; in media the direction in which light came
    float g;        // of a medium's phase function
} Vertex;

/// Follows the path to where it is scattered next, and its flux to what is scattered there.
/// Returns 0 where nothing is.
static inline int follow(const Params* params, Scene scene, const Geometry* geometry,
                         const Media* media, Random* random, LightPath* path, Vertex* vertex) {
    Hit hit = trace_closest(scene, path->origin, path->direction, RAY_INFINITY);
    int met = hit.triangle != NO_TRIANGLE ? 1 : 0;
    if (HAS(params, FEATURE_MEDIA)) {
        path->direction = normalize3(path->direction);
        Flight flight = fly(params, media, path->origin, path->direction,
                            met != 0 ? hit.t : RAY_INFINITY, path->inside, random);
        path->flux = path->flux * flight.weight;
        path->inside = flight.inside;
        if (flight.collides != 0) {
            path->origin += path->direction * flight.t;
            vertex->kind = VPL_MEDIUM;
            vertex->normal = path->direction;
            vertex->g = flight.g;
            return 1;
        }
    }
    if (met == 0) return 0;
    Surface surface = surface_at(params, geometry, hit, path->direction, 0.0f);
    path->flux = path->flux * surface.albedo;
    path->origin =
        surface.position + surface.normal * surface_offset(surface.position, params->extent);
    vertex->kind = VPL_SURFACE;
    vertex->normal = surface.normal;
    vertex->g = 0.0f;
    return 1;
}

/// Stores what the path scatters at a vertex: number `number` of all, `share` of its flux.
static inline void store_vertex(const Params* params, GLOBAL Vpl* vpl, const LightPath* path,
                                const Vertex* vertex, float share, uint number) {
    float scale = vertex->kind == VPL_SURFACE ? share * 0.318309886f : share;
    store_vpl(vpl, vertex->kind, path->origin, vertex->normal, path->flux * scale,
              params->vpl_bound, roulette_number(params->seed, number));
    if (HAS(params, FEATURE_MEDIA)) {
        vpl->cone.x = vertex->g;
        vpl->cone.w = radical_inverse(PRIME_POSITION_U, number, hash_pair(params->seed, 0x51u));
    }
}

static inline float3 scattered_direction(const Vertex* vertex, float u, float v) {
    if (vertex->kind == VPL_SURFACE) return turn_to(cosine_direction(u, v), vertex->normal);
    float density;
    return scatter_direction(vertex->g, vertex->normal, u, v, &density);
}

WEFT_KERNEL(vpl_walk)
(PARAMS, SCENE_ARGS, GEOMETRY_ARGS, LIGHT_ARGS, MEDIA_ARGS, GLOBAL Vpl* vpls,
 GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint item = params.first + GLOBAL_ID;
    uint set = item / params.paths_per_set;
    uint path_in_set = item % params.paths_per_set;
    uint block = params.frame * params.sets + set;
    uint turn = hash_pair(params.seed, block) % params.paths_per_set;
    uint index = block * params.paths_per_set + (path_in_set + turn) % params.paths_per_set;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    MEDIA_MAKE(through);
    LightPath path = emit_path(&params, &geometry, lights, emissive, index);
    Random random = make_random(params.seed, index, 0x1F83D9ABu);
    float share = 1.0f / ((float)params.paths_per_set * (float)params.sets);
    GLOBAL Vpl* set_vpls = vpls + set * params.vpls_per_set;
    uint rays = 0u;
    int alive = 1;
    for (uint bounce = 0u; bounce < params.bounces; ++bounce) {
        if (path_in_set >= params.survivors[bounce]) break;
        uint place = params.first_vpl[bounce] + path_in_set;
        if (max_component(path.flux) <= 0.0f) alive = 0;
        Vertex vertex;
        if (alive != 0) {
            ++rays;
            alive = follow(&params, scene, &geometry, &through, &random, &path, &vertex);
        }
        if (alive == 0) {
            store_no_vpl(set_vpls + place);
            continue;
        }
        // One bad value would reach every pixel that sees this VPL.
        if (is_finite3(path.flux) == 0) path.flux = f3(0.0f, 0.0f, 0.0f);
        float survival = (float)params.paths_per_set / (float)params.survivors[bounce];
        store_vertex(&params, set_vpls + place, &path, &vertex, share * survival,
                     block * params.vpls_per_set + place);
        if (bounce + 1u < params.bounces) {
            float u = radical_inverse(bounce_primes[2u * bounce], index, params.seed);
            float v = radical_inverse(bounce_primes[2u * bounce + 1u], index, params.seed);
            path.direction = scattered_direction(&vertex, u, v);
        }
    }
    count_rays(counters + params.counter, rays);
}
