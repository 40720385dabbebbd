// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Bounds every VPL on a surface by the light of the VPLs about it. The radiance that leaves the
// surface there is about the flux of the VPL and of its NEIGHBOURS nearest of similar normals over
// the disk that holds them, and what one VPL brings is bounded by 1 / c^2 of the irradiance from
// all around by such radiance: G <= (their flux / its own) / (c^2 d^2), where d is the radius of
// the disk. Where VPLs of the same flux lie evenly that is the bound of vpl_bound (frame_plan.h),
// which knows one density for the whole scene, hidden surfaces included. A VPL with few neighbours,
// or in a medium, keeps that one. One work-item per VPL.
#include "kernels/core/kernel.h"
#include "kernels/core/vector.h"

#define NEIGHBOURS 8u
// Cosine between normals up to which VPLs count as of one surface.
#define SIMILAR 0.5f

static inline float flux_size(GLOBAL const Vpl* vpl) {
    return max_component(xyz(vpl->flux));
}

/// Where the VPL is, without a look at its bound, which its own work-item may be writing.
static inline float3 place_of(GLOBAL const Vpl* vpl) {
    GLOBAL const float* place = (GLOBAL const float*)&vpl->position;
    return f3(place[0], place[1], place[2]);
}

WEFT_KERNEL(vpl_bounds)
{
    if (WORK_ITEM(range) >= range.count) return;
    GLOBAL Vpl* vpl = vpls + range.first + WORK_ITEM(range);
    float own = flux_size(vpl);
    if (as_bits(vpl->normal.w) != VPL_SURFACE || !(own > 0.0f)) return;
    float3 position = place_of(vpl);
    float3 normal = xyz(vpl->normal);
    // The nearest so far, in the order of their squared distances.
    float squares[NEIGHBOURS];
    float fluxes[NEIGHBOURS];
    for (uint k = 0u; k < NEIGHBOURS; ++k) {
        squares[k] = M_INFINITY;
        fluxes[k] = 0.0f;
    }
    for (uint i = 0u; i < vpl_count; ++i) {
        GLOBAL const Vpl* other = vpls + i;
        float3 d = place_of(other) - position;
        float square = dot3(d, d);
        if (!(square < squares[NEIGHBOURS - 1u]) || other == vpl) continue;
        if (as_bits(other->normal.w) != VPL_SURFACE) continue;
        float flux = flux_size(other);
        if (!(flux > 0.0f) || dot3(xyz(other->normal), normal) < SIMILAR) continue;
        uint k = NEIGHBOURS - 1u;
        for (; k > 0u && square < squares[k - 1u]; --k) {
            squares[k] = squares[k - 1u];
            fluxes[k] = fluxes[k - 1u];
        }
        squares[k] = square;
        fluxes[k] = flux;
    }
    float sum = own;
    for (uint k = 0u; k < NEIGHBOURS; ++k) sum += fluxes[k];
    float bound = scale * (sum / own) / squares[NEIGHBOURS - 1u];
    if (bound > 0.0f && bound < NO_BOUND) vpl->position.w = bound;
}
