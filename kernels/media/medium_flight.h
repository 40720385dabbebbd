// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Free paths of light paths through media, to where they collide next; sampled as in path_media.cl.
#ifndef WEFT_KERNELS_MEDIA_MEDIUM_FLIGHT_H
#define WEFT_KERNELS_MEDIA_MEDIUM_FLIGHT_H

#include "kernels/media/medium_walk.h"

// Where a flight ended.
typedef struct {
    int collides;          // 1: in a medium, 0: at the end of its ray
    float t;               // and where
    float3 weight;         // of its light, the medium's albedo included
    float g;               // of the medium's phase function
    uint enclosing_media;  // boundaries around the end
} Flight;

/// Goes through one segment: 1 where the flight ends in it. *ratio as in medium.h.
static inline int sample_segment(const RenderParams* params, const Media* media,
                                 const MediumWalk* walk, const MediumRecord* medium, float3* ratio,
                                 Random* random, float* t) {
    float3 sigma = xyz(medium->sigma_t);
    float length = walk->end - walk->begin;
    if (!(max_component(sigma) > 0.0f && length > 0.0f)) return 0;
    if (has_grid(params, media, medium) != 0) {
        DensityGrid grid = grid_of(media, medium);
        CubeRay ray = ray_in_cube(&grid, walk->origin, walk->direction);
        float density;
        return grid_collision(&grid, ray.origin, ray.direction, walk->begin, walk->end, sigma,
                              ratio, random, t, &density);
    }
    float choice = next_random(random);
    float u = next_random(random);
    float free = free_path(sigma, *ratio, choice, u);
    *t = walk->begin + m_min(free, length);
    if (free < length) {
        update_ratio(ratio, sigma * beer_transmittance(sigma, free));
        return 1;
    }
    update_ratio(ratio, beer_transmittance(sigma, length));
    return 0;
}

/// A flight along the first `length` of a ray that starts inside of these boundaries.
static inline Flight sample_free_path(const RenderParams* params, const Media* media, float3 origin,
                                      float3 direction, float length, uint enclosing_media,
                                      Random* random) {
    Flight flight;
    flight.collides = 0;
    flight.t = length;
    flight.weight = f3(1.0f, 1.0f, 1.0f);
    flight.g = 0.0f;
    flight.enclosing_media = enclosing_media;
    if (may_meet_media(media, origin, direction, length) == 0) return flight;
    MediumWalk walk = start_walk(media, origin, direction, enclosing_media);
    while (next_segment(params, media, &walk, length) != 0) {
        flight.enclosing_media = walk.enclosing_media;
        if (walk.medium == NO_MEDIUM) continue;
        MediumRecord medium = media->media[walk.medium];
        float t = walk.end;
        if (sample_segment(params, media, &walk, &medium, &flight.weight, random, &t) != 0) {
            flight.collides = 1;
            flight.t = t;
            flight.weight = flight.weight * xyz(medium.albedo);
            flight.g = medium.anisotropy;
            return flight;
        }
        if (!(max_component(flight.weight) > 0.0f)) return flight;
    }
    return flight;
}

#endif
