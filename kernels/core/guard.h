// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Keeps values that are not finite, or are negative, from the film: they are counted, and replaced
// by black.
#ifndef WEFT_KERNELS_CORE_GUARD_H
#define WEFT_KERNELS_CORE_GUARD_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"

static inline int is_good(float3 c) {
    return is_finite3(c) != 0 && c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f ? 1 : 0;
}

/// `c`, or black where it is not good, which is counted.
static inline float3 guard(GLOBAL NonfiniteCounter* counter, int component, uint pixel, float3 c) {
    if (is_good(c) != 0) return c;
    atomic_add_uint(&counter->count[component], 1u);
    atomic_min_uint(&counter->first_pixel[component], pixel);
    return f3(0.0f, 0.0f, 0.0f);
}

#endif
