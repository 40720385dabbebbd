// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes in which vpl_roulette.cl tells vpl_gather.cl which VPLs are traced.
#ifndef WEFT_KERNELS_LIGHT_VPL_SURVIVAL_H
#define WEFT_KERNELS_LIGHT_VPL_SURVIVAL_H

#include "kernels/core/maths.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// Probability of survival, in steps of 1 / 255, of a VPL that brings `importance` at most, or 0
/// where the random number `chance`, in (0, 1], ends it. Rounded up, so that none goes unseen.
static inline uint survival_byte(float importance, float level, float chance) {
    if (!(importance > 0.0f)) return 0u;
    // Sums beyond the range of numbers keep all.
    float steps = importance < level && level < RAY_INFINITY ? importance / level * 255.0f : 255.0f;
    uint byte = steps < 254.0f ? (uint)steps + 1u : 255u;
    return chance * 255.0f <= (float)byte ? byte : 0u;
}

/// How much a VPL that has survived counts for: 0 for those that have not.
static inline float survival_weight(GLOBAL const uint* survival, uint i) {
    uint byte = survival[i / 4u] >> (8u * (i % 4u)) & 255u;
    return byte > 0u ? 255.0f / (float)byte : 0.0f;
}

#endif
