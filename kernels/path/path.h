// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Follows a path from a surface on: next-event estimation and scattered rays, weighted against each
// other (path_lights.h), without a bound on geometry terms. Only Russian roulette ends the path.
#ifndef WEFT_KERNELS_PATH_PATH_H
#define WEFT_KERNELS_PATH_PATH_H

#include "kernels/core/random.h"
#include "kernels/path/path_lights.h"

// The range of roulette's survival probability. The largest keeps paths between white walls from
// going on for ever; where the square of the reflectance exceeds it, the variance is infinite.
#define ROULETTE_LEAST 0.05f
#define ROULETTE_MOST 0.999f

#define ROULETTE_START 3u  // surfaces and media that every path may be scattered by

// Throughput down to which camera paths go on without roulette. Ending more of them is quicker, and
// noisier: survivors carry the weight of those that end. Of 0.1, 0.2, 0.4 and 1 it has the least
// variance times time in five scenes (docs/results/algorithms.md).
#define ROULETTE_LEVEL 0.2f

// A path under way.
typedef struct {
    Surface surface;
    float3 origin;       // the surface's point, moved off
    float3 throughput;   // of the path up to the surface, without the surface's BSDF
    float survival;      // 1 over the probability of going on from here, by roulette
    float light_weight;  // of light that is added at this surface
    uint bounce;         // surfaces so far
} PathVertex;

// Light that a path has found.
typedef struct {
    float3 direct;    // by its first surface
    float3 indirect;  // by all later ones
} PathLight;

static inline void add_light(const RenderParams* params, PathLight* sum, const PathVertex* vertex,
                             float3 light) {
    float3 weighted = light * vertex->light_weight;
    if (vertex->bounce == 1u) {
        if (HAS(params, FEATURE_SAMPLED_DIRECT)) sum->direct += weighted;
    } else {
        sum->indirect += weighted;
    }
}

/// Throughput of the path after scattering at the vertex by the factor `colour`.
static inline float3 scattered_throughput(const PathVertex* vertex, float3 colour) {
    return vertex->throughput * colour * vertex->survival;
}

/// Largest channel of the throughput that the vertex scatters, before roulette.
static inline float most_scattered(const PathVertex* vertex) {
    return max_component(vertex->throughput *
                         bsdf_albedo(&vertex->surface.bsdf, vertex->surface.out));
}

/// Moves to a surface that was hit. Returns 0 where it scatters nothing.
static inline int enter_surface(const RenderParams* params, PathVertex* vertex, float3 throughput) {
    vertex->origin =
        vertex->surface.position +
        vertex->surface.normal * surface_offset(vertex->surface.position, params->scene.extent);
    vertex->throughput = throughput;
    vertex->survival = 1.0f;
    ++vertex->bounce;
    return most_scattered(vertex) > 0.0f ? 1 : 0;
}

/// Next-event estimation: adds what one chosen light sends to the vertex, and that scatters into
/// the path. Returns the number of shadow rays.
static inline uint next_event(const RenderParams* params, const PathScene* world,
                              const PathVertex* vertex, Random* random, PathLight* sum) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    if (world->light_count == 0u) return 0u;
    LightSample light =
        sample_lights(params, world, &vertex->surface, vertex->origin, choice, u, v);
    float3 out = vertex->surface.out;
    float3 irradiance = weighted_irradiance(&light, bsdf_pdf(&vertex->surface.bsdf, out, light.in));
    if (!(max_component(irradiance) > 0.0f)) return 0u;
    int seen = light.distant != 0 ? sees_infinity(world->scene, params, light.origin, light.towards)
                                  : sees_point(world->scene, params, light.origin, light.towards);
    if (seen != 0) {
        BsdfValue value = bsdf_eval(&vertex->surface.bsdf, out, light.in);
        add_light(params, sum, vertex,
                  scattered_throughput(vertex, value.colour) * irradiance * value.share);
    }
    return 1u;
}

/// MIS weight of emission that a ray met after `t`, which was scattered at `from` with pdf `pdf`.
static inline float emission_weight(const RenderParams* params, const PathScene* world,
                                    const LitPoint* from, const Surface* surface, float3 direction,
                                    float t, float pdf) {
    float other =
        met_light_pdf(params, &world->geometry, world->lights, world->emissive, surface->triangle,
                      surface->instance, surface->normal, direction, t);
    if (other > 0.0f)
        other *=
            probability_at(params, world, from, world->geometry.instances[surface->instance].light);
    return other > 0.0f ? power_heuristic(pdf, other) : 1.0f;
}

/// Radiance of the environment along a ray that meets nothing, which was scattered at `from` with
/// pdf `pdf`, times its MIS weight.
static inline float3 weighted_environment(const RenderParams* params, const PathScene* world,
                                          const LitPoint* from, float3 direction, float pdf) {
    float other;
    float3 radiance = environment_met(params, &world->environment, direction, &other);
    if (other > 0.0f) other *= probability_at(params, world, from, environment_index(params));
    return other > 0.0f ? radiance * power_heuristic(pdf, other) : radiance;
}

/// Scatters the path and follows it to the next surface. Returns 0 where it ends.
static inline int scatter(const RenderParams* params, const PathScene* world, PathVertex* vertex,
                          Random* random, PathLight* sum, uint* rays) {
    float u = next_random(random);
    float v = next_random(random);
    BsdfSample sample = bsdf_sample(&vertex->surface.bsdf, vertex->surface.out, u, v);
    float3 direction = to_world(sample.in, vertex->surface.shading);
    LitPoint lit = lit_point(&vertex->surface);
    if (faces(&lit, direction) == 0) return 0;
    float3 throughput = scattered_throughput(vertex, sample.weight);
    Hit hit = trace_closest(world->scene, vertex->origin, direction, RAY_INFINITY);
    ++*rays;
    if (hit.triangle == INVALID_INDEX) {
        if (HAS(params, FEATURE_ENVIRONMENT))
            add_light(
                params, sum, vertex,
                throughput * weighted_environment(params, world, &lit, direction, sample.pdf));
        return 0;
    }
    vertex->surface = surface_at(params, &world->geometry, hit, direction, 0.0f);
    if (max_component(vertex->surface.emission) > 0.0f)
        add_light(params, sum, vertex,
                  throughput * vertex->surface.emission *
                      emission_weight(params, world, &lit, &vertex->surface, direction, hit.t,
                                      sample.pdf));
    return enter_surface(params, vertex, throughput);
}

/// Russian roulette, from surface number `start` on, for paths that scatter less than `level`, up
/// to which survivors are raised. Returns 0 where the path ends.
static inline int survives(PathVertex* vertex, uint start, float level, Random* random) {
    float draw = next_random(random);
    if (vertex->bounce < start) return 1;
    float q = m_clamp(most_scattered(vertex) / level, ROULETTE_LEAST, ROULETTE_MOST);
    if (draw >= q) return 0;
    vertex->survival = 1.0f / q;
    return 1;
}

#endif
