// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// float3 helpers. The type and its operators (+ - * componentwise and with a scalar, / by a scalar)
// come from port.h; built-ins such as OpenCL's dot() are avoided because their rounding is free.
#ifndef WEFT_KERNELS_CORE_VECTOR_H
#define WEFT_KERNELS_CORE_VECTOR_H

#include "kernels/core/maths.h"

// LANES vectors.
typedef struct {
    WFloat x, y, z;
} WFloat3;

/// The first three components.
static inline float3 xyz(float4 v) {
    return f3(v.x, v.y, v.z);
}

/// Scalar product.
static inline float dot3(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Vector product; exactly antisymmetric.
static inline float3 cross3(float3 a, float3 b) {
    return f3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// Largest component.
static inline float max_component(float3 v) {
    return m_max(m_max(v.x, v.y), v.z);
}

/// Smallest component.
static inline float min_component(float3 v) {
    return m_min(m_min(v.x, v.y), v.z);
}

/// Componentwise magnitude.
static inline float3 absolute3(float3 v) {
    return f3(absolute(v.x), absolute(v.y), absolute(v.z));
}

/// Componentwise smaller value.
static inline float3 lowest3(float3 a, float3 b) {
    return f3(m_min(a.x, b.x), m_min(a.y, b.y), m_min(a.z, b.z));
}

/// Componentwise larger value.
static inline float3 highest3(float3 a, float3 b) {
    return f3(m_max(a.x, b.x), m_max(a.y, b.y), m_max(a.z, b.z));
}

/// Axis of the component of largest magnitude (0, 1 or 2), the first of equal ones.
static inline int dominant_axis(float3 v) {
    float3 a = absolute3(v);
    if (a.x >= a.y && a.x >= a.z) return 0;
    return a.y >= a.z ? 1 : 2;
}

/// Whether `x` is neither Inf nor NaN, by its bits, so that no compiler option can remove the test.
static inline bool is_finite1(float x) {
    return (as_bits(x) & 0x7F800000u) != 0x7F800000u;
}

/// Whether all components are finite.
static inline bool is_finite3(float3 v) {
    return is_finite1(v.x) && is_finite1(v.y) && is_finite1(v.z);
}

/// The power of two that brings `size`, at least 0, into [1, 4), or to less where it is denormal;
/// so that squares are floats that neither overflow nor underflow. Its reciprocal is a float too.
static inline float scale_to_one(float size) {
    uint exponent = as_bits(size) >> 23;
    if (exponent < 1u) exponent = 1u;
    if (exponent > 253u) exponent = 253u;
    return from_bits((254u - exponent) << 23);
}

/// 1 / `scale`, a power of two of scale_to_one, without a division.
static inline float reciprocal_of_scale(float scale) {
    return from_bits((254u << 23) - as_bits(scale));
}

/// Euclidean length to 3 ulp for every vector whose length is a float; Inf or NaN otherwise.
static inline float length3(float3 v) {
    // Scaled first: the square of a component of 1e-30 or 1e30 is no float.
    float size = max_component(absolute3(v));
    if (!(size > 0.0f && size < M_INFINITY)) {
        return absolute(v.x) + absolute(v.y) + absolute(v.z);
    }
    float scale = scale_to_one(size);
    float3 u = v * scale;
    return square_root(dot3(u, u)) * reciprocal_of_scale(scale);
}

/// `v` at length 1; the zero vector when `v` is zero or has a component that is Inf or NaN.
static inline float3 normalize3(float3 v) {
    float3 u = v * scale_to_one(max_component(absolute3(v)));
    float square = dot3(u, u);
    if (!(square > 0.0f && square < M_INFINITY)) return f3(0.0f, 0.0f, 0.0f);
    // Divided, so that a vector along an axis is along it afterwards, to the bit.
    return u / square_root(square);
}

/// Tangents t, b that make (t, b, n) a right-handed orthonormal basis for a unit vector n
/// (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
static inline void make_basis(float3 n, float3* t, float3* b) {
    float s = m_with_sign(1.0f, n.z);
    float a = -1.0f / (s + n.z);
    float c = n.x * n.y * a;
    *t = f3(1.0f + s * n.x * n.x * a, s * c, -s * n.x);
    *b = f3(c, s + n.y * n.y * a, -n.y);
}

/// Relative luminance of linear Rec.709 RGB, in the unit of `rgb`.
static inline float luminance(float3 rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

#endif
