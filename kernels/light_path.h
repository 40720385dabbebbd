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
#ifndef WEFT_LIGHT_PATH_H
#define WEFT_LIGHT_PATH_H

#include "light.h"
#include "medium_flight.h"
#include "surface.h"

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
static inline LightPath emit_path(const RenderParams* params, const Geometry* geometry,
                                  GLOBAL const LightRecord* lights,
                                  GLOBAL const EmissiveTriangle* emissive, uint index) {
    LightPath path;
    uint key = params->sampling.seed;
    float u = radical_inverse(PRIME_POSITION_U, index, key);
    float v = radical_inverse(PRIME_POSITION_V, index, key);
    float s = radical_inverse(PRIME_DIRECTION_U, index, key);
    float t = radical_inverse(PRIME_DIRECTION_V, index, key);
    float choice = radical_inverse(PRIME_LIGHT, index, key);
    LightRecord light = lights[choose_light(lights, params->scene.lights, &choice)];
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
        path.origin =
            point.position + normal * surface_offset(point.position, params->scene.extent);
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
        float radius = params->scene.bounding_sphere.w;
        path.direction = xyz(light.axis);
        if (light.kind == EMITTER_ENVIRONMENT) {
            path.direction = cone_direction(s, t, -1.0f);
            weight *= 12.5663706f;
        }
        float x, y;
        concentric_disk(u, v, &x, &y);
        float3 disk = turn_to(f3(x, y, 0.0f), path.direction);
        path.origin = xyz(params->scene.bounding_sphere) + (disk - path.direction * 1.5f) * radius;
        path.flux = power_of(light) * (weight * 3.14159265f * radius * radius);
    }
    return path;
}

/// Which path of all frames the `item`th is.
static inline uint path_index(const RenderParams* params, uint item) {
    uint set = item / params->sampling.paths_per_set;
    uint path_in_set = item % params->sampling.paths_per_set;
    uint block = params->sampling.sample * params->sampling.sets + set;
    uint turn = hash_pair(params->sampling.seed, block) % params->sampling.paths_per_set;
    return block * params->sampling.paths_per_set +
           (path_in_set + turn) % params->sampling.paths_per_set;
}

// A path's place where it is scattered.
typedef struct {
    uint kind;
    float3 normal;  // of a surface; in media the direction in which light came
    float g;        // of a medium's phase function
} Vertex;

/// Follows the path, which meets `hit` or nothing, to where it is scattered next, and its flux to
/// what is scattered there. Returns 0 where nothing is.
static inline int follow(const RenderParams* params, Hit hit, const Geometry* geometry,
                         const Media* media, Random* random, LightPath* path, Vertex* vertex) {
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
        surface.position + surface.normal * surface_offset(surface.position, params->scene.extent);
    vertex->kind = VPL_SURFACE;
    vertex->normal = surface.normal;
    vertex->g = 0.0f;
    return 1;
}

static inline float3 scattered_direction(const Vertex* vertex, float u, float v) {
    if (vertex->kind == VPL_SURFACE) return turn_to(cosine_direction(u, v), vertex->normal);
    float density;
    return scatter_direction(vertex->g, vertex->normal, u, v, &density);
}

/// Where the path goes from its vertex number `bounce`.
static inline float3 next_direction(const RenderParams* params, const Vertex* vertex, uint bounce,
                                    uint index) {
    float u = radical_inverse(bounce_primes[2u * bounce], index, params->sampling.seed);
    float v = radical_inverse(bounce_primes[2u * bounce + 1u], index, params->sampling.seed);
    return scattered_direction(vertex, u, v);
}

#endif
