// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Light paths by a quasi-random walk, whose vertices become VPLs (Keller 1997): set k of frame f
// always has the Halton indices of block f sets + k, paths_per_set each. Fractional absorption: of
// a set's paths a fixed number survives to each bounce, whatever they hit, and their flux is scaled
// up accordingly. The survivors begin at a random place of the block: were they always its first
// paths, then wherever paths_per_set shares a factor with a base they would come from the same
// strata in every block.
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
    float3 flux;           // W
    uint enclosing_media;  // boundaries of media around the origin
} LightPath;

/// First segment of a path: flux is the light's power over the probability of choosing it.
static inline LightPath emit_path(const RenderParams* params, const Geometry* geometry,
                                  GLOBAL const LightRecord* lights,
                                  GLOBAL const EmissiveTriangle* emissive,
                                  const EnvironmentImage* environment, uint index) {
    uint key = params->sampling.seed;
    EmissionNumbers numbers;
    numbers.u = radical_inverse(PRIME_POSITION_U, index, key);
    numbers.v = radical_inverse(PRIME_POSITION_V, index, key);
    numbers.s = radical_inverse(PRIME_DIRECTION_U, index, key);
    numbers.t = radical_inverse(PRIME_DIRECTION_V, index, key);
    numbers.rest = radical_inverse(PRIME_LIGHT, index, key);
    LightRecord light = lights[choose_light(lights, params->scene.lights, &numbers.rest)];
    EmittedRay ray = emit_light(params, geometry, light, emissive, environment, &numbers);
    LightPath path;
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.flux = ray.flux;
    path.enclosing_media = light.enclosing_media;
    return path;
}

/// Halton index of the `item`th path of the frame.
static inline uint path_index(const RenderParams* params, uint item) {
    uint set = item / params->sampling.paths_per_set;
    uint path_in_set = item % params->sampling.paths_per_set;
    uint block = params->sampling.sample * params->sampling.sets + set;
    uint turn = hash_pair(params->sampling.seed, block) % params->sampling.paths_per_set;
    return block * params->sampling.paths_per_set +
           (path_in_set + turn) % params->sampling.paths_per_set;
}

// A vertex of a light path: where it is scattered.
typedef struct {
    uint kind;
    float3 normal;  // of a surface; in media the direction in which light came
    float3 back;    // of a surface: the way back along the path, of any length
    Bsdf bsdf;      // of a surface
    float g;        // of a medium's phase function
} Vertex;

/// Follows the path, which meets `hit` or nothing, to its next vertex, and its flux to what arrives
/// there: in a medium, times the medium's albedo. Returns 0 where the path has no further vertex.
static inline int scatter(const RenderParams* params, Hit hit, const Geometry* geometry,
                          const Media* media, Random* random, LightPath* path, Vertex* vertex) {
    int met = hit.triangle != INVALID_INDEX ? 1 : 0;
    if (HAS(params, FEATURE_MEDIA)) {
        path->direction = normalize3(path->direction);
        Flight flight =
            sample_free_path(params, media, path->origin, path->direction,
                             met != 0 ? hit.t : RAY_INFINITY, path->enclosing_media, random);
        path->flux = path->flux * flight.weight;
        path->enclosing_media = flight.enclosing_media;
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
    vertex->back = -path->direction;
    vertex->bsdf = surface.bsdf;
    vertex->g = 0.0f;
    return 1;
}

/// The flux, or 0 where it is not finite: one bad value would reach every pixel that sees its VPL.
static inline float3 finite_flux(float3 flux) {
    return is_finite3(flux) != 0 ? flux : f3(0.0f, 0.0f, 0.0f);
}

/// Flux of the VPL at the vertex: on a surface, what that reflects diffusely.
static inline float3 vpl_flux(const LightPath* path, const Vertex* vertex) {
    if (vertex->kind != VPL_SURFACE) return finite_flux(path->flux);
    return finite_flux(path->flux * bsdf_diffuse_albedo(&vertex->bsdf));
}

/// Samples the direction in which the path leaves its vertex number `bounce`, and scales its flux
/// by what is scattered that way.
static inline void scatter_light_path(const RenderParams* params, const Vertex* vertex, uint bounce,
                                      uint index, LightPath* path) {
    float u = radical_inverse(bounce_primes[2u * bounce], index, params->sampling.seed);
    float v = radical_inverse(bounce_primes[2u * bounce + 1u], index, params->sampling.seed);
    if (vertex->kind == VPL_SURFACE) {
        // By reciprocity the way that light came takes the place of the way to the camera.
        float3 out = local_direction(normalize3(vertex->back), vertex->normal);
        BsdfSample sample = bsdf_sample(&vertex->bsdf, out, u, v);
        path->direction = to_world(sample.in, vertex->normal);
        path->flux = finite_flux(path->flux * sample.weight);
        return;
    }
    float pdf;
    path->direction = scatter_direction(vertex->g, vertex->normal, u, v, &pdf);
    path->flux = finite_flux(path->flux);
}

#endif
