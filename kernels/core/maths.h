// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Elementary functions made of + - * /, comparisons, integer operations and square_root() only, so
// that every backend gives the same bits, provided that it rounds these correctly, keeps denormals
// and never contracts a product with a sum (OpenCL: -cl-fp32-correctly-rounded-divide-sqrt where
// offered). Errors are in units in the last place (ulp) of the exact result; on denormal results
// one ulp is 2^-149.
//
//   function        range                   error     elsewhere
//   m_sincos        |x| <= M_SINCOS_RANGE   1 ulp     (+-0, 1); Inf: NaN
//   m_sincos_octant |x| <= pi / 4           1 ulp
//   m_exp           all                     1 ulp     Inf above 88.73, 0 below -104
//   m_expm1         all                     1.5 ulp   Inf above 88.73, -1 below -18
//   m_log           x >= 0                  1 ulp     negative: NaN, zero: -Inf
//   m_log1p         x >= -1                 1 ulp     below -1: NaN, -1: -Inf
//   m_pow           x >= 0, any y           1 ulp     negative x: NaN
//   m_atan2         all, as in C99          2.5 ulp
//   m_asin m_acos   [-1, 1]                 3 ulp     clamped
//
// NaN gives NaN, save in m_pow(x, 0) = m_pow(1, y) = 1 and where stated. Signed zeros are kept
// where the function is odd. m_exp, m_expm1, m_log and m_log1p never fall where x rises.
//
// The polynomials are minimax fits (Remez exchange in 40 digits) of the relative error of the
// result; coefficients were rounded to float one at a time from the lowest order, refitting the
// rest. Their errors stay below 2^-28.
#ifndef WEFT_KERNELS_CORE_MATHS_H
#define WEFT_KERNELS_CORE_MATHS_H

#include "kernels/core/port.h"

#define M_ONE_PI 3.14159265f
#define M_TWO_PI 6.28318531f
#define M_HALF_PI 1.57079633f
#define M_QUARTER_PI 0.785398163f
#define M_INV_PI 0.318309886f
#define M_INV_TWO_PI 0.159154943f
#define M_INFINITY from_bits(0x7F800000u)
#define M_NAN from_bits(0x7FC00000u)
#define M_SINCOS_RANGE 12800.0f

// What the nearest floats of pi/4, pi/2 and pi lack.
#define M_QUARTER_PI_LOW (-2.1855694e-8f)
#define M_HALF_PI_LOW (-4.3711388e-8f)
#define M_ONE_PI_LOW (-8.7422777e-8f)

// ln 2 in two parts; the upper has 16 bits, so its product with any float exponent is exact.
#define M_LN2_HIGH 0.693145751953125f
#define M_LN2_LOW 1.4286068e-6f

/// A value and what rounding has cut from it; their sum is meant.
typedef struct {
    float high, low;
} FloatPair;

/// Smaller value; `b` when either is NaN.
static inline float m_min(float a, float b) {
    return a < b ? a : b;
}

/// Larger value; `b` when either is NaN.
static inline float m_max(float a, float b) {
    return a > b ? a : b;
}

/// `x` limited to [low, high]; `low` for NaN.
static inline float m_clamp(float x, float low, float high) {
    return m_min(m_max(x, low), high);
}

/// Whether `x` is NaN.
static inline bool m_is_nan(float x) {
    return (as_bits(x) & 0x7FFFFFFFu) > 0x7F800000u;
}

/// Magnitude of `x` with the sign of `s`.
static inline float m_with_sign(float x, float s) {
    return from_bits((as_bits(x) & 0x7FFFFFFFu) | (as_bits(s) & 0x80000000u));
}

/// Largest whole number not above `x`, for every float; -0, Inf and NaN give themselves.
static inline float m_floor(float x) {
    if (absolute(x) >= 8388608.0f || x == 0.0f || m_is_nan(x)) return x;
    float t = (float)(int)x;
    return t > x ? t - 1.0f : t;
}

/// Whole number nearest to `x`, halves away from zero; |x| < 2^22.
static inline int m_round_to_int(float x) {
    return (int)(x + m_with_sign(0.5f, x));
}

/// y * 2^n with one rounding; y in [0.25, 4], -151 <= n <= 130.
static inline float m_scale(float y, int n) {
    int first = n / 2;
    return y * from_bits((uint)(first + 127) << 23) * from_bits((uint)(n - first + 127) << 23);
}

/// a + b exactly, in any order of magnitude.
static inline FloatPair m_two_sum(float a, float b) {
    FloatPair r;
    r.high = a + b;
    float bb = r.high - a;
    r.low = (a - (r.high - bb)) + (b - bb);
    return r;
}

/// a + b exactly, when |a| >= |b|.
static inline FloatPair m_ordered_sum(float a, float b) {
    FloatPair r;
    r.high = a + b;
    r.low = b - (r.high - a);
    return r;
}

/// a * b exactly (Dekker), when |a|, |b| < 2^115 and the product is well above denormals.
static inline FloatPair m_two_product(float a, float b) {
    float ta = a * 4097.0f;
    float tb = b * 4097.0f;
    float ah = ta - (ta - a);
    float bh = tb - (tb - b);
    float al = a - ah;
    float bl = b - bh;
    FloatPair r;
    r.high = a * b;
    r.low = ((ah * bh - r.high) + ah * bl + al * bh) + al * bl;
    return r;
}

/// a * b to about 2^-46.
static inline FloatPair m_pair_product(FloatPair a, FloatPair b) {
    FloatPair p = m_two_product(a.high, b.high);
    return m_ordered_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

/// x - n * pi/2 for |n| < 2^13, to about 2^-50. The first three parts of pi/2 have at most 11 bits,
/// so their products are exact (Cody-Waite).
static inline FloatPair m_minus_half_pis(float x, float n) {
    float t = x - n * 1.5703125f;
    t = t - n * 4.83751297e-4f;
    FloatPair r = m_two_sum(t, -(n * 7.54953362e-8f));
    return m_two_sum(r.high, r.low - n * 2.56334407e-12f);
}

/// Sine and cosine of r.high + r.low radians, |r| <= pi / 4 but for rounding.
static inline void m_sincos_near_zero(FloatPair r, float* s, float* c) {
    float z = r.high * r.high;
    float sp = -1.6666667e-1f + z * (8.333379e-3f + z * (-1.9853066e-4f + z * 2.8325487e-6f));
    float cp = 4.1666646e-2f + z * (-1.388731e-3f + z * 2.4432327e-5f);
    float half_z = 0.5f * z;
    float w = 1.0f - half_z;
    *s = r.high + (r.high * z * sp + r.low * w);
    *c = w + (((1.0f - w) - half_z) + (z * z * cp - r.high * r.low));
}

/// Sine and cosine of `x` radians, |x| <= pi / 4.
static inline void m_sincos_octant(float x, float* s, float* c) {
    FloatPair r;
    r.high = x;
    r.low = 0.0f;
    m_sincos_near_zero(r, s, c);
}

/// Sine and cosine of `x` radians.
static inline void m_sincos(float x, float* s, float* c) {
    float size = absolute(x);
    *s = x;
    *c = 1.0f;
    if (size < 0.000244140625f) return;
    if (!(size <= M_SINCOS_RANGE)) {
        // x - x is NaN for Inf and NaN; finite values are past all accuracy, yet stay a unit
        // vector.
        *s = m_with_sign(x - x, x);
        *c = 1.0f + (x - x);
        return;
    }
    int n = m_round_to_int(x * 0.636619772f);
    FloatPair r = m_minus_half_pis(x, (float)n);
    float sine, cosine;
    m_sincos_near_zero(r, &sine, &cosine);
    float a = (n & 1) != 0 ? cosine : sine;
    float b = (n & 1) != 0 ? sine : cosine;
    *s = (n & 2) != 0 ? -a : a;
    *c = ((n + 1) & 2) != 0 ? -b : b;
}

/// (exp(r) - 1 - r) / r^2 for |r| <= ln(2) / 2.
static inline float m_exp_tail(float r) {
    return 0.5f +
           r * (1.6666636e-1f +
                r * (4.166651e-2f + r * (8.341512e-3f + r * (1.3930544e-3f + r * 1.5043921e-4f))));
}

/// exp(high + low), -104 <= high <= 89.
static inline float m_exp_pair(float high, float low) {
    int n = m_round_to_int(high * 1.44269504f);
    FloatPair r = m_ordered_sum(high - (float)n * M_LN2_HIGH, low - (float)n * M_LN2_LOW);
    float rest = r.high * r.high * m_exp_tail(r.high) + r.low;
    return m_scale(1.0f + (r.high + rest), n);
}

/// e to the power x.
static inline float m_exp(float x) {
    if (m_is_nan(x)) return x;
    return m_exp_pair(m_clamp(x, -104.0f, 89.0f), 0.0f);
}

/// exp(x) - 1 without cancellation near 0.
static inline float m_expm1(float x) {
    if (m_is_nan(x) || x == 0.0f) return x;
    if (x < -18.0f) return -1.0f;
    float y = m_min(x, 89.0f);
    int n = m_round_to_int(y * 1.44269504f);
    FloatPair r = m_ordered_sum(y - (float)n * M_LN2_HIGH, -((float)n * M_LN2_LOW));
    float rest = r.high * r.high * m_exp_tail(r.high) + r.low;
    if (n == 0) return r.high + rest;
    // 2^n ((1 - 2^-n) + (exp(r) - 1)): adding the large parts first keeps n = 1 and -1 accurate.
    float one = 1.0f - m_scale(1.0f, -n);
    FloatPair sum = m_two_sum(one, r.high);
    return m_scale(sum.high + (sum.low + rest), n);
}

/// Splits x > 0 as 2^k (1 + f) with 1 + f in [sqrt(1/2), sqrt(2)); returns f.
static inline float m_log_split(float x, int* k) {
    uint bits = as_bits(x);
    int shift = 0;
    if (bits < 0x00800000u) {
        bits = as_bits(x * 33554432.0f);
        shift = 25;
    }
    bits = bits + (0x3F800000u - 0x3F3504F3u);
    *k = (int)(bits >> 23) - 127 - shift;
    return from_bits((bits & 0x007FFFFFu) + 0x3F3504F3u) - 1.0f;
}

/// k ln(2) + ln(1 + f) + correction, by the series of atanh(f / (2 + f)).
static inline float m_log_sum(float f, int k, float correction) {
    float s = f / (2.0f + f);
    float z = s * s;
    float series =
        z * (6.666666e-1f + z * (4.0000972e-1f + z * (2.8498793e-1f + z * 2.4278852e-1f)));
    float half_square = 0.5f * f * f;
    float small = s * (half_square + series) + ((float)k * M_LN2_LOW + correction);
    return (small - half_square + f) + (float)k * M_LN2_HIGH;
}

/// Natural logarithm.
static inline float m_log(float x) {
    if (x == 0.0f) return -M_INFINITY;
    if (!(x > 0.0f)) return m_is_nan(x) ? x : M_NAN;
    if (x == M_INFINITY) return x;
    int k;
    float f = m_log_split(x, &k);
    return m_log_sum(f, k, 0.0f);
}

/// ln(1 + x) without cancellation near 0.
static inline float m_log1p(float x) {
    if (x == -1.0f) return -M_INFINITY;
    if (!(x > -1.0f)) return m_is_nan(x) ? x : M_NAN;
    if (x == M_INFINITY || absolute(x) < 2.98e-8f) return x;
    if (x > -0.29289f && x < 0.41421f) return m_log_sum(x, 0, 0.0f);
    FloatPair u = m_two_sum(1.0f, x);
    int k;
    float f = m_log_split(u.high, &k);
    return m_log_sum(f, k, u.low / u.high);
}

/// ln(x) to about 2^-40 of its value, for finite x > 0.
static inline FloatPair m_log_pair(float x) {
    int k;
    float f = m_log_split(x, &k);
    FloatPair d = m_ordered_sum(2.0f, f);
    FloatPair s;
    s.high = f / d.high;
    FloatPair back = m_two_product(s.high, d.high);
    s.low = (((f - back.high) - back.low) - s.high * d.low) / d.high;
    FloatPair z = m_pair_product(s, s);
    float tail = z.high * (4.0000153e-1f + z.high * (2.8547078e-1f + z.high * 2.342014e-1f));
    FloatPair factor = m_ordered_sum(6.6666669e-1f, tail);
    factor.low = factor.low - 1.9868216e-8f;
    FloatPair cubic = m_pair_product(m_pair_product(s, z), factor);
    FloatPair sum = m_ordered_sum(2.0f * s.high, cubic.high);
    sum.low = sum.low + (2.0f * s.low + cubic.low);
    FloatPair total = m_two_sum((float)k * M_LN2_HIGH, sum.high);
    return m_ordered_sum(total.high, total.low + (sum.low + (float)k * M_LN2_LOW));
}

/// x to the power y for x >= 0; pow(1, y) = pow(x, 0) = 1 even for NaN, pow(x, 1) = x exactly.
static inline float m_pow(float x, float y) {
    if (y == 0.0f || x == 1.0f) return 1.0f;
    if (m_is_nan(x) || m_is_nan(y) || x < 0.0f) return M_NAN;
    if (x == 0.0f || x == M_INFINITY) return (x == 0.0f) == (y < 0.0f) ? M_INFINITY : 0.0f;
    // |ln x| > 2^-25, so that an exponent beyond 2^33 already overflows or vanishes.
    y = m_clamp(y, -8589934592.0f, 8589934592.0f);
    FloatPair l = m_log_pair(x);
    FloatPair e = m_two_product(y, l.high);
    float high = e.high;
    if (high > 89.0f) return M_INFINITY;
    if (high < -104.0f) return 0.0f;
    return m_exp_pair(high, e.low + y * l.low);
}

/// atan(t) - t for |t| <= tan(pi/8).
static inline float m_atan_tail(float t) {
    float z = t * t;
    return t * z *
           (-3.3333316e-1f +
            z * (1.9998527e-1f + z * (-1.4244345e-1f + z * (1.0598728e-1f + z * -6.0887355e-2f))));
}

/// Angle of the point (x, y) in [-pi, pi]; zeros and infinities as in C99.
static inline float m_atan2(float y, float x) {
    if (m_is_nan(x) || m_is_nan(y)) return M_NAN;
    float ax = absolute(x);
    float ay = absolute(y);
    float large = m_max(ax, ay);
    float small = m_min(ax, ay);
    if (large == M_INFINITY) {
        small = small == M_INFINITY ? 1.0f : 0.0f;
        large = 1.0f;
    } else if (large > 1e38f) {
        small = 0.25f * small;
        large = 0.25f * large;
    }
    // Angle between the nearer axis and the point, as base + t + tail, at most pi/4.
    float t = large > 0.0f ? small / large : 0.0f;
    float base = 0.0f;
    float base_low = 0.0f;
    if (t > 0.41421356f) {
        t = (small - large) / (small + large);
        base = M_QUARTER_PI;
        base_low = M_QUARTER_PI_LOW;
    }
    float tail = m_atan_tail(t) + base_low;
    // Reflections at the diagonal and at the y axis, each as constant - angle.
    if (ay > ax) {
        base = M_HALF_PI - base;
        t = -t;
        tail = M_HALF_PI_LOW - tail;
    }
    if ((as_bits(x) & 0x80000000u) != 0u) {
        base = M_ONE_PI - base;
        t = -t;
        tail = M_ONE_PI_LOW - tail;
    }
    FloatPair sum = m_two_sum(base, t);
    return m_with_sign(sum.high + (sum.low + tail), y);
}

/// Arc sine in [-pi/2, pi/2].
static inline float m_asin(float x) {
    if (m_is_nan(x)) return x;
    float v = m_clamp(x, -1.0f, 1.0f);
    return m_atan2(v, square_root((1.0f - v) * (1.0f + v)));
}

/// Arc cosine in [0, pi].
static inline float m_acos(float x) {
    if (m_is_nan(x)) return x;
    float v = m_clamp(x, -1.0f, 1.0f);
    return m_atan2(square_root((1.0f - v) * (1.0f + v)), v);
}

#endif
