// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Where rays start: off the surface they leave, by a bound on rounding.
#ifndef WEFT_KERNELS_CORE_OFFSET_H
#define WEFT_KERNELS_CORE_OFFSET_H

#include "kernels/core/vector.h"

/// How far a ray's origin must be moved off a surface so that rounding in the point (from
/// barycentrics, 8 half-ulps of its coordinates) and in the next ray's plane distance (translation
/// and three products over at most twice the scene's extent) cannot put it on the wrong side.
static inline float surface_offset(float3 position, float extent) {
    return 5.9604645e-8f * (8.0f * max_component(absolute3(position)) + 16.0f * extent);
}

#endif
