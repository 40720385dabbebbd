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
#ifndef WEFT_KERNELS_PATH_LIGHT_PATH_H
#define WEFT_KERNELS_PATH_LIGHT_PATH_H

#include "kernels/bsdf/surface.h"
#include "kernels/light/light.h"
#include "kernels/media/medium_flight.h"

// A light path under way.
typedef struct {
    float3 origin, direction;
    float3 flux;  // W
    uint inside;  // boundaries of media around the origin
} LightPath;

/// First segment of a path: flux is the light's power over the probability of choosing it.
static inline LightPath emit_path(const RenderParams* params, const Geometry* geometry,
                                  GLOBAL const LightRecord* lights,
                                  GLOBAL const EmissiveTriangle* emissive, uint index) {
    uint key = params->sampling.seed;
    EmissionNumbers numbers;
    numbers.u = radical_inverse(PRIME_POSITION_U, index, key);
    numbers.v = radical_inverse(PRIME_POSITION_V, index, key);
    numbers.s = radical_inverse(PRIME_DIRECTION_U, index, key);
    numbers.t = radical_inverse(PRIME_DIRECTION_V, index, key);
    numbers.rest = radical_inverse(PRIME_LIGHT, index, key);
    LightRecord light = lights[choose_light(lights, params->scene.lights, &numbers.rest)];
    EmittedRay ray = emit_light(params, geometry, light, emissive, &numbers);
    LightPath path;
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.flux = ray.flux;
    path.inside = light.inside;
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
    float3 back;    // of a surface: the way back along the path, of any length
    Bsdf bsdf;      // of a surface
    float g;        // of a medium's phase function
} Vertex;

/// Follows the path, which meets `hit` or nothing, to where it is scattered next, and its flux to
/// what arrives there: what media scatter is scattered already. Returns 0 where nothing is.
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
    path->origin =
        surface.position + surface.normal * surface_offset(surface.position, params->scene.extent);
    vertex->kind = VPL_SURFACE;
    vertex->normal = surface.normal;
    vertex->back = surface.back;
    vertex->bsdf = surface.bsdf;
    vertex->g = 0.0f;
    return 1;
}

/// The flux, or 0 where it is not finite: one bad value would reach every pixel that sees its VPL.
static inline float3 finite_flux(float3 flux) {
    return is_finite3(flux) != 0 ? flux : f3(0.0f, 0.0f, 0.0f);
}

/// Flux that a VPL at the vertex stands for: of a surface what it reflects diffusely.
static inline float3 vpl_flux(const LightPath* path, const Vertex* vertex) {
    if (vertex->kind != VPL_SURFACE) return finite_flux(path->flux);
    return finite_flux(path->flux * bsdf_diffuse_albedo(&vertex->bsdf));
}

/// Sends the path on from its vertex number `bounce`, and its flux to what is scattered there.
static inline void scatter_light_path(const RenderParams* params, const Vertex* vertex, uint bounce,
                                      uint index, LightPath* path) {
    float u = radical_inverse(bounce_primes[2u * bounce], index, params->sampling.seed);
    float v = radical_inverse(bounce_primes[2u * bounce + 1u], index, params->sampling.seed);
    if (vertex->kind == VPL_SURFACE) {
        // By reciprocity the way that light came takes the place of the way to the camera.
        float3 out = local_direction(normalize3(vertex->back), vertex->normal);
        BsdfSample sample = bsdf_sample(&vertex->bsdf, out, u, v);
        path->direction = turn_to(sample.in, vertex->normal);
        path->flux = finite_flux(path->flux * sample.weight);
        return;
    }
    float density;
    path->direction = scatter_direction(vertex->g, vertex->normal, u, v, &density);
    path->flux = finite_flux(path->flux);
}

#endif
