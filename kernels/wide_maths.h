// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Elementary functions of LANES values at once, of the operations that maths.h allows itself, so
// that every backend and every width give the same bits.
#ifndef WEFT_WIDE_MATHS_H
#define WEFT_WIDE_MATHS_H

#include "maths.h"

/// Whole number nearest to `x`, halves to the even one; |x| < 2^22.
static inline WFloat wide_round(WFloat x) {
    WFloat shift = WIDE(12582912.0f);  // 1.5 * 2^23: floats around it are the whole numbers
    return (x + shift) - shift;
}

/// exp(-depth) to 1 ulp, for depths of 0 or more; 0 for Inf, and for NaN.
static inline WFloat wide_exp_minus(WFloat depth) {
    WFloat x = VMIN(depth, WIDE(104.0f));
    x = -x;
    // As m_exp_pair and m_scale.
    WFloat n = wide_round(x * 1.44269504f);
    WFloat a = x - n * M_LN2_HIGH;
    WFloat b = -(n * M_LN2_LOW);
    WFloat r = a + b;
    WFloat low = b - (r - a);
    WFloat tail = WIDE(1.3930544e-3f) + r * 1.5043921e-4f;
    tail = WIDE(8.341512e-3f) + r * tail;
    tail = WIDE(4.166651e-2f) + r * tail;
    tail = WIDE(1.6666636e-1f) + r * tail;
    tail = WIDE(0.5f) + r * tail;
    WFloat rest = r * r * tail + low;
    WFloat first = wide_round(n * 0.5f);
    return (WIDE(1.0f) + (r + rest)) * wide_power_of_two(first) * wide_power_of_two(n - first);
}

#endif
