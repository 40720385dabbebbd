// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A path through a medium with a density grid: free paths by delta tracking, transmittance towards
// lights by ratio tracking (grid_tracking.h).
//
// The weights of the three techniques of path_media.h must sum to 1 at every point of a segment,
// and may otherwise be any function of the point and the light: each technique divides by its own
// pdf, of which delta tracking and ratio tracking give unbiased estimates. So the balance heuristic
// uses a stand-in for the pdf of free paths, which is not known: the mean over channels of ratio
// sigma_t at the start of the segment, times the density at the point, as if nothing had been lost
// on the way. Deep in the medium the stand-in is too large, and gives delta tracking a larger
// weight than its rare collisions there deserve, but no bias. Near a light the pdf of equi-angular
// sampling exceeds both, and keeps the variance finite.
//
// The emission of a segment has a closed form whatever the densities are, since emission and
// extinction are proportional to the same density: it has no noise. The price is an integral of the
// density along every segment of a medium that emits, up to where it is opaque. Collisions of delta
// tracking would estimate it without that, but hardly occur where emission matters: in thin fire.
#ifndef WEFT_KERNELS_PATH_PATH_GRID_H
#define WEFT_KERNELS_PATH_PATH_GRID_H

#include "kernels/path/path_media.h"

/// The stand-in for the pdf of free paths at `t` of the segment, of that density.
static inline float stand_in(const DensityGrid* grid, const MediumSegment* segment, float t,
                             float density) {
    float3 source = segment->ratio * segment->sigma_t;
    if (grid->record.channels == 3u)
        return dot3(source,
                    colour_at_place(grid, segment->origin + segment->direction * t, density)) *
               0.333333333f;
    return (source.x + source.y + source.z) * 0.333333333f * density;
}

/// Clips a segment to the grid; returns 0 where it does not meet the grid.
static inline int clip_to_grid(const DensityGrid* grid, MediumSegment* segment) {
    CubeRay ray = ray_in_cube(grid, segment->origin, segment->direction);
    GridRay inside;
    if (enter_grid(grid, ray.origin, ray.direction, 0.0f, segment->length, &inside) == 0) return 0;
    segment->origin = segment->origin + segment->direction * inside.first;
    segment->length = inside.length;
    segment->passed += inside.first;
    return 1;
}

/// The integral of the density beyond which emission of the segment no longer reaches its start:
/// there 1 - exp(-sigma depth) is 1 in every channel that emits.
static inline float seen_depth(const MediumSegment* segment) {
    float3 emission = xyz(segment->medium.emission);
    float least = M_INFINITY;
    if (emission.x > 0.0f) least = segment->sigma_t.x;
    if (emission.y > 0.0f) least = m_min(least, segment->sigma_t.y);
    if (emission.z > 0.0f) least = m_min(least, segment->sigma_t.z);
    return 18.0f / least;
}

/// Light that a segment scatters into the path, found by equi-angular sampling.
static inline float3 grid_airlight(const RenderParams* params, const PathScene* world,
                                   const Media* media, const DensityGrid* grid,
                                   const MediumSegment* segment, Random* random, uint* rays) {
    float3 none = f3(0.0f, 0.0f, 0.0f);
    ChosenPoint chosen = choose_point(params, world, random);
    float u = next_random(random);
    AngularView view =
        angular_view(segment->origin, segment->direction, segment->length, chosen.point.position);
    if (has_place(chosen.light) == 0 || !(view.distance > 0.0f)) return none;
    ScatterPoint at;
    at.t = angular_sample(view, segment->length, u);
    float3 place = segment->origin + segment->direction * at.t;
    float density = density_at_place(grid, place);
    float free = stand_in(grid, segment, at.t, density);
    if (!(free > 0.0f)) return none;
    float3 transmittance = tracked_transmittance(grid, segment->sigma_t, segment->origin,
                                                 segment->direction, 0.0f, at.t, random);
    // Pdfs are in units of the stand-in, which may be enormous.
    float3 extinction = segment->sigma_t * (density / free);
    if (grid->record.channels == 3u)
        extinction = segment->sigma_t * (colour_at_place(grid, place, density) / free);
    at.value = segment->throughput * segment->ratio * extinction * transmittance *
               segment_albedo(params, media, segment, at.t);
    at.free = 1.0f;
    at.angular = segment->angular_share / free;
    return light_scattered_at(params, world, media, segment, &chosen, &at, random, rays);
}

/// Light by next-event estimation at a point where delta tracking has scattered the path, whose
/// ratio is that of the collision.
static inline float3 collision_light(const RenderParams* params, const PathScene* world,
                                     const Media* media, const MediumSegment* segment,
                                     const MediaPath* path, float t, float free, Random* random,
                                     uint* rays) {
    ChosenPoint chosen = choose_point(params, world, random);
    ScatterPoint at;
    at.t = t;
    at.value =
        path->throughput * path->ratio * segment_albedo(params, media, segment, t) * path->basic;
    at.free = 1.0f;
    at.angular = segment->angular_share / free;
    return light_scattered_at(params, world, media, segment, &chosen, &at, random, rays);
}

/// Goes through a segment of a medium with a grid. Returns 1 where the path is scattered there, -1
/// where it ends.
static inline int cross_grid(const RenderParams* params, const PathScene* world, const Media* media,
                             MediumSegment* segment, MediaPath* path, Random* random,
                             PathSample* sample, uint* rays) {
    PathLight* sum = &sample->light;
    DensityGrid grid = grid_of(media, &segment->medium);
    if (clip_to_grid(&grid, segment) == 0) return 0;
    int scatters = max_component(xyz(segment->medium.albedo)) > 0.0f ? 1 : 0;
    int emits = has_emission(params, &segment->medium);
    if (scatters == 0 && grid.record.channels == 3u) {
        float3 depths =
            channel_depths_on_way(&grid, segment->origin, segment->direction, segment->length);
        path->throughput = path->throughput * f3(transmittance1(segment->sigma_t.x, depths.x),
                                                 transmittance1(segment->sigma_t.y, depths.y),
                                                 transmittance1(segment->sigma_t.z, depths.z));
        return max_component(path->throughput) > 0.0f ? 0 : -1;
    }
    if (scatters == 0 || emits != 0) {
        float depth = depth_on_way(&grid, segment->origin, segment->direction, segment->length,
                                   scatters != 0 ? seen_depth(segment) : M_INFINITY);
        if (emits != 0) add_emitted(params, segment, depth, path, sample);
        if (scatters == 0) {
            path->throughput = path->throughput * beer_transmittance(segment->sigma_t, depth);
            return max_component(path->throughput) > 0.0f ? 0 : -1;
        }
    }
    int wanted = wants_bounce(params, path->bounce + 1u, path->smooth);
    if (wanted != 0 && world->light_count != 0u && takes_angular(segment, random) != 0)
        add_scattered(params, sum, path->bounce + 1u,
                      grid_airlight(params, world, media, &grid, segment, random, rays));
    CubeRay ray = ray_in_cube(&grid, segment->origin, segment->direction);
    float t, density;
    int collides = grid_collision(&grid, ray.origin, ray.direction, 0.0f, segment->length,
                                  segment->sigma_t, &path->ratio, random, &t, &density);
    if (!(max_component(path->ratio) > 0.0f)) return -1;
    if (collides == 0) return 0;
    if (wanted == 0) return -1;
    ++path->bounce;
    path->free_pdf = stand_in(&grid, segment, t, density);
    if (world->light_count != 0u)
        add_scattered(
            params, sum, path->bounce,
            collision_light(params, world, media, segment, path, t, path->free_pdf, random, rays));
    float u = next_random(random);
    float v = next_random(random);
    scatter_path(params, media, segment, t, u, v, path);
    return path->pdf > 0.0f ? 1 : -1;
}

#endif
