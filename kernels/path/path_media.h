// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A path through participating media, and the light that media scatter into it. Three techniques
// find light of an area light that is scattered at a point of a segment:
//   1  the point by a free path, the light by next-event estimation;
//   2  the point by equi-angular sampling, the light by next-event estimation;
//   3  the point by a free path, the light by a scattered ray that meets it.
// They are weighted by the balance heuristic (Veach and Guibas 1995). Lights without area are found
// by the first two alone, directional ones by the first alone, an image of the environment by the
// first and the third. In media with grids the pdf of free
// paths is not known, and a stand-in takes its place (path_grid.h).
//
// Emission of media is found by the paths alone: every segment adds all of the emission that
// reaches its start, which is known, before a free path is sampled.
#ifndef WEFT_KERNELS_PATH_PATH_MEDIA_H
#define WEFT_KERNELS_PATH_PATH_MEDIA_H

#include "kernels/media/medium_walk.h"
#include "kernels/path/light_passing.h"
#include "kernels/path/path_film.h"

// Where a ray of a path comes from. What a ray of the camera meets counts in full; so does what one
// meets that a smooth surface has mirrored or let through, which is taken for one.
#define RAY_OF_CAMERA 0u
#define RAY_OF_SURFACE 1u
#define RAY_OF_MEDIUM 2u

// Largest survival probability of roulette after scattering in a medium. It is higher than
// ROULETTE_MOST, since a path into a thick white medium scatters as often as the square of its
// optical depth, and must not gain weight at each scattering.
#define MEDIUM_ROULETTE_MOST 0.999755859375f  // 1 - 2^-12
// Outside of all boundaries, where a path in a white medium never ends and brings less and less.
#define OUTER_ROULETTE_MOST 0.99f

// Probability that a segment is sampled by equi-angular sampling too, after the first scattering:
// little light comes from there, and that light has no streaks that it would have to find.
#define LATER_ANGULAR_SHARE 0.25f

// Largest radiance that a segment emits, so that the variance of a path of many such segments still
// fits a float.
#define MEDIUM_RADIANCE_MOST 7.20575940e16f  // 2^56

// A segment of a ray in one medium, and the state of the path at its start.
typedef struct {
    float3 origin, direction;
    float length;
    float3 throughput, ratio;  // see update_ratio
    float3 sigma_t;
    MediumRecord medium;
    uint enclosing_media;
    float angular_share;  // probability of equi-angular sampling
    float3 absorption;    // of the glass that the medium is in
    float passed;         // from where the ray is in that glass on to the segment's start
} MediumSegment;

// A path under way.
typedef struct {
    float3 origin, direction;
    float3 throughput, ratio;
    uint enclosing_media;   // boundaries around the origin
    uint bounce;            // scattered so far, but for smooth surfaces
    uint smooth;            // by smooth surfaces
    float basic;            // what light found here counts: 1 over the square of the glass's index
    float3 absorption;      // of the glass that the ray is in
    uint kind;              // RAY_OF_*
    float pdf;              // of the direction
    Surface surface;        // that the ray meets, or before that, left
    LitPoint left;          // point of the surface that it left, of RAY_OF_SURFACE
    MediumSegment segment;  // that it was scattered in, of RAY_OF_MEDIUM
    float along;            // where on it
    float free_pdf;         // and its pdf by free paths, or the stand-in for that
} MediaPath;

/// Adds light that arrives after `bounce` scatterings.
static inline void add_scattered(const RenderParams* params, PathLight* sum, uint bounce,
                                 float3 light) {
    if (bounce > 1u)
        sum->indirect += light;
    else if (HAS(params, FEATURE_SAMPLED_DIRECT))
        sum->direct += light;
}

/// Adds light that arrives where the path has been scattered last, after as many scatterings as it
/// has had.
static inline void add_met(const RenderParams* params, const MediaPath* path, float3 light,
                           PathSample* sample) {
    float3 arrives = light * path->throughput * path->ratio * path->basic;
    if (path->bounce == 0u)
        sample->emission += arrives;
    else
        add_scattered(params, &sample->light, path->bounce, arrives);
}

/// Transmittance of the glass that a segment is in, from where the ray is in it on to `t` of the
/// segment.
static inline float3 absorbed_before(const MediumSegment* segment, float t) {
    return beer_transmittance(segment->absorption, segment->passed + t);
}

/// Whether a medium emits light.
static inline int has_emission(const RenderParams* params, const MediumRecord* medium) {
    return HAS(params, FEATURE_EMISSIVE_MEDIA) && max_component(xyz(medium->emission)) > 0.0f ? 1
                                                                                              : 0;
}

/// Radiance of one channel that a segment emits towards its start. A segment without end and
/// without extinction emits nothing: its boundary is open, or the ray has missed it by rounding.
static inline float emitted1(float emission, float sigma, float depth) {
    if (!(emission > 0.0f)) return 0.0f;
    if (!(sigma > 0.0f) && !(depth < RAY_INFINITY)) return 0.0f;
    return m_min(emission * lit_length1(sigma, depth), MEDIUM_RADIANCE_MOST);
}

/// Adds what the medium of a segment emits into the path, by `depth`, the integral of its density
/// over the segment: the length where it is homogeneous. Extinction and emission are proportional
/// to the same density, so that the integral of emission times transmittance is known for any. It
/// is weighted with the path up to the segment, and independent of where a free path ends.
static inline void add_emitted(const RenderParams* params, const MediumSegment* segment,
                               float depth, const MediaPath* path, PathSample* sample) {
    float3 emission = xyz(segment->medium.emission);
    add_met(params, path,
            f3(emitted1(emission.x, segment->sigma_t.x, depth),
               emitted1(emission.y, segment->sigma_t.y, depth),
               emitted1(emission.z, segment->sigma_t.z, depth)) *
                absorbed_before(segment, 0.0f),
            sample);
}

/// 1 where light that arrives after `bounce` scatterings, and `smooth` by smooth surfaces, is to be
/// computed.
static inline int wants_bounce(const RenderParams* params, uint bounce, uint smooth) {
    if (bounce + smooth > params->sampling.most_bounces) return 0;
    return HAS(params, FEATURE_INDIRECT) || bounce <= 1u ? 1 : 0;
}

/// 1 where the segment is sampled by equi-angular sampling.
static inline int takes_angular(const MediumSegment* segment, Random* random) {
    return !(segment->angular_share < 1.0f) || next_random(random) < segment->angular_share ? 1 : 0;
}

static inline ChosenPoint choose_point(const RenderParams* params, const PathScene* world,
                                       Random* random) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    float probability;
    uint index = choose_for_next_event(world->lights, world->light_count, choice, &probability);
    return point_on_light(params, &world->geometry, world->lights[index], world->emissive,
                          &world->environment, probability, u, v);
}

// A point of a segment that a path may be scattered at, and its pdfs by free paths and equi-angular
// sampling. `value` and `free` may be in any common unit.
typedef struct {
    float t;        // distance from the segment's start
    float3 value;   // throughput times the source that scatters there, in the unit of `free`
    float free;     // pdf by free paths
    float angular;  // factor that brings pdfs by equi-angular sampling to the unit of `free`, times
                    // the probability that it is used
} ScatterPoint;

/// Light of a chosen point on a light that is scattered into the path at a point of the segment,
/// weighted. It is the same for both techniques that use next-event estimation.
static inline float3 light_scattered_at(const RenderParams* params, const PathScene* world,
                                        const Media* media, const MediumSegment* segment,
                                        const ChosenPoint* chosen, const ScatterPoint* at,
                                        Random* random, uint* rays) {
    float3 none = f3(0.0f, 0.0f, 0.0f);
    if (!(max_component(at->value) > 0.0f)) return none;
    float3 place = segment->origin + segment->direction * at->t;
    PlaceLight light = light_at_place(params, chosen, place);
    if (!(max_component(light.irradiance) > 0.0f)) return none;
    // The sum of the techniques' pdfs, over the light's pdf by next-event estimation.
    float pdf = at->free;
    if (light.distance < RAY_INFINITY)
        pdf += at->angular * angular_pdf(angular_view(segment->origin, segment->direction,
                                                      segment->length, chosen->point.position),
                                         at->t);
    float phase = phase_function(segment->medium.anisotropy, segment->direction, light.direction);
    if (light.pdf > 0.0f) pdf += at->free * (phase / light.pdf);
    if (!(pdf > 0.0f)) return none;
    float3 value = at->value;
    int distant = light.distance < RAY_INFINITY ? 0 : 1;
    if (world->tables != 0) {
        value = value * absorbed_before(segment, at->t) *
                light_passing(params, world, world->tables, place,
                              distant != 0 ? light.direction : light.target - place, distant, rays);
        if (distant == 0) value = value * beer_transmittance(segment->absorption, light.distance);
        if (!(max_component(value) > 0.0f)) return none;
    } else {
        ++*rays;
        int seen = distant == 0 ? sees_point(world->scene, params, place, light.target - place)
                                : sees_infinity(world->scene, params, place, light.direction);
        if (seen == 0) return none;
    }
    float3 arrives = ray_transmittance(params, media, place, light.direction, light.distance,
                                       segment->enclosing_media, random);
    return value * light.irradiance * arrives * (phase / pdf);
}

/// The albedo at `t` of a segment.
static inline float3 segment_albedo(const RenderParams* params, const Media* media,
                                    const MediumSegment* segment, float t) {
    return albedo_at_place(params, media, &segment->medium,
                           segment->origin + segment->direction * t);
}

/// The same in a homogeneous medium, where pdfs are known, and the transmittance of its first `t`.
static inline float3 scattered_light(const RenderParams* params, const PathScene* world,
                                     const Media* media, const MediumSegment* segment,
                                     const ChosenPoint* chosen, float t, float3 transmittance,
                                     Random* random, uint* rays) {
    float3 source = segment->ratio * segment->sigma_t * transmittance;
    ScatterPoint at;
    at.t = t;
    at.value = segment->throughput * source * segment_albedo(params, media, segment, t);
    at.free = (source.x + source.y + source.z) * 0.333333333f;
    at.angular = segment->angular_share;
    return light_scattered_at(params, world, media, segment, chosen, &at, random, rays);
}

/// MIS weight of the emission of a surface that a ray of the path met after `t`.
static inline float met_weight(const RenderParams* params, const PathScene* world,
                               const MediaPath* path, const Surface* surface, float t) {
    if (path->kind == RAY_OF_CAMERA) return 1.0f;
    if (path->kind == RAY_OF_SURFACE)
        return emission_weight(params, world, &path->left, surface, path->direction, t, path->pdf);
    float pdf =
        met_light_pdf(params, &world->geometry, world->lights, world->emissive, surface->triangle,
                      surface->instance, surface->normal, path->direction, t);
    if (!(pdf > 0.0f)) return 1.0f;
    pdf *= world->lights[world->geometry.instances[surface->instance].light].choice_probability;
    float angular = angular_pdf(angular_view(path->segment.origin, path->segment.direction,
                                             path->segment.length, surface->position),
                                path->along) *
                    path->segment.angular_share;
    float other = pdf / path->pdf;
    return 1.0f / (1.0f + other + other * (angular / path->free_pdf));
}

/// Radiance of the environment along a ray of the path that meets nothing after it was scattered,
/// times its MIS weight.
static inline float3 met_environment(const RenderParams* params, const PathScene* world,
                                     const MediaPath* path) {
    if (path->kind == RAY_OF_SURFACE)
        return weighted_environment(params, world, &path->left, path->direction, path->pdf);
    float other;
    float3 radiance = environment_met(params, &world->environment, path->direction, &other);
    if (!(other > 0.0f)) return radiance;
    other *= world->lights[environment_index(params)].choice_probability;
    return radiance * (1.0f / (1.0f + other / path->pdf));
}

/// Next-event estimation at a surface, through media: adds what one chosen light sends to it, and
/// that scatters into the path. Returns the number of shadow rays.
static inline uint surface_light(const RenderParams* params, const PathScene* world,
                                 const Media* media, const MediaPath* path,
                                 const PathVertex* vertex, Random* random, PathLight* sum) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    if (world->light_count == 0u) return 0u;
    LightSample light =
        sample_lights(params, world, &vertex->surface, vertex->origin, choice, u, v);
    const Bsdf* bsdf = &vertex->surface.bsdf;
    float3 out = vertex->surface.out;
    float3 irradiance = weighted_irradiance(&light, bsdf_pdf(bsdf, out, light.in));
    if (!(max_component(irradiance) > 0.0f)) return 0u;
    int seen = light.distant != 0 ? sees_infinity(world->scene, params, light.origin, light.towards)
                                  : sees_point(world->scene, params, light.origin, light.towards);
    if (seen == 0) return 1u;
    float length = light.distant != 0 ? RAY_INFINITY : length3(light.towards);
    float3 transmittance = ray_transmittance(params, media, light.origin, normalize3(light.towards),
                                             length, path->enclosing_media, random);
    BsdfValue value = bsdf_eval(bsdf, out, light.in);
    add_scattered(params, sum, path->bounce,
                  scattered_throughput(vertex, value.colour) * path->ratio * irradiance *
                      transmittance * value.share);
    return 1u;
}

/// Leaves the segment at `t`, in a direction of the phase function.
static inline void scatter_path(const RenderParams* params, const Media* media,
                                const MediumSegment* segment, float t, float u, float v,
                                MediaPath* path) {
    path->throughput =
        path->throughput * segment_albedo(params, media, segment, t) * absorbed_before(segment, t);
    path->segment = *segment;
    path->along = t;
    path->origin = segment->origin + segment->direction * t;
    path->direction =
        scatter_direction(segment->medium.anisotropy, segment->direction, u, v, &path->pdf);
    path->enclosing_media = segment->enclosing_media;
    path->kind = RAY_OF_MEDIUM;
}

/// Russian roulette. Returns 0 where the path ends.
static inline int path_survives(MediaPath* path, float most, Random* random) {
    float draw = next_random(random);
    if (path->bounce + path->smooth < ROULETTE_START) return 1;
    float q = m_clamp(max_component(path->throughput * path->ratio) / ROULETTE_LEVEL,
                      ROULETTE_LEAST, most);
    if (draw >= q) return 0;
    path->throughput = path->throughput * (1.0f / q);
    return 1;
}

#endif
