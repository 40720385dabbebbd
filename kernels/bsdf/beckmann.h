// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Facets whose slopes are distributed normally (Beckmann and Spizzichino 1963). Directions as in
// facets.h.
#ifndef WEFT_KERNELS_BSDF_BECKMANN_H
#define WEFT_KERNELS_BSDF_BECKMANN_H

#include "kernels/bsdf/facets.h"
#include "kernels/core/error_function.h"

/// Density of Beckmann's normals at h, exp(-tan^2 / alpha^2) / (pi alpha^2 cos^4), 1/sr; h.z > 0,
/// of any length.
static inline float beckmann_density(Facets facets, float3 h) {
    // Slopes first: squares of a tiny h have lost their digits.
    float slope_x = h.x / h.z;
    float slope_y = h.y / h.z;
    float x = slope_x / facets.alpha_x;
    float y = slope_y / facets.alpha_y;
    float steepness = x * x + y * y;
    // Where exp is 0 as a float; also where h.z is nearly 0.
    if (!(steepness < 80.0f)) return 0.0f;
    float ratio = 1.0f + slope_x * slope_x + slope_y * slope_y;
    return ratio * ratio * m_exp(-steepness) * M_INV_PI / (facets.alpha_x * facets.alpha_y);
}

/// Length of a direction's projection on the surface, stretched by the roughness.
static inline float beckmann_slope(Facets facets, float3 w) {
    float x = facets.alpha_x * w.x;
    float y = facets.alpha_y * w.y;
    return square_root(x * x + y * y);
}

/// masking_length of Beckmann's facets, by the rational fit of Walter et al. 2007.
static inline float beckmann_length(Facets facets, float3 w) {
    float height = absolute(w.z);
    float slope = beckmann_slope(facets, w);
    if (!(height < 1.6f * slope)) return height;
    float a = height / slope;
    return height + 2.0f * slope * (1.0f + a * (-1.259f + 0.396f * a)) / (3.535f + 2.181f * a);
}

#define M_INV_ROOT_PI 0.564189584f
#define M_HALF_ROOT_PI 0.886226925f

// Cotangent of a direction's stretched angle beyond which nothing is masked: of all facets exp(-64)
// lean further.
#define BECKMANN_STEEPEST 8.0f

/// Area of the facets that `v` sees, projected along it, for each area of the surface:
/// v.z (1 + Lambda(v)), exactly, where masking_length has a fit (Heitz 2014, equation 74). v.z > 0.
static inline float beckmann_seen(Facets facets, float3 v) {
    float slope = beckmann_slope(facets, v);
    float a = m_min(v.z / slope, BECKMANN_STEEPEST);
    return 0.5f * (v.z * (1.0f + m_erf(a)) + slope * m_exp(-(a * a)) * M_INV_ROOT_PI);
}

/// Normal of one of the facets that `v` sees, by numbers in [0, 1). v.z > 0.
static inline float3 sample_beckmann_facet(Facets facets, float3 v, float u, float w) {
    float slope = beckmann_slope(facets, v);
    float cotangent = v.z / slope;  // Inf straight on
    float a = m_min(cotangent, BECKMANN_STEEPEST);
    // Facets are seen by how much they lean towards `v`: of slopes p in its direction, in units of
    // alpha, the density is (v.z + slope p) exp(-p^2) for p > -a. Its sum for both signs is, in
    // |p|, v.z exp(-p^2), the same once more up to a, and slope |p| exp(-p^2) beyond a: all three
    // have an inverse in closed form.
    float all = M_HALF_ROOT_PI * v.z;
    float again = all * m_erf(a);
    float beyond = 0.5f * slope * m_exp(-(a * a));
    float at = u * (all + again + beyond);
    float along;
    if (at < all) {
        along = m_erf_inverse(at / all);
    } else if (at < all + again || !(beyond > 0.0f)) {
        along = m_erf_inverse((at - all) / all);
    } else {
        float share = m_min((at - all - again) / beyond, 0.99999994f);
        along = square_root(a * a - m_log1p(-share));
    }
    // Both signs are there up to a.
    float towards = along < a ? 0.5f + 0.5f * (along / cotangent) : 1.0f;
    float rest;
    if (w < towards) {
        rest = w / towards;
    } else {
        rest = (w - towards) / (1.0f - towards);
        along = -along;
    }
    float across = m_erf_inverse(2.0f * rest - 1.0f);
    float c = slope > 0.0f ? facets.alpha_x * v.x / slope : 1.0f;
    float s = slope > 0.0f ? facets.alpha_y * v.y / slope : 0.0f;
    return normalize3(f3(facets.alpha_x * (along * c - across * s),
                         facets.alpha_y * (along * s + across * c), 1.0f));
}

#endif
