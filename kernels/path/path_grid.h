// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A path through a medium with a density grid: free paths by delta tracking, transmittance towards
// lights by ratio tracking (grid_tracking.h).
//
// The three ways of path_media.h to find light that is scattered at a point of a stretch have
// weights that must sum to 1 at every point, and may else be anything that is a function of the
// point and the light alone: each way divides by its own density, of which delta tracking and ratio
// tracking give unbiased estimates. So the balance heuristic is taken with a stand-in for the
// density of free paths, which is not known: mean over channels of ratio sigma_t at the start of
// the stretch, times the density at the point, as if the light had lost nothing on its way. It is
// too large deep in the medium, where delta tracking then keeps more of what it rarely finds but
// weighs right when it does; near a light the density of equi-angular sampling is beyond both, and
// keeps the variance finite.
//
// What a stretch emits has a closed form whatever the densities are, since emission and extinction
// go with the same one: no chance is in it. The price is an integral of the density along every
// stretch of a medium that emits, up to where it is opaque. Collisions of delta tracking would give
// an estimate for nothing, but one with next to none of them where it matters: in thin fire.
#ifndef WEFT_KERNELS_PATH_PATH_GRID_H
#define WEFT_KERNELS_PATH_PATH_GRID_H

#include "kernels/path/path_media.h"

/// The stand-in for the density of free paths at a point of this density.
static inline float stand_in(const Stretch* stretch, float density) {
    float3 source = stretch->ratio * stretch->sigma_t;
    return (source.x + source.y + source.z) * 0.333333333f * density;
}

/// Leaves of a stretch what lies in the grid; 0 where that is nothing.
static inline int clip_to_grid(const DensityGrid* grid, Stretch* stretch) {
    CubeRay ray = ray_in_cube(grid, stretch->origin, stretch->direction);
    GridRay inside;
    if (enter_grid(grid, ray.origin, ray.direction, 0.0f, stretch->length, &inside) == 0) return 0;
    stretch->origin = stretch->origin + stretch->direction * inside.first;
    stretch->length = inside.length;
    return 1;
}

/// The integral of the density from which on nothing that the stretch emits is seen: there 1 -
/// exp(-sigma depth) is 1 in every channel that emits.
static inline float seen_depth(const Stretch* stretch) {
    float3 emission = xyz(stretch->medium.emission);
    float least = M_INFINITY;
    if (emission.x > 0.0f) least = stretch->sigma_t.x;
    if (emission.y > 0.0f) least = m_min(least, stretch->sigma_t.y);
    if (emission.z > 0.0f) least = m_min(least, stretch->sigma_t.z);
    return 18.0f / least;
}

/// Light that is found by equi-angular sampling on a stretch.
static inline float3 grid_airlight(const RenderParams* params, const PathScene* world,
                                   const Media* media, const DensityGrid* grid,
                                   const Stretch* stretch, Random* random, uint* rays) {
    float3 none = f3(0.0f, 0.0f, 0.0f);
    ChosenPoint chosen = choose_point(world, random);
    float u = next_random(random);
    AngularView view =
        angular_view(stretch->origin, stretch->direction, stretch->length, chosen.point.position);
    if (has_place(chosen.light) == 0 || !(view.distance > 0.0f)) return none;
    ScatterPoint at;
    at.t = angular_sample(view, stretch->length, u);
    float density = density_at_place(grid, stretch->origin + stretch->direction * at.t);
    float free = stand_in(stretch, density);
    if (!(free > 0.0f)) return none;
    float3 left = tracked_transmittance(grid, stretch->sigma_t, stretch->origin, stretch->direction,
                                        0.0f, at.t, random);
    // Densities in units of the stand-in, which may be enormous.
    at.value = stretch->throughput * stretch->ratio * (stretch->sigma_t * (density / free)) * left *
               xyz(stretch->medium.albedo);
    at.free = 1.0f;
    at.angular = 1.0f / free;
    return light_scattered_at(params, world, media, stretch, &chosen, &at, random, rays);
}

/// Light at a point where delta tracking has scattered the path, whose ratio is that of the
/// collision.
static inline float3 collision_light(const RenderParams* params, const PathScene* world,
                                     const Media* media, const Stretch* stretch,
                                     const MediaPath* path, float t, float free, Random* random,
                                     uint* rays) {
    ChosenPoint chosen = choose_point(world, random);
    ScatterPoint at;
    at.t = t;
    at.value = path->throughput * path->ratio * xyz(stretch->medium.albedo);
    at.free = 1.0f;
    at.angular = 1.0f / free;
    return light_scattered_at(params, world, media, stretch, &chosen, &at, random, rays);
}

/// Goes through a stretch of a medium with a grid. Returns 1 where the path is scattered there, -1
/// where it ends.
static inline int cross_grid(const RenderParams* params, const PathScene* world, const Media* media,
                             Stretch* stretch, MediaPath* path, Random* random, PathSample* sample,
                             uint* rays) {
    PathLight* sum = &sample->light;
    DensityGrid grid = grid_of(media, &stretch->medium);
    if (clip_to_grid(&grid, stretch) == 0) return 0;
    int scatters = max_component(xyz(stretch->medium.albedo)) > 0.0f ? 1 : 0;
    int emits = has_emission(params, &stretch->medium);
    if (scatters == 0 || emits != 0) {
        float depth = depth_on_way(&grid, stretch->origin, stretch->direction, stretch->length,
                                   scatters != 0 ? seen_depth(stretch) : M_INFINITY);
        if (emits != 0) add_emitted(params, stretch, depth, path, sample);
        if (scatters == 0) {
            path->throughput = path->throughput * transmittance(stretch->sigma_t, depth);
            return max_component(path->throughput) > 0.0f ? 0 : -1;
        }
    }
    int wanted = wants_bounce(params, path->bounce + 1u);
    if (wanted != 0 && world->light_count != 0u)
        add_scattered(params, sum, path->bounce + 1u,
                      grid_airlight(params, world, media, &grid, stretch, random, rays));
    CubeRay ray = ray_in_cube(&grid, stretch->origin, stretch->direction);
    float t, density;
    int collides = grid_collision(&grid, ray.origin, ray.direction, 0.0f, stretch->length,
                                  stretch->sigma_t, &path->ratio, random, &t, &density);
    if (!(max_component(path->ratio) > 0.0f)) return -1;
    if (collides == 0) return 0;
    if (wanted == 0) return -1;
    ++path->bounce;
    path->free_density = stand_in(stretch, density);
    if (world->light_count != 0u)
        add_scattered(params, sum, path->bounce,
                      collision_light(params, world, media, stretch, path, t, path->free_density,
                                      random, rays));
    float u = next_random(random);
    float v = next_random(random);
    scatter_path(stretch, t, u, v, path);
    return path->density > 0.0f ? 1 : -1;
}

#endif
