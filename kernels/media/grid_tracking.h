// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Collisions and transmittance in a density grid from random numbers: delta tracking (Woodcock et
// al. 1965) and ratio tracking (Novak, Selle and Jarosz 2014) along blocks of constant majorants.
// Both take tentative collisions at the rate of the bounds. There is no end to their number where a
// bound is enormous and the density far below it, so after GRID_TENTATIVE of them the rest of the
// ray is integrated instead. When that happens depends on the past alone, so nothing is biased.
#ifndef WEFT_KERNELS_MEDIA_GRID_TRACKING_H
#define WEFT_KERNELS_MEDIA_GRID_TRACKING_H

#include "kernels/core/random.h"
#include "kernels/media/grid_depth.h"
#include "kernels/media/medium.h"

#define GRID_TENTATIVE 512u

/// A ray on its way from one tentative collision to the next.
typedef struct {
    GridRay ray;
    CellWalk block;
    float s;        // where it is
    float bound;    // of the block there
    float density;  // there, at most the bound
} GridTracker;

/// An optical depth to the next collision: exponential with mean 1.
static inline float random_depth(Random* random) {
    return -m_log1p(-next_random(random));
}

/// A tracker at the start of a ray; 0 where the ray does not meet the grid (see enter_grid).
static inline int start_tracker(const DensityGrid* grid, float3 origin, float3 direction,
                                float first, float last, GridTracker* tracker) {
    if (enter_grid(grid, origin, direction, first, last, &tracker->ray) == 0) return 0;
    tracker->block = start_blocks(grid, &tracker->ray);
    tracker->s = 0.0f;
    tracker->bound = walk_bound(grid, &tracker->block);
    tracker->density = 0.0f;
    return 1;
}

/// Goes on to the next tentative collision, of extinction sigma times the bound for each unit of t;
/// `sigma` is at least 0. Returns 0 where the ray ends before. A tentative collision is a real one
/// with probability density / bound.
static inline int next_tentative(const DensityGrid* grid, float sigma, Random* random,
                                 GridTracker* tracker) {
    float depth = random_depth(random);
    for (;;) {
        // Finite, so that a length of 0 makes 0 of it.
        float rate = m_min(sigma * tracker->bound, 3.4028235e38f);
        float room = (tracker->block.end - tracker->s) * rate;
        if (depth < room) {
            tracker->s = m_min(tracker->s + depth / rate, tracker->block.end);
            float density = density_on_ray(grid, &tracker->ray, tracker->s);
            tracker->density = m_min(density, tracker->bound);
            return 1;
        }
        if (next_cell(&tracker->block) == 0) return 0;
        depth -= room;
        tracker->s = tracker->block.start;
        tracker->bound = walk_bound(grid, &tracker->block);
    }
}

// Delta tracking of all channels at once, in the space of paths with null collisions (Miller,
// Georgiev and Jarosz 2019; Kutz et al. 2017 for the common majorant).
// Tentative collisions come at the rate greatest sigma times the bound, the same for each channel.
// For channel i alone, one of them would be real with probability p_i = sigma_i density / (greatest
// sigma bound), by which the light of channel i is also multiplied; and null with probability 1 -
// p_i, likewise. The balance heuristic over channels divides by the mean of the pdfs of all
// channels, so that the weight is `ratio` (medium.h). A channel that is chosen with probability
// ratio_i / 3 for each event makes a real collision of it with probability sum ratio_i p_i / sum
// ratio_i. That decides at once, and no channel is chosen.

// Where densities have a colour, `share` is multiplied with that at each tentative collision: its
// densities are the greatest of the channels, and p_i differs from place to place.

/// Extinctions of the channels at a place of the ray, over the greatest extinction for density 1
/// times the density there.
static inline float3 share_at(const DensityGrid* grid, const GridRay* ray, float s, float3 share) {
    if (grid->record.channels != 3u) return share;
    float3 p = grid_ray_at(ray, s);
    return share * colour_inside(grid, p, density_inside(grid, p));
}

/// The integrals of each channel's density from `start` to `stop`.
static inline float3 channel_depths(const DensityGrid* grid, const GridRay* ray, float start,
                                    float stop) {
    GridRay part = *ray;
    part.length = stop;
    float end;
    float depths[3];
    for (uint i = 0u; i < 3u; ++i) {
        DensityGrid plane = grid_plane(grid, i + 1u);
        depths[i] = density_integral(&plane, &part, start, M_INFINITY, &end);
    }
    return f3(depths[0], depths[1], depths[2]);
}

/// A free path of a channel that `choice` falls into, from `start` on, by integrating its density;
/// see grid_collision. Returns whether it ends before the ray does, and where: *stop.
static inline int integrated_path(const DensityGrid* grid, const GridRay* ray, float start,
                                  float3 sigma, float3* ratio, float choice, float u, float* stop) {
    int grey = grid->record.channels != 3u && sigma.x == sigma.y && sigma.y == sigma.z ? 1 : 0;
    float3 share = sigma / max_component(sigma);
    if (grid->record.channels != 3u) {
        // At least a normal number: a depth of 0 is reached before the medium.
        float target = m_max(free_path(sigma, *ratio, choice, u), 1.17549435e-38f);
        float depth = density_integral(grid, ray, start, target, stop);
        int collides = depth >= target ? 1 : 0;
        float3 transmittance = beer_transmittance(sigma, depth);
        if (grey == 0) update_ratio(ratio, collides != 0 ? share * transmittance : transmittance);
        return collides;
    }
    float at = choice * (ratio->x + ratio->y + ratio->z);
    uint channel = at < ratio->x ? 0u : (at < ratio->x + ratio->y ? 1u : 2u);
    float chosen = channel == 0u ? sigma.x : (channel == 1u ? sigma.y : sigma.z);
    float target = m_max(chosen > 0.0f ? -m_log1p(-u) / chosen : M_INFINITY, 1.17549435e-38f);
    DensityGrid plane = grid_plane(grid, channel + 1u);
    int collides = density_integral(&plane, ray, start, target, stop) >= target ? 1 : 0;
    float3 depths = channel_depths(grid, ray, start, *stop);
    float3 transmittance = f3(transmittance1(sigma.x, depths.x), transmittance1(sigma.y, depths.y),
                              transmittance1(sigma.z, depths.z));
    update_ratio(ratio,
                 collides != 0 ? share_at(grid, ray, *stop, share) * transmittance : transmittance);
    return collides;
}

/// Whether light collides on origin + t direction, first < t < last, in the unit cube's space, and
/// at which *t, where the density is *density; *t is `last` where not. `sigma` is the extinction of
/// each channel for density 1 and each unit of t. Channel i of *ratio, of mean 1 before and after,
/// times the pdf of the event is on average sigma_i density T_i of t, or T_i of the whole ray,
/// where T_i is the transmittance so far. A *ratio of 0 ends the path.
static inline int grid_collision(const DensityGrid* grid, float3 origin, float3 direction,
                                 float first, float last, float3 sigma, float3* ratio,
                                 Random* random, float* t, float* density) {
    GridTracker tracker;
    *t = last;
    *density = 0.0f;
    float greatest = max_component(sigma);
    if (!(greatest > 0.0f)) return 0;
    if (start_tracker(grid, origin, direction, first, last, &tracker) == 0) return 0;
    float3 share = sigma / greatest;
    // Of equal channels the ratio stays what it is, to the bit.
    int grey = grid->record.channels != 3u && share.x == share.y && share.y == share.z ? 1 : 0;
    for (uint i = 0u; i < GRID_TENTATIVE; ++i) {
        if (next_tentative(grid, greatest, random, &tracker) == 0) return 0;
        float3 here = share_at(grid, &tracker.ray, tracker.s, share);
        float chance = dot3(*ratio, here) / (ratio->x + ratio->y + ratio->z);
        if (grey != 0) chance = 1.0f;
        if (next_random(random) * tracker.bound < tracker.density * chance) {
            if (grey == 0) update_ratio(ratio, here);
            *t = m_min(tracker.ray.first + tracker.s, last);
            *density = tracker.density;
            return 1;
        }
        float3 passing = f3(1.0f, 1.0f, 1.0f) - here * (tracker.density / tracker.bound);
        if (grey == 0) update_ratio(ratio, passing);
    }
    float choice = next_random(random);
    float u = next_random(random);
    float stop;
    if (integrated_path(grid, &tracker.ray, tracker.s, sigma, ratio, choice, u, &stop) == 0)
        return 0;
    *t = m_min(tracker.ray.first + stop, last);
    *density = density_on_ray(grid, &tracker.ray, stop);
    return 1;
}

/// exp(-sigma depth) of finite sigma; 1 for sigma = 0 whatever the depth.
static inline float transmittance_of(float sigma, float depth) {
    return sigma > 0.0f ? m_exp(-(sigma * depth)) : 1.0f;
}

/// Ratio tracking: an unbiased estimate in [0, 1] of the transmittance of each channel along
/// origin + t direction, first < t < last, in the unit cube's space. `sigma` is the extinction for
/// density 1 and each unit of t, finite and at least 0.
static inline float3 grid_transmittance(const DensityGrid* grid, float3 origin, float3 direction,
                                        float first, float last, float3 sigma, Random* random) {
    GridTracker tracker;
    float3 result = f3(1.0f, 1.0f, 1.0f);
    float greatest = max_component(sigma);
    if (!(greatest > 0.0f)) return result;
    if (start_tracker(grid, origin, direction, first, last, &tracker) == 0) return result;
    float3 share = sigma / greatest;
    for (uint i = 0u; i < GRID_TENTATIVE; ++i) {
        if (next_tentative(grid, greatest, random, &tracker) == 0) return result;
        float real = tracker.density / tracker.bound;
        float3 here = share_at(grid, &tracker.ray, tracker.s, share);
        result *= f3(1.0f - here.x * real, 1.0f - here.y * real, 1.0f - here.z * real);
        if (max_component(result) == 0.0f) return result;
    }
    if (grid->record.channels == 3u) {
        float3 depths = channel_depths(grid, &tracker.ray, tracker.s, tracker.ray.length);
        return result * f3(transmittance_of(sigma.x, depths.x), transmittance_of(sigma.y, depths.y),
                           transmittance_of(sigma.z, depths.z));
    }
    float stop;
    float depth = density_integral(grid, &tracker.ray, tracker.s, M_INFINITY, &stop);
    return result * f3(transmittance_of(sigma.x, depth), transmittance_of(sigma.y, depth),
                       transmittance_of(sigma.z, depth));
}

#endif
