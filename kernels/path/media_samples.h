// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Follows a path from the camera through surfaces and media: free paths, scattering in media and
// transmittance towards lights, multiple scattering and emission included. What is done in a
// segment of a homogeneous medium is here; in one with a grid, in path_grid.h.
#ifndef WEFT_KERNELS_PATH_MEDIA_SAMPLES_H
#define WEFT_KERNELS_PATH_MEDIA_SAMPLES_H

#include "kernels/film/camera.h"
#include "kernels/path/path_film.h"
#include "kernels/path/path_grid.h"
#include "kernels/path/path_media.h"

static inline MediaPath camera_path(const RenderParams* params, const PathParams* path_params,
                                    uint enclosing_media, uint pixel, Random* random) {
    MediaPath path;
    float x, y;
    sample_film(params, path_params, pixel, random, &x, &y);
    // Media need t to be a distance, but the camera's directions are of any length.
    path.direction = normalize3(camera_direction(params, x, y));
    path.origin = camera_origin(params, x, y);
    path.throughput = f3(1.0f, 1.0f, 1.0f);
    path.ratio = path.throughput;
    path.enclosing_media = enclosing_media;
    path.bounce = 0u;
    path.smooth = 0u;
    path.basic = 1.0f;
    path.absorption = f3(0.0f, 0.0f, 0.0f);
    path.kind = RAY_OF_CAMERA;
    path.pdf = 0.0f;
    return path;
}

/// Scatters the path at `t` of the segment, where it has been found by a free path.
static inline void scatter_in_medium(const RenderParams* params, const PathScene* world,
                                     const Media* media, const MediumSegment* segment, float t,
                                     MediaPath* path, Random* random, PathLight* sum, uint* rays) {
    ++path->bounce;
    float3 transmittance = beer_transmittance(segment->sigma_t, t);
    if (world->light_count != 0u) {
        ChosenPoint chosen = choose_point(params, world, random);
        add_scattered(params, sum, path->bounce,
                      scattered_light(params, world, media, segment, &chosen, t, transmittance,
                                      random, rays));
    }
    float u = next_random(random);
    float v = next_random(random);
    path->free_pdf = update_ratio(&path->ratio, segment->sigma_t * transmittance);
    scatter_path(params, media, segment, t, u, v, path);
}

/// Goes through a segment of a homogeneous medium. Returns 1 where the path is scattered there, -1
/// where it ends.
static inline int cross_segment(const RenderParams* params, const PathScene* world,
                                const Media* media, const MediumSegment* segment, MediaPath* path,
                                Random* random, PathSample* sample, uint* rays) {
    PathLight* sum = &sample->light;
    if (has_emission(params, &segment->medium) != 0)
        add_emitted(params, segment, segment->length, path, sample);
    if (!(max_component(xyz(segment->medium.albedo)) > 0.0f)) {
        // The transmittance is known, so that media which only absorb need no sampling.
        path->throughput = path->throughput * beer_transmittance(segment->sigma_t, segment->length);
        return max_component(path->throughput) > 0.0f ? 0 : -1;
    }
    if (!(max_component(segment->sigma_t) > 0.0f && segment->length > 0.0f)) return 0;
    int wanted = wants_bounce(params, path->bounce + 1u, path->smooth);
    if (wanted != 0 && world->light_count != 0u && takes_angular(segment, random) != 0) {
        ChosenPoint chosen = choose_point(params, world, random);
        float u = next_random(random);
        AngularView view = angular_view(segment->origin, segment->direction, segment->length,
                                        chosen.point.position);
        if (has_place(chosen.light) != 0 && view.distance > 0.0f) {
            float t = angular_sample(view, segment->length, u);
            add_scattered(params, sum, path->bounce + 1u,
                          scattered_light(params, world, media, segment, &chosen, t,
                                          beer_transmittance(segment->sigma_t, t), random, rays));
        }
    }
    float choice = next_random(random);
    float u = next_random(random);
    float t = free_path(segment->sigma_t, path->ratio, choice, u);
    if (t < segment->length) {
        if (wanted == 0) return -1;
        scatter_in_medium(params, world, media, segment, t, path, random, sum, rays);
        return path->free_pdf > 0.0f && path->pdf > 0.0f ? 1 : -1;
    }
    float transmittance =
        update_ratio(&path->ratio, beer_transmittance(segment->sigma_t, segment->length));
    // The ratio's mean is 1 again; what it was divided by is the probability of passing.
    return transmittance > 0.0f ? 0 : -1;
}

/// Goes through the media of a ray that ends after `length`. Returns 1 where the path is scattered
/// before, -1 where it ends.
static inline int cross_media(const RenderParams* params, const PathScene* world,
                              const Media* media, MediaPath* path, float length, Random* random,
                              PathSample* sample, uint* rays) {
    MediumWalk walk = start_walk(media, path->origin, path->direction, path->enclosing_media);
    while (next_segment(params, media, &walk, length) != 0) {
        path->enclosing_media = walk.enclosing_media;
        if (walk.medium == NO_MEDIUM) continue;
        MediumSegment segment;
        segment.medium = media->media[walk.medium];
        segment.sigma_t = extinction_of(media, &segment.medium);
        segment.length = walk.end - walk.begin;
        segment.origin = walk.origin + walk.direction * walk.begin;
        segment.direction = walk.direction;
        segment.throughput = path->throughput * path->basic;
        segment.ratio = path->ratio;
        segment.enclosing_media = walk.enclosing_media;
        segment.angular_share = path->bounce == 0u ? 1.0f : LATER_ANGULAR_SHARE;
        segment.absorption = path->absorption;
        segment.passed = walk.begin;
        int done = has_grid(params, media, &segment.medium) != 0
                       ? cross_grid(params, world, media, &segment, path, random, sample, rays)
                       : cross_segment(params, world, media, &segment, path, random, sample, rays);
        if (done != 0) return done;
    }
    return 0;
}

/// Goes on from a surface. Returns 0 where the path ends.
static inline int scatter_on_surface(const RenderParams* params, const PathScene* world,
                                     const Media* media, MediaPath* path, Random* random,
                                     PathLight* sum, uint* rays) {
    PathVertex vertex;
    vertex.bounce = path->bounce;
    vertex.light_weight = 1.0f;
    vertex.surface = path->surface;
    int goes_on = enter_surface(params, &vertex, path->throughput);
    path->bounce = vertex.bounce;
    if (goes_on == 0 || wants_bounce(params, path->bounce, path->smooth) == 0) return 0;
    *rays += surface_light(params, world, media, path, &vertex, random, sum);
    float u = next_random(random);
    float v = next_random(random);
    BsdfSample scattered = bsdf_sample(&path->surface.bsdf, path->surface.out, u, v);
    path->direction = normalize3(to_world(scattered.in, path->surface.shading));
    path->pdf = scattered.pdf;
    path->origin = vertex.origin;
    path->throughput = scattered_throughput(&vertex, scattered.weight);
    path->kind = RAY_OF_SURFACE;
    path->left = lit_point(&path->surface);
    return faces(&path->left, path->direction);
}

/// Follows the path to where it is scattered next. Returns 0 where it ends.
static inline int advance(const RenderParams* params, const PathScene* world, const Media* media,
                          MediaPath* path, Random* random, PathSample* sample, uint* rays) {
    Hit hit = trace_closest(world->scene, path->origin, path->direction, RAY_INFINITY);
    ++*rays;
    int met = hit.triangle != INVALID_INDEX ? 1 : 0;
    if (met != 0) {
        float angle = path->kind == RAY_OF_CAMERA
                          ? seen_texture_angle(params, params->camera.texture_angle, hit.t)
                          : 0.0f;
        path->surface = surface_at(params, &world->geometry, hit, path->direction, angle);
        if (path->kind == RAY_OF_CAMERA) {
            sample->albedo = bsdf_diffuse_albedo(&path->surface.bsdf);
            sample->normal = path->surface.shading;
            sample->depth =
                camera_depth(params, hit.t * dot3(path->direction, xyz(params->camera.forward)));
        }
    }
    int scattered = cross_media(params, world, media, path, met != 0 ? hit.t : RAY_INFINITY, random,
                                sample, rays);
    if (scattered < 0) return 0;
    if (scattered > 0)
        return path_survives(
            path, path->enclosing_media != 0u ? MEDIUM_ROULETTE_MOST : OUTER_ROULETTE_MOST, random);
    float3 light = f3(0.0f, 0.0f, 0.0f);
    if (met == 0 && path->bounce == 0u) {
        light = background_radiance(params, &world->environment, path->direction);
        // Its mean over paths, those that media scatter or absorb included, is by the
        // transmittance.
        sample->alpha = background_alpha(params, path->throughput * path->ratio);
    } else if (met == 0 && HAS(params, FEATURE_ENVIRONMENT)) {
        light = met_environment(params, world, path);
    }
    if (met != 0 && max_component(path->surface.emission) > 0.0f)
        light = path->surface.emission * met_weight(params, world, path, &path->surface, hit.t);
    add_met(params, path, light, sample);
    if (met == 0) return 0;
    if (scatter_on_surface(params, world, media, path, random, &sample->light, rays) == 0) return 0;
    return path_survives(path, ROULETTE_MOST, random);
}

/// Traces the samples of a pixel and adds them to the film's exact sums. Returns the number of
/// rays.
static inline uint add_media_samples(const RenderParams* params, const PathParams* path_params,
                                     const PathScene* world, const Media* media, uint pixel,
                                     GLOBAL uint* film_sums, GLOBAL NonfiniteCounter* nonfinite) {
    uint rays = 0u;
    for (uint i = 0u; i < path_params->samples; ++i) {
        Random random = make_random(params->sampling.seed, pixel, params->sampling.sample + i);
        PathSample sample = no_path_sample();
        MediaPath path =
            camera_path(params, path_params, media->record->around_camera, pixel, &random);
        while (advance(params, world, media, &path, &random, &sample, &rays) != 0) continue;
        add_sample(path_params->film_scale, film_sums, pixel, &sample, nonfinite);
    }
    return rays;
}

#endif
