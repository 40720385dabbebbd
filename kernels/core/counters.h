// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Integer counters shared by all work-items of a launch.
#ifndef WEFT_KERNELS_CORE_COUNTERS_H
#define WEFT_KERNELS_CORE_COUNTERS_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// Adds to a 64-bit counter; the item whose addition wraps the low half carries into the high one.
static inline void count_rays(GLOBAL RayCounter* counter, uint rays) {
    if (rays == 0u) return;
    uint before = atomic_add_uint(&counter->rays_low, rays);
    if (before + rays < before) atomic_add_uint(&counter->rays_high, 1u);
}

#endif
