// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Normals of mirrors that shading normals would turn against their triangle.
#ifndef WEFT_KERNELS_BSDF_BENT_NORMAL_H
#define WEFT_KERNELS_BSDF_BENT_NORMAL_H

#include "kernels/core/vector.h"

// Least height of a mirrored direction above the triangle, and of the viewer above the normal's
// plane, as cosines: half a degree.
#define LEAST_BENT_HEIGHT 0.01f

/// A shading normal for lobes that mirror the viewer, bent no more than it takes for the mirrored
/// direction to lie above the triangle: without it normal maps are black where that leaves the
/// surface. It depends on the viewer `v` alone. All are unit vectors, and the geometric normal is
/// on the side of `v`; the result is `normal` itself where nothing has to be bent.
static inline float3 bent_normal(float3 v, float3 normal, float3 geometric) {
    float facing = dot3(normal, v);
    // Also of a normal that barely faces the viewer: the mirrored direction is then opposite to the
    // viewer's, and their sum has lost its digits.
    if (!(facing >= LEAST_BENT_HEIGHT)) {
        normal = normalize3(normal - v * (facing - LEAST_BENT_HEIGHT));
        facing = dot3(normal, v);
    }
    float3 mirrored = normal * (2.0f * facing) - v;
    float least = m_min(0.9f * dot3(v, geometric), LEAST_BENT_HEIGHT);
    float height = dot3(mirrored, geometric);
    if (!(height < least)) return normal;
    float3 sum = v + normalize3(mirrored + geometric * (least - height));
    // Of viewers along the triangle and normals away from it nothing else is left.
    return dot3(sum, sum) > LEAST_BENT_HEIGHT * LEAST_BENT_HEIGHT ? normalize3(sum) : geometric;
}

#endif
