// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A light path's way through media to where it is scattered next: free paths as in path_media.cl.
#ifndef WEFT_KERNELS_MEDIA_MEDIUM_FLIGHT_H
#define WEFT_KERNELS_MEDIA_MEDIUM_FLIGHT_H

#include "kernels/media/medium_walk.h"

// Where a flight ended.
typedef struct {
    int collides;   // 1: in a medium, 0: at the end of its ray
    float t;        // and where
    float3 weight;  // that its light takes, the medium's albedo included
    float g;        // of the medium's phase function
    uint inside;    // boundaries around the end
} Flight;

/// Goes through one stretch: 1 where the flight ends in it. *ratio as in medium.h.
static inline int fly_through(const RenderParams* params, const Media* media,
                              const MediumWalk* walk, const MediumRecord* medium, float3* ratio,
                              Random* random, float* t) {
    float3 sigma = xyz(medium->sigma_t);
    float length = walk->end - walk->begin;
    if (!(max_component(sigma) > 0.0f && length > 0.0f)) return 0;
    if (has_grid(params, medium) != 0) {
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
        update_ratio(ratio, sigma * transmittance(sigma, free));
        return 1;
    }
    update_ratio(ratio, transmittance(sigma, length));
    return 0;
}

/// A flight along the first `length` of a ray that starts inside of these boundaries.
static inline Flight fly(const RenderParams* params, const Media* media, float3 origin,
                         float3 direction, float length, uint inside, Random* random) {
    Flight flight;
    flight.collides = 0;
    flight.t = length;
    flight.weight = f3(1.0f, 1.0f, 1.0f);
    flight.g = 0.0f;
    flight.inside = inside;
    if (may_meet_media(media, origin, direction, length) == 0) return flight;
    MediumWalk walk = start_walk(media, origin, direction, inside);
    while (next_stretch(params, media, &walk, length) != 0) {
        flight.inside = walk.inside;
        if (walk.medium == NO_MEDIUM) continue;
        MediumRecord medium = media->media[walk.medium];
        float t = walk.end;
        if (fly_through(params, media, &walk, &medium, &flight.weight, random, &t) != 0) {
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
