// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference: path tracing with next-event estimation and scattered rays, weighted against each
// other (path_lights.h), without bounds or a longest path. Russian roulette ends paths. A work-item
// traces Params::samples samples of one pixel and adds them to the film's exact sums.
#include "camera.h"
#include "counters.h"
#include "film_sums.h"
#include "guard.h"
#include "path_lights.h"
#include "random.h"

// Bounces before roulette begins, and the range of its survival probability. The largest keeps
// paths between white walls from going on for ever; where the square of the reflectance exceeds
// it, the variance is infinite.
#define ROULETTE_START 3u
#define ROULETTE_LEAST 0.05f
#define ROULETTE_MOST 0.999f

// One sample: what the film keeps of it.
typedef struct {
    float3 emission, direct, indirect;
    float3 albedo, normal;
    float depth;
} PathSample;

// A path under way.
typedef struct {
    Surface surface;
    float3 origin;      // the surface's point, moved off
    float3 throughput;  // of the path up to and with the surface's reflectance
    uint bounce;        // surfaces so far
} PathVertex;

typedef struct {
    Scene scene;
    Geometry geometry;
    GLOBAL const LightRecord* lights;
    GLOBAL const EmissiveTriangle* emissive;
    uint light_count;  // that next-event estimation chooses from
} PathScene;

static inline void add_light(const Params* params, PathSample* sample, uint bounce, float3 light) {
    if (bounce == 1u) {
        if (HAS(params, FEATURE_SAMPLED_DIRECT)) sample->direct += light;
    } else {
        sample->indirect += light;
    }
}

/// Moves to a surface that was hit along `direction`. Returns 0 where nothing goes on from it.
static inline int enter_surface(const Params* params, PathVertex* vertex, float3 throughput) {
    vertex->origin =
        vertex->surface.position +
        vertex->surface.normal * surface_offset(vertex->surface.position, params->extent);
    vertex->throughput = throughput * vertex->surface.albedo;
    ++vertex->bounce;
    return max_component(vertex->throughput) > 0.0f ? 1 : 0;
}

/// Light of one chosen light by the vertex.
static inline uint next_event(const Params* params, const PathScene* world,
                              const PathVertex* vertex, Random* random, PathSample* sample) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    if (world->light_count == 0u) return 0u;
    LightSample light =
        sample_lights(params, &world->geometry, world->lights, world->light_count, world->emissive,
                      &vertex->surface, vertex->origin, choice, u, v);
    if (!(max_component(light.irradiance) > 0.0f)) return 0u;
    int seen = light.distant != 0 ? sees_infinity(world->scene, params, light.origin, light.towards)
                                  : sees_point(world->scene, params, light.origin, light.towards);
    if (seen != 0)
        add_light(params, sample, vertex->bounce,
                  vertex->throughput * light.irradiance * 0.318309886f);
    return 1u;
}

/// Weight of emission that a scattered ray of density `density` met after `t`.
static inline float emission_weight(const PathScene* world, const Surface* surface,
                                    float3 direction, float t, float density) {
    uint index = world->geometry.instances[surface->instance].light;
    if (index == NO_TRIANGLE) return 1.0f;
    LightRecord light = world->lights[index];
    float facing = -dot3(direction, surface->normal);
    if (!(facing > 0.0f)) return 1.0f;
    return power_heuristic(density, (t / facing) * (t / light.area) * light.choice_probability);
}

/// Scatters the path and follows it to the next surface. Returns 0 where it ends.
static inline int scatter(const Params* params, const PathScene* world, PathVertex* vertex,
                          Random* random, PathSample* sample, uint* rays) {
    float u = next_random(random);
    float v = next_random(random);
    float3 about_z = cosine_direction(u, v);
    float3 direction = normalize3(turn_to(about_z, vertex->surface.shading));
    if (faces(&vertex->surface, direction) == 0) return 0;
    float density = about_z.z * 0.318309886f;
    Hit hit = trace_closest(world->scene, vertex->origin, direction, RAY_INFINITY);
    ++*rays;
    if (hit.triangle == NO_TRIANGLE) {
        if (HAS(params, FEATURE_ENVIRONMENT))
            add_light(params, sample, vertex->bounce,
                      vertex->throughput * xyz(params->environment));
        return 0;
    }
    vertex->surface = surface_at(params, &world->geometry, hit, direction, 0.0f);
    if (max_component(vertex->surface.emission) > 0.0f)
        add_light(params, sample, vertex->bounce,
                  vertex->throughput * vertex->surface.emission *
                      emission_weight(world, &vertex->surface, direction, hit.t, density));
    return enter_surface(params, vertex, vertex->throughput);
}

/// Russian roulette. Returns 0 where the path ends.
static inline int survives(PathVertex* vertex, Random* random) {
    float draw = next_random(random);
    if (vertex->bounce < ROULETTE_START) return 1;
    float q = m_clamp(max_component(vertex->throughput), ROULETTE_LEAST, ROULETTE_MOST);
    if (draw >= q) return 0;
    vertex->throughput = vertex->throughput * (1.0f / q);
    return 1;
}

static inline PathSample trace_path(const Params* params, const PathScene* world, uint pixel,
                                    Random* random, uint* rays) {
    PathSample sample;
    float3 black = f3(0.0f, 0.0f, 0.0f);
    sample.emission = black;
    sample.direct = black;
    sample.indirect = black;
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
    vertex.surface = surface_at(params, &world->geometry, hit, direction, params->texture_angle);
    sample.emission = vertex.surface.emission;
    sample.albedo = vertex.surface.albedo;
    sample.normal = vertex.surface.shading;
    sample.depth = hit.t;
    int goes_on = enter_surface(params, &vertex, f3(1.0f, 1.0f, 1.0f));
    while (goes_on != 0) {
        *rays += next_event(params, world, &vertex, random, &sample);
        goes_on = scatter(params, world, &vertex, random, &sample, rays);
        if (!HAS(params, FEATURE_INDIRECT)) break;
        if (goes_on != 0) goes_on = survives(&vertex, random);
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
    PathScene world = {scene, geometry, lights, emissive,
                       params.sampled_lights + params.delta_lights + params.directional_lights};
    GLOBAL uint* sums = film_sums + pixel;
    uint rays = 0u;
    for (uint i = 0u; i < params.samples; ++i) {
        Random random = make_random(params.seed, pixel, params.frame + i);
        PathSample sample = trace_path(&params, &world, pixel, &random, &rays);
        // Scaled by a power of two, so that the sums' range fits the scene's light.
        float3 emission =
            guard(nonfinite, COMPONENT_EMISSION, pixel, sample.emission) * params.film_scale;
        float3 direct =
            guard(nonfinite, COMPONENT_DIRECT, pixel, sample.direct) * params.film_scale;
        float3 indirect =
            guard(nonfinite, COMPONENT_INDIRECT, pixel, sample.indirect) * params.film_scale;
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
