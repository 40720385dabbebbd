// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference: path tracing without bounds or a longest path (path.h). A work-item traces
// Params::samples samples of one pixel and adds them to the film's exact sums.
#include "camera.h"
#include "counters.h"
#include "film_sums.h"
#include "guard.h"
#include "path.h"

#define ROULETTE_START 3u  // surfaces that every path may reach

// One sample: what the film keeps of it.
typedef struct {
    float3 emission;
    PathLight light;
    float3 albedo, normal;
    float depth;
} PathSample;

static inline PathSample trace_path(const Params* params, const PathScene* world, uint pixel,
                                    Random* random, uint* rays) {
    PathSample sample;
    float3 black = f3(0.0f, 0.0f, 0.0f);
    sample.emission = black;
    sample.light.direct = black;
    sample.light.indirect = black;
    sample.albedo = black;
    sample.normal = black;
    sample.depth = 0.0f;
    float x = next_random(random);
    float y = next_random(random);
    if (params->through_centres != 0u) {
        x = 0.5f;
        y = 0.5f;
    }
    float3 direction = camera_direction(params, (float)(pixel % params->width) + x,
                                        (float)(pixel / params->width) + y);
    Hit hit = trace_closest(world->scene, xyz(params->camera_origin), direction, RAY_INFINITY);
    ++*rays;
    if (hit.triangle == NO_TRIANGLE) {
        if (HAS(params, FEATURE_ENVIRONMENT)) sample.emission = xyz(params->environment);
        return sample;
    }
    PathVertex vertex;
    vertex.bounce = 0u;
    vertex.light_weight = 1.0f;
    vertex.surface = surface_at(params, &world->geometry, hit, direction, params->texture_angle);
    sample.emission = vertex.surface.emission;
    sample.albedo = vertex.surface.albedo;
    sample.normal = vertex.surface.shading;
    sample.depth = hit.t;
    int goes_on = enter_surface(params, &vertex, f3(1.0f, 1.0f, 1.0f));
    while (goes_on != 0) {
        *rays += next_event(params, world, &vertex, random, &sample.light);
        goes_on = scatter(params, world, &vertex, random, &sample.light, rays);
        if (!HAS(params, FEATURE_INDIRECT)) break;
        if (goes_on != 0) goes_on = survives(&vertex, ROULETTE_START, random);
    }
    return sample;
}

static inline void add_plane(GLOBAL uint* sums, uint pixels, uint plane, float value) {
    add_to_sum(sums + plane * FILM_SUM_WORDS * pixels, pixels, FILM_SUM_WORDS, value,
               FILM_SUM_SHIFT);
}

static inline void add_planes(GLOBAL uint* sums, uint pixels, uint plane, float3 value) {
    add_plane(sums, pixels, plane, value.x);
    add_plane(sums, pixels, plane + 1u, value.y);
    add_plane(sums, pixels, plane + 2u, value.z);
}

static inline void add_square(GLOBAL uint* sums, uint pixels, uint channel, float value) {
    GLOBAL uint* words =
        sums + (FILM_PLANES * FILM_SUM_WORDS + channel * FILM_SQUARE_WORDS) * pixels;
    add_to_sum(words, pixels, FILM_SQUARE_WORDS, value * value, FILM_SQUARE_SHIFT);
}

WEFT_KERNEL(path)
(PARAMS, SCENE_ARGS, GEOMETRY_ARGS, LIGHT_ARGS, GLOBAL uint* film_sums, GLOBAL RayCounter* counters,
 GLOBAL NonfiniteCounter* nonfinite) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    uint pixels = params.width * params.height;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    PathScene world = {scene, geometry, lights, emissive, params.choice_lights};
    GLOBAL uint* sums = film_sums + pixel;
    uint rays = 0u;
    for (uint i = 0u; i < params.samples; ++i) {
        Random random = make_random(params.seed, pixel, params.frame + i);
        PathSample sample = trace_path(&params, &world, pixel, &random, &rays);
        // Scaled by a power of two, so that the sums' range fits the scene's light.
        float3 emission =
            guard(nonfinite, COMPONENT_EMISSION, pixel, sample.emission) * params.film_scale;
        float3 direct =
            guard(nonfinite, COMPONENT_DIRECT, pixel, sample.light.direct) * params.film_scale;
        float3 indirect =
            guard(nonfinite, COMPONENT_INDIRECT, pixel, sample.light.indirect) * params.film_scale;
        add_planes(sums, pixels, FILM_EMISSION, emission);
        add_planes(sums, pixels, FILM_DIRECT, direct);
        add_planes(sums, pixels, FILM_INDIRECT, indirect);
        add_planes(sums, pixels, FILM_ALBEDO,
                   guard(nonfinite, COMPONENT_SURFACE, pixel, sample.albedo));
        add_planes(sums, pixels, FILM_NORMAL, sample.normal);
        add_plane(sums, pixels, FILM_DEPTH, sample.depth);
        float3 beauty = emission + direct + indirect;
        add_square(sums, pixels, 0u, beauty.x);
        add_square(sums, pixels, 1u, beauty.y);
        add_square(sums, pixels, 2u, beauty.z);
    }
    count_rays(counters + params.counter, rays);
}
