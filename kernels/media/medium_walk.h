// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Walks a ray through media, segment by segment. Boundaries lie in a BVH of their own, which other
// rays never meet. A ray stores the set of boundaries that enclose it, a bit each: crossing one
// from outside adds it and from inside takes it away, so that meeting the same one twice does no
// harm. Where rays start on a boundary, rounding decides whether they have crossed it; so the side
// from which the next one is met corrects the set. Of boundaries that are met at the same place
// only one is found; where no further one is met, the ray is outside of all, whatever the set says.
// None of that is needed where boundaries are known by their planes (MediaRecord::convex).
#ifndef WEFT_KERNELS_MEDIA_MEDIUM_WALK_H
#define WEFT_KERNELS_MEDIA_MEDIUM_WALK_H

#include "kernels/bvh/bvh.h"
#include "kernels/media/grid_media.h"
#include "kernels/media/medium.h"

#define MEDIA_MAKE(name)             \
    Media name;                      \
    name.nodes = boundary_nodes;     \
    name.leaves = boundary_leaves;   \
    name.normals = boundary_normals; \
    name.media = media;              \
    name.record = media_record;      \
    name.grids = grids;              \
    name.densities = densities;      \
    name.bounds = density_bounds;    \
    name.any_grid = 1;               \
    name.coloured = 0

typedef struct {
    GLOBAL const BvhNode* nodes;  // of the boundaries
    GLOBAL const float* leaves;
    GLOBAL const float4* normals;  // of a boundary's triangle, outwards; w: which boundary (bits)
    GLOBAL const MediumRecord* media;
    GLOBAL const MediaRecord* record;
    GLOBAL const DensityGridRecord* grids;  // meaningless without FEATURE_DENSITY_GRIDS
    GLOBAL const float* densities;
    GLOBAL const float* bounds;
    int any_grid;  // 0 where the kernel is for homogeneous media alone
    int coloured;  // 0 where it takes the mean colour of each grid, of densities or albedos
} Media;

// A ray on its way, and the segment of it in one medium that was reached last.
typedef struct {
    float3 origin, direction;  // unit
    float begin, end;          // of the segment
    float search;              // where the search for the next boundary starts
    uint enclosing_media;      // boundaries around the segment
    uint beyond;               // and around what follows
    uint medium;               // of the segment, or NO_MEDIUM
} MediumWalk;

static inline MediumWalk start_walk(const Media* media, float3 origin, float3 direction,
                                    uint enclosing_media) {
    MediumWalk walk;
    walk.origin = origin;
    walk.direction = direction;
    walk.begin = 0.0f;
    walk.end = 0.0f;
    // A little before the start: where that is on a boundary, the ray's direction says which side
    // it is on.
    walk.search = -media->record->rounding;
    walk.enclosing_media = enclosing_media;
    walk.beyond = enclosing_media;
    walk.medium = NO_MEDIUM;
    return walk;
}

/// The medium inside of these boundaries, or NO_MEDIUM.
static inline uint innermost_medium(const Media* media, uint enclosing_media) {
    return enclosing_media != 0u ? media->record->interior[lowest_bit(enclosing_media)]
                                 : media->record->outside;
}

/// Ends the segment at the next boundary before `limit`, which the BVH finds.
static inline void walk_to_boundary(const Media* media, MediumWalk* walk, float limit) {
    Hit hit =
        bvh_closest(media->nodes, media->leaves, walk->origin + walk->direction * walk->search,
                    walk->direction, RAY_INFINITY);
    if (hit.triangle == INVALID_INDEX) {
        walk->enclosing_media = 0u;
        walk->beyond = 0u;
        return;
    }
    float4 normal = media->normals[hit.triangle];
    uint bit = 1u << as_bits(normal.w);
    int enters = dot3(xyz(normal), walk->direction) < 0.0f ? 1 : 0;
    walk->enclosing_media =
        enters != 0 ? walk->enclosing_media & ~bit : walk->enclosing_media | bit;
    float at = walk->search + hit.t;
    walk->beyond = walk->enclosing_media;
    if (!(at < limit)) return;
    walk->end = m_max(at, walk->begin);
    walk->beyond = enters != 0 ? walk->enclosing_media | bit : walk->enclosing_media & ~bit;
    // A step long enough that rounding does not make the search find the same boundary again.
    walk->search = at + media->record->rounding +
                   2.38418579e-7f * (absolute(at) + max_component(absolute3(walk->origin)));
}

/// The same by planes, where MediaRecord::convex is set: which boundaries are around the segment
/// follows from where it begins.
static inline void walk_to_plane(const Media* media, MediumWalk* walk) {
    walk->enclosing_media = 0u;
    uint i = 0u;
    for (uint k = 0u; k < media->record->boundaries; ++k) {
        float enters = 0.0f;
        float leaves = M_INFINITY;
        for (; i < media->record->plane_end[k]; ++i) {
            float4 plane = media->record->planes[i];
            float height = dot3(xyz(plane), walk->origin) - plane.w;
            float rise = dot3(xyz(plane), walk->direction);
            if (rise < 0.0f) enters = m_max(enters, -height / rise);
            if (rise > 0.0f) leaves = m_min(leaves, -height / rise);
            if (rise == 0.0f && height > 0.0f) leaves = 0.0f;
        }
        if (!(leaves > enters && leaves > walk->begin)) continue;
        if (enters <= walk->begin) walk->enclosing_media |= 1u << k;
        walk->end = m_min(walk->end, enters <= walk->begin ? leaves : enters);
    }
    walk->beyond = walk->enclosing_media;
}

/// Goes on to the next segment, which ends at `limit` at the latest. Returns 0 where that is
/// reached.
static inline int next_segment(const RenderParams* params, const Media* media, MediumWalk* walk,
                               float limit) {
    if (!(walk->end < limit)) return 0;
    walk->begin = walk->end;
    walk->end = limit;
    walk->enclosing_media = walk->beyond;
    if (HAS(params, FEATURE_CONVEX_MEDIA))
        walk_to_plane(media, walk);
    else if (media->record->boundaries != 0u)
        walk_to_boundary(media, walk, limit);
    walk->medium = innermost_medium(media, walk->enclosing_media);
    return 1;
}

/// Whether a medium has a grid.
static inline int has_grid(const RenderParams* params, const Media* media,
                           const MediumRecord* medium) {
    return media->any_grid != 0 && HAS(params, FEATURE_DENSITY_GRIDS) &&
                   medium->grid != INVALID_INDEX
               ? 1
               : 0;
}

/// The grid of a medium that has one.
static inline DensityGrid grid_of(const Media* media, const MediumRecord* medium) {
    DensityGrid grid = density_grid(media->grids[medium->grid], media->densities, media->bounds);
    if (media->coloured == 0) grid.record.channels = 1u;
    return grid;
}

/// The extinction of a medium, in a grid for density 1.
static inline float3 extinction_of(const Media* media, const MediumRecord* medium) {
    if (media->coloured != 0 && medium->sigma_t.w > 0.0f)
        return f3(medium->sigma_t.w, medium->sigma_t.w, medium->sigma_t.w);
    return xyz(medium->sigma_t);
}

/// The albedo of a medium at a place.
static inline float3 albedo_at_place(const RenderParams* params, const Media* media,
                                     const MediumRecord* medium, float3 place) {
    if (!HAS(params, FEATURE_DENSITY_GRIDS)) return xyz(medium->albedo);
    if (media->coloured == 0 || medium->albedo_grid == INVALID_INDEX) return xyz(medium->albedo);
    DensityGrid grid =
        density_grid(media->grids[medium->albedo_grid], media->densities, media->bounds);
    return albedo_in_grid(&grid, place);
}

/// 0 where the first `length` of a ray surely stays clear of all media: outside of the box about
/// them, by separating axes of a segment and a box (Gottschalk, Lin and Manocha 1996).
static inline int may_meet_media(const Media* media, float3 origin, float3 direction,
                                 float length) {
    float3 from = origin - xyz(media->record->box_centre);
    float3 reach = xyz(media->record->box_reach);
    if (!(max_component(reach) < MEDIA_EVERYWHERE)) return 1;
    // A ray this long has left the box; rounding is that of its middle.
    float3 size = absolute3(from) + reach;
    float most = 2.0f * (size.x + size.y + size.z);
    float margin = most * 9.5367432e-7f;  // 2^-20
    reach += f3(margin, margin, margin);
    float3 way = direction * (0.5f * m_min(length, most));
    float3 middle = from + way;
    float3 a = absolute3(way);
    float3 m = absolute3(middle);
    if (m.x > reach.x + a.x || m.y > reach.y + a.y || m.z > reach.z + a.z) return 0;
    float3 beside = absolute3(cross3(middle, way));
    if (beside.x > reach.y * a.z + reach.z * a.y) return 0;
    if (beside.y > reach.z * a.x + reach.x * a.z) return 0;
    return beside.z > reach.x * a.y + reach.y * a.x ? 0 : 1;
}

/// Transmittance of media along the first `length` of a ray that starts inside of these boundaries:
/// exact where they are homogeneous, an unbiased estimate where they have grids.
static inline float3 ray_transmittance(const RenderParams* params, const Media* media,
                                       float3 origin, float3 direction, float length,
                                       uint enclosing_media, Random* random) {
    float3 transmittance = f3(1.0f, 1.0f, 1.0f);
    if (may_meet_media(media, origin, direction, length) == 0) return transmittance;
    MediumWalk walk = start_walk(media, origin, direction, enclosing_media);
    while (next_segment(params, media, &walk, length) != 0 && max_component(transmittance) > 0.0f) {
        if (walk.medium == NO_MEDIUM) continue;
        MediumRecord medium = media->media[walk.medium];
        if (has_grid(params, media, &medium) != 0) {
            DensityGrid grid = grid_of(media, &medium);
            transmittance *= tracked_transmittance(&grid, extinction_of(media, &medium), origin,
                                                   direction, walk.begin, walk.end, random);
        } else {
            transmittance *= beer_transmittance(xyz(medium.sigma_t), walk.end - walk.begin);
        }
    }
    return transmittance;
}

#endif
