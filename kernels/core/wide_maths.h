// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Elementary functions of LANES values at once, of the operations that maths.h allows itself, so
// that every backend and every width give the same bits.
#ifndef WEFT_KERNELS_CORE_WIDE_MATHS_H
#define WEFT_KERNELS_CORE_WIDE_MATHS_H

#include "kernels/core/maths.h"

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

/// Angle of the point (x, y), y >= 0, in [0, pi], to 3 ulp; 0 for the origin. See m_atan2.
static inline WFloat wide_upper_angle(WFloat y, WFloat x) {
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    WFloat across = VMAX(x, -x);
    WFloat large = VMAX(across, y);
    WFloat small = VMIN(across, y);
    WFloat t = SELECT(large > zero, small / large, zero);
    // Where t is above tan(pi/8), the rest of the angle beyond pi/4.
    WMask steep = t > WIDE(0.41421356f);
    t = SELECT(steep, (t - one) / (t + one), t);
    WFloat z = t * t;
    WFloat tail = WIDE(1.0598728e-1f) + z * -6.0887355e-2f;
    tail = WIDE(-1.4244345e-1f) + z * tail;
    tail = WIDE(1.9998527e-1f) + z * tail;
    tail = WIDE(-3.3333316e-1f) + z * tail;
    WFloat angle = t + t * z * tail;
    angle = SELECT(steep, WIDE(M_QUARTER_PI) + (angle + M_QUARTER_PI_LOW), angle);
    angle = SELECT(y > across, WIDE(M_HALF_PI) - (angle - M_HALF_PI_LOW), angle);
    return SELECT(x < zero, WIDE(M_ONE_PI) - (angle - M_ONE_PI_LOW), angle);
}

#endif
