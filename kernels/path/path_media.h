// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A path through participating media: what it has gone through, and light that media scatter into
// it. Three ways find light of an area light that is scattered at a point of a stretch: the point
// by a free path and the light by next-event estimation, the point by equi-angular sampling and the
// light likewise, and the point by a free path and the light by a scattered ray that meets it. They
// are weighted by the balance heuristic (Veach and Guibas 1995); lights without area are found by
// the first two alone, directional ones by the first alone. In media with grids the density of free
// paths is not known, and something like it takes its place: see path_grid.h.
//
// Light that media emit is found by the paths alone: every stretch adds all of what reaches its
// start from it, which is known, before a free path is looked for.
#ifndef WEFT_KERNELS_PATH_PATH_MEDIA_H
#define WEFT_KERNELS_PATH_PATH_MEDIA_H

#include "kernels/media/medium_walk.h"
#include "kernels/path/path_film.h"

// How a ray of a path has come to be.
#define RAY_OF_CAMERA 0u
#define RAY_OF_SURFACE 1u
#define RAY_OF_MEDIUM 2u

// Roulette after scattering in a medium. Higher than ROULETTE_MOST: a path into a thick white
// medium scatters as often as the square of its depth, and what it brings must not be multiplied
// by what roulette takes.
#define MEDIUM_ROULETTE_MOST 0.999755859375f  // 1 - 2^-12
// Outside of all boundaries, where a path in a white medium never ends and brings less and less.
#define OUTER_ROULETTE_MOST 0.99f

// What a stretch emits is at most that: a path of many such stretches has a variance that is a
// float.
#define MEDIUM_RADIANCE_MOST 7.20575940e16f  // 2^56

// A stretch of a ray in one medium, and the state of the path at its start.
typedef struct {
    float3 origin, direction;
    float length;
    float3 throughput, ratio;  // see update_ratio
    float3 sigma_t;
    MediumRecord medium;
    uint inside;
} Stretch;

// A path under way.
typedef struct {
    float3 origin, direction;
    float3 throughput, ratio;
    uint inside;         // boundaries around the origin
    uint bounce;         // scattered so far
    uint kind;           // RAY_OF_*
    float density;       // of the direction
    Surface surface;     // that it left, of RAY_OF_SURFACE
    Stretch stretch;     // that it was scattered in, of RAY_OF_MEDIUM
    float along;         // where on it
    float free_density;  // and its density by free paths, or what stands for it
} MediaPath;

/// Light that arrives after `bounce` scatterings.
static inline void add_scattered(const RenderParams* params, PathLight* sum, uint bounce,
                                 float3 light) {
    if (bounce > 1u)
        sum->indirect += light;
    else if (HAS(params, FEATURE_SAMPLED_DIRECT))
        sum->direct += light;
}

/// Light that arrives where the path has been scattered last, as often as it was.
static inline void add_met(const RenderParams* params, const MediaPath* path, float3 light,
                           PathSample* sample) {
    float3 arrives = light * path->throughput * path->ratio;
    if (path->bounce == 0u)
        sample->emission += arrives;
    else
        add_scattered(params, &sample->light, path->bounce, arrives);
}

/// Whether a medium emits light.
static inline int has_emission(const RenderParams* params, const MediumRecord* medium) {
    return HAS(params, FEATURE_EMISSIVE_MEDIA) && max_component(xyz(medium->emission)) > 0.0f ? 1
                                                                                              : 0;
}

/// Radiance of one channel that a stretch emits towards its start. What has no end and takes
/// nothing from light is a boundary that is open, or that a ray has missed by rounding, and no
/// light.
static inline float emitted1(float emission, float sigma, float depth) {
    if (!(emission > 0.0f)) return 0.0f;
    if (!(sigma > 0.0f) && !(depth < RAY_INFINITY)) return 0.0f;
    return m_min(emission * lit_length1(sigma, depth), MEDIUM_RADIANCE_MOST);
}

/// What the medium of a stretch emits into the path, by the integral of its density over the
/// stretch: its length where it is homogeneous. Extinction and emission go with the same density,
/// so that the integral of emission times transmittance is known for any. Free paths have nothing
/// to do with it: this belongs to their start, wherever they end.
static inline void add_emitted(const RenderParams* params, const Stretch* stretch, float depth,
                               const MediaPath* path, PathSample* sample) {
    float3 emission = xyz(stretch->medium.emission);
    add_met(params, path,
            f3(emitted1(emission.x, stretch->sigma_t.x, depth),
               emitted1(emission.y, stretch->sigma_t.y, depth),
               emitted1(emission.z, stretch->sigma_t.z, depth)),
            sample);
}

/// 1 where light that arrives after `bounce` scatterings is asked for.
static inline int wants_bounce(const RenderParams* params, uint bounce) {
    return HAS(params, FEATURE_INDIRECT) || bounce <= 1u ? 1 : 0;
}

static inline ChosenPoint choose_point(const PathScene* world, Random* random) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    float probability;
    uint index = choose_for_next_event(world->lights, world->light_count, choice, &probability);
    return point_on_light(&world->geometry, world->lights[index], world->emissive, probability, u,
                          v);
}

// A point of a stretch that a path may be scattered at, and the weights of the ways to find it.
typedef struct {
    float t;        // of the stretch
    float3 value;   // throughput times the source that scatters there, times `free`'s unit
    float free;     // density by free paths
    float angular;  // unit of densities by equi-angular sampling, in that of `free`
} ScatterPoint;

/// Light of a chosen point that is scattered into the path at a point of the stretch, weighted.
/// Which of the two ways of next-event estimation has found the point makes no difference.
static inline float3 light_scattered_at(const RenderParams* params, const PathScene* world,
                                        const Media* media, const Stretch* stretch,
                                        const ChosenPoint* chosen, const ScatterPoint* at,
                                        Random* random, uint* rays) {
    float3 none = f3(0.0f, 0.0f, 0.0f);
    if (!(max_component(at->value) > 0.0f)) return none;
    float3 place = stretch->origin + stretch->direction * at->t;
    PlaceLight light = light_at_place(params, chosen, place);
    if (!(max_component(light.irradiance) > 0.0f)) return none;
    // Densities of the place times the light's, over the light's by next-event estimation.
    float density = at->free;
    if (light.distance < RAY_INFINITY)
        density +=
            at->angular * angular_density(angular_view(stretch->origin, stretch->direction,
                                                       stretch->length, chosen->point.position),
                                          at->t);
    float phase = phase_function(stretch->medium.anisotropy, stretch->direction, light.direction);
    if (light.pdf > 0.0f) density += at->free * (phase / light.pdf);
    if (!(density > 0.0f)) return none;
    ++*rays;
    int seen = light.distance < RAY_INFINITY
                   ? sees_point(world->scene, params, place, light.target - place)
                   : sees_infinity(world->scene, params, place, light.direction);
    if (seen == 0) return none;
    float3 arrives = ray_transmittance(params, media, place, light.direction, light.distance,
                                       stretch->inside, random);
    return at->value * light.irradiance * arrives * (phase / density);
}

/// The same in a homogeneous medium, where transmittance and densities are known.
static inline float3 scattered_light(const RenderParams* params, const PathScene* world,
                                     const Media* media, const Stretch* stretch,
                                     const ChosenPoint* chosen, float t, Random* random,
                                     uint* rays) {
    float3 left = transmittance(stretch->sigma_t, t);
    float3 source = stretch->ratio * stretch->sigma_t * left;
    ScatterPoint at;
    at.t = t;
    at.value = stretch->throughput * source * xyz(stretch->medium.albedo);
    at.free = (source.x + source.y + source.z) * 0.333333333f;
    at.angular = 1.0f;
    return light_scattered_at(params, world, media, stretch, chosen, &at, random, rays);
}

/// Weight of emission of a surface that a ray of the path met after `t`.
static inline float met_weight(const PathScene* world, const MediaPath* path,
                               const Surface* surface, float t) {
    if (path->kind == RAY_OF_CAMERA) return 1.0f;
    if (path->kind == RAY_OF_SURFACE)
        return emission_weight(world, surface, path->direction, t, path->density);
    float pdf = met_light_pdf(&world->geometry, world->lights, surface->instance, surface->normal,
                              path->direction, t);
    if (!(pdf > 0.0f)) return 1.0f;
    float angular = angular_density(angular_view(path->stretch.origin, path->stretch.direction,
                                                 path->stretch.length, surface->position),
                                    path->along);
    float other = pdf / path->density;
    return 1.0f / (1.0f + other + other * (angular / path->free_density));
}

/// Light of one chosen light by a surface that the path has come to, through media.
static inline uint surface_light(const RenderParams* params, const PathScene* world,
                                 const Media* media, const MediaPath* path,
                                 const PathVertex* vertex, Random* random, PathLight* sum) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    if (world->light_count == 0u) return 0u;
    LightSample light =
        sample_lights(params, &world->geometry, world->lights, world->light_count, world->emissive,
                      &vertex->surface, vertex->origin, choice, u, v);
    const Bsdf* bsdf = &vertex->surface.bsdf;
    float3 out = surface_out(&vertex->surface);
    float3 irradiance = weighted_irradiance(&light, bsdf_pdf(bsdf, out, light.in));
    if (!(max_component(irradiance) > 0.0f)) return 0u;
    int seen = light.distant != 0 ? sees_infinity(world->scene, params, light.origin, light.towards)
                                  : sees_point(world->scene, params, light.origin, light.towards);
    if (seen == 0) return 1u;
    float length = light.distant != 0 ? RAY_INFINITY : length3(light.towards);
    float3 left = ray_transmittance(params, media, light.origin, normalize3(light.towards), length,
                                    path->inside, random);
    BsdfValue value = bsdf_eval(bsdf, out, light.in);
    add_scattered(
        params, sum, path->bounce,
        scattered_throughput(vertex, value.colour) * path->ratio * irradiance * left * value.share);
    return 1u;
}

/// Leaves the stretch at `t`, in a direction of the phase function.
static inline void scatter_path(const Stretch* stretch, float t, float u, float v,
                                MediaPath* path) {
    path->throughput = path->throughput * xyz(stretch->medium.albedo);
    path->stretch = *stretch;
    path->along = t;
    path->origin = stretch->origin + stretch->direction * t;
    path->direction =
        scatter_direction(stretch->medium.anisotropy, stretch->direction, u, v, &path->density);
    path->inside = stretch->inside;
    path->kind = RAY_OF_MEDIUM;
}

/// Russian roulette. Returns 0 where the path ends.
static inline int path_survives(MediaPath* path, uint start, float most, Random* random) {
    float draw = next_random(random);
    if (path->bounce < start) return 1;
    float q = m_clamp(max_component(path->throughput * path->ratio), ROULETTE_LEAST, most);
    if (draw >= q) return 0;
    path->throughput = path->throughput * (1.0f / q);
    return 1;
}

#endif
