// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Collisions and transmittance in a density grid from random numbers: delta tracking (Woodcock et
// al. 1965) and ratio tracking (Novak, Selle and Jarosz 2014) along blocks of constant majorants.
// Both take tentative collisions at the rate of the bounds. There is no end to their number where a
// bound is enormous and the density far below it, so after GRID_TENTATIVE of them the rest of the
// ray is integrated instead. When that happens depends on the past alone, so nothing is biased.
#ifndef WEFT_GRID_TRACKING_H
#define WEFT_GRID_TRACKING_H

#include "grid_depth.h"
#include "random.h"

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

/// Delta tracking: whether light collides on origin + t direction, first < t < last, in the unit
/// cube's space, and at which *t, where the density is *density; *t is `last` where not. `sigma` is
/// the extinction for density 1 and each unit of t. Collisions have the density sigma density T of
/// t, where T is the transmittance so far.
static inline int grid_collision(const DensityGrid* grid, float3 origin, float3 direction,
                                 float first, float last, float sigma, Random* random, float* t,
                                 float* density) {
    GridTracker tracker;
    *t = last;
    *density = 0.0f;
    if (!(sigma > 0.0f)) return 0;
    if (start_tracker(grid, origin, direction, first, last, &tracker) == 0) return 0;
    for (uint i = 0u; i < GRID_TENTATIVE; ++i) {
        if (next_tentative(grid, sigma, random, &tracker) == 0) return 0;
        if (next_random(random) * tracker.bound < tracker.density) {
            *t = m_min(tracker.ray.first + tracker.s, last);
            *density = tracker.density;
            return 1;
        }
    }
    // At least a normal number: a depth of 0 is reached before the medium.
    float target = m_max(random_depth(random) / sigma, 1.17549435e-38f);
    float stop;
    float depth = density_integral(grid, &tracker.ray, tracker.s, target, &stop);
    if (!(depth >= target)) return 0;
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
        result *= f3(1.0f - share.x * real, 1.0f - share.y * real, 1.0f - share.z * real);
        if (max_component(result) == 0.0f) return result;
    }
    float stop;
    float depth = density_integral(grid, &tracker.ray, tracker.s, M_INFINITY, &stop);
    return result * f3(transmittance_of(sigma.x, depth), transmittance_of(sigma.y, depth),
                       transmittance_of(sigma.z, depth));
}

#endif
