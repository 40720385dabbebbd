// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Media whose boundaries are convex, each two apart or one inside of the other: the segments of
// LANES lines inside them follow from the planes of their faces, without a walk from hit to hit.
#ifndef WEFT_KERNELS_MEDIA_CONVEX_MEDIA_H
#define WEFT_KERNELS_MEDIA_CONVEX_MEDIA_H

#include "kernels/core/wide_maths.h"
#include "kernels/light/connection.h"
#include "kernels/media/medium_walk.h"

static inline WFloat3 wide_vector(WFloat x, WFloat y, WFloat z) {
    WFloat3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline WFloat3 wide_same(float x) {
    return wide_vector(WIDE(x), WIDE(x), WIDE(x));
}

/// exp(-depth) of each channel.
static inline WFloat3 wide_transmittance(WFloat3 depth) {
    WFloat3 transmittance;
    transmittance.x = wide_exp_minus(depth.x);
    transmittance.y = transmittance.x;
    transmittance.z = transmittance.x;
    // Most media are grey.
    if (!mask_all(depth.y == depth.x)) transmittance.y = wide_exp_minus(depth.y);
    if (!mask_all(depth.z == depth.x)) transmittance.z = wide_exp_minus(depth.z);
    return transmittance;
}

// Segments of LANES lines, in multiples of their directions; empty where end is begin.
typedef struct {
    WFloat begin, end;
} WideSegment;

/// Clips a segment of a line to below a plane. `height` is that of the line's origin above the
/// plane, `rise` the height that one direction adds, and `inverse` 1 / rise.
static inline void cut_segment(WFloat height, WFloat rise, WFloat inverse, WideSegment* segment) {
    WFloat zero = WIDE(0.0f);
    WFloat at = (-height) * inverse;
    WFloat begin = VMAX(at, segment->begin);
    WFloat end = VMIN(at, segment->end);
    // Along a plane, either all of a line lies below it or nothing.
    WFloat beside = SELECT(height > zero, zero, segment->end);
    segment->begin = SELECT(rise < zero, begin, segment->begin);
    segment->end = SELECT(rise > zero, end, segment->end);
    segment->end = SELECT(rise == zero, beside, segment->end);
}

/// The segment inside a boundary of origin + s way, s from 0 to `limit`. The host puts two planes
/// that face away from each other one after the other, so that they share a division.
static inline WideSegment segment_within(const Media* media, uint boundary, WFloat3 origin,
                                         WFloat3 way, WFloat limit) {
    WideSegment segment;
    segment.begin = WIDE(0.0f);
    segment.end = limit;
    uint last = media->record->plane_end[boundary];
    for (uint i = boundary == 0u ? 0u : media->record->plane_end[boundary - 1u]; i < last; ++i) {
        float4 plane = media->record->planes[i];
        WFloat along = wide_dot_scalar(origin, xyz(plane));
        WFloat rise = wide_dot_scalar(way, xyz(plane));
        WFloat inverse = WIDE(1.0f) / rise;
        cut_segment(along - plane.w, rise, inverse, &segment);
        if (i + 1u == last) break;
        float4 next = media->record->planes[i + 1u];
        if (next.x != -plane.x || next.y != -plane.y || next.z != -plane.z) continue;
        cut_segment(-along - next.w, -rise, -inverse, &segment);
        ++i;
    }
    segment.end = VMAX(segment.end, segment.begin);
    return segment;
}

// Lengths in each boundary but not in those inside of it, and outside of all.
typedef struct {
    WFloat within[CONVEX_BOUNDARIES];
    WFloat outside;
} WideLengths;

static inline WideLengths no_lengths(const Media* media, WFloat limit) {
    WideLengths lengths;
    lengths.outside = limit;
    for (uint k = 0u; k < media->record->boundaries; ++k) lengths.within[k] = WIDE(0.0f);
    return lengths;
}

/// Adds to a boundary's length what is taken away from that of what is around it.
static inline void add_length(const Media* media, uint boundary, WFloat length,
                              WideLengths* lengths) {
    lengths->within[boundary] = lengths->within[boundary] + length;
    uint around = media->record->around[boundary];
    if (around == NO_MEDIUM)
        lengths->outside = lengths->outside - length;
    else
        lengths->within[around] = lengths->within[around] - length;
}

static inline void add_medium_depth(const RenderParams* params, const Media* media, uint index,
                                    WFloat length, WFloat3* depth) {
    if (index == NO_MEDIUM) return;
    MediumRecord medium = media->media[index];
    if (has_grid(params, media, &medium) != 0) return;
    // Rounding may leave a little less than nothing.
    length = VMAX(length, WIDE(0.0f));
    depth->x = depth->x + length * medium.sigma_t.x;
    depth->y = depth->y + length * medium.sigma_t.y;
    depth->z = depth->z + length * medium.sigma_t.z;
}

/// Optical depth of these lengths times `unit`, without that of grids.
static inline WFloat3 depth_of(const RenderParams* params, const Media* media,
                               const WideLengths* lengths, WFloat unit) {
    WFloat3 depth = wide_same(0.0f);
    for (uint k = 0u; k < media->record->boundaries; ++k)
        add_medium_depth(params, media, media->record->interior[k], lengths->within[k] * unit,
                         &depth);
    add_medium_depth(params, media, media->record->outside, lengths->outside * unit, &depth);
    return depth;
}

/// The grid inside of a boundary; returns 0 where there is none.
static inline int grid_within(const RenderParams* params, const Media* media, uint boundary,
                              DensityGrid* grid, float3* sigma) {
    uint index = media->record->interior[boundary];
    if (index == NO_MEDIUM) return 0;
    MediumRecord medium = media->media[index];
    if (has_grid(params, media, &medium) == 0) return 0;
    *grid = grid_of(media, &medium);
    *sigma = xyz(medium.sigma_t);
    return 1;
}

#endif
