// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance of LANES receivers by a triangle of radiance 1, in closed form: Lambert's formula over
// its edges (Lambert 1760; Baum, Rushmeier and Winget 1989, equation 6), for the part of it that is
// above the receiver's horizon.
#ifndef WEFT_KERNELS_LIGHT_TRIANGLE_IRRADIANCE_H
#define WEFT_KERNELS_LIGHT_TRIANGLE_IRRADIANCE_H

#include "kernels/core/wide_maths.h"
#include "kernels/light/connection.h"

/// Twice what the edge between two points, seen from the receivers, adds.
static inline WFloat edge_irradiance(WFloat3 a, WFloat3 b, WFloat3 normal) {
    WFloat3 across;
    across.x = a.y * b.z - a.z * b.y;
    across.y = a.z * b.x - a.x * b.z;
    across.z = a.x * b.y - a.y * b.x;
    WFloat sine = wide_square_root(wide_dot(across, across));
    WFloat angle = wide_upper_angle(sine, wide_dot(a, b));
    WFloat zero = WIDE(0.0f);
    return SELECT(sine > zero, angle * (wide_dot(across, normal) / sine), zero);
}

static inline WFloat3 select_vector(WMask mask, WFloat3 a, WFloat3 b) {
    WFloat3 chosen;
    chosen.x = SELECT(mask, a.x, b.x);
    chosen.y = SELECT(mask, a.y, b.y);
    chosen.z = SELECT(mask, a.z, b.z);
    return chosen;
}

// The part of a polygon above the horizon, edge by edge.
typedef struct {
    WFloat3 enters, leaves;  // where it crosses the horizon
    WMask crosses;
    WFloat sum;
} HorizonClip;

/// Adds the edge from `a` to `b`, whose heights above the horizon are given.
static inline void add_edge(WFloat3 a, WFloat3 b, WFloat height_a, WFloat height_b, WFloat3 normal,
                            HorizonClip* clip) {
    WFloat zero = WIDE(0.0f);
    WMask above_a = height_a > zero;
    WMask above_b = height_b > zero;
    WMask rises = mask_not(above_a) & above_b;
    WMask falls = above_a & mask_not(above_b);
    // One is above and one is not: the difference is not 0.
    WFloat share = SELECT(rises | falls, height_a / (height_a - height_b), zero);
    WFloat3 crossing;
    crossing.x = a.x + (b.x - a.x) * share;
    crossing.y = a.y + (b.y - a.y) * share;
    crossing.z = a.z + (b.z - a.z) * share;
    WFloat edge = edge_irradiance(select_vector(above_a, a, crossing),
                                  select_vector(above_b, b, crossing), normal);
    clip->sum = clip->sum + SELECT(above_a | above_b, edge, zero);
    clip->enters = select_vector(rises, crossing, clip->enters);
    clip->leaves = select_vector(falls, crossing, clip->leaves);
    clip->crosses = clip->crosses | falls;
}

/// Irradiance at `positions` with unit normals `normal` by the triangle a, b, c of radiance 1;
/// below 0 where they see it clockwise, so behind it.
static inline WFloat triangle_irradiance(WFloat3 positions, WFloat3 normal, float3 a, float3 b,
                                         float3 c) {
    WFloat3 to[3];
    WFloat height[3];
    float3 corners[3];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
    for (uint i = 0u; i < 3u; ++i) {
        to[i].x = WIDE(corners[i].x) - positions.x;
        to[i].y = WIDE(corners[i].y) - positions.y;
        to[i].z = WIDE(corners[i].z) - positions.z;
        height[i] = wide_dot(to[i], normal);
    }
    WFloat zero = WIDE(0.0f);
    HorizonClip clip;
    clip.enters.x = clip.enters.y = clip.enters.z = zero;
    clip.leaves = clip.enters;
    clip.crosses = mask_none_set;
    clip.sum = zero;
    for (uint i = 0u; i < 3u; ++i) {
        uint next = i == 2u ? 0u : i + 1u;
        add_edge(to[i], to[next], height[i], height[next], normal, &clip);
    }
    if (mask_any(clip.crosses)) {
        WFloat along = edge_irradiance(clip.leaves, clip.enters, normal);
        clip.sum = clip.sum + SELECT(clip.crosses, along, zero);
    }
    return clip.sum * -0.5f;
}

#endif
