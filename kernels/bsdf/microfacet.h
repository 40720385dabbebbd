// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The distributions of facets' normals by GGX (Walter et al. 2007) and Beckmann, both anisotropic,
// masking by Smith (Heitz 2014), and the choice of a facet among those that a direction sees.
// Directions as in facets.h. Values have the cosine of `l` in them.
#ifndef WEFT_KERNELS_BSDF_MICROFACET_H
#define WEFT_KERNELS_BSDF_MICROFACET_H

#include "kernels/bsdf/beckmann.h"
#include "kernels/core/sampling.h"

/// Density of GGX normals at h, which is not 0 and may have any length, 1/sr. Nothing cancels in
/// sums of squares of its components: the cosine of a normal near +z has lost its angle (at
/// alpha 2^-12 an error of 2e-4 instead of one of 100 %).
static inline float ggx_density(Facets facets, float3 h) {
    float x = h.x / facets.alpha_x;
    float y = h.y / facets.alpha_y;
    float ratio = dot3(h, h) / (x * x + y * y + h.z * h.z);
    return ratio * ratio * M_INV_PI / (facets.alpha_x * facets.alpha_y);
}

/// Density of the normals' distribution at h, which is not 0 and may have any length, 1/sr; 0 where
/// h is not above the surface.
static inline float facet_density(Facets facets, float3 h) {
    if (!(h.z > 0.0f)) return 0.0f;
    return (facets.flags & FACETS_BECKMANN) != 0u ? beckmann_density(facets, h)
                                                  : ggx_density(facets, h);
}

/// Length of a direction after the stretching that makes GGX facets those of a sphere.
static inline float ggx_length(Facets facets, float3 w) {
    float x = facets.alpha_x * w.x;
    float y = facets.alpha_y * w.y;
    return square_root(x * x + y * y + w.z * w.z);
}

/// s(w) = |w.z| (1 + 2 Lambda(w)), by which the share of facets that `w` sees of those that face it
/// is 2 |w.z| / (|w.z| + s(w)) (Smith 1967). Finite along the surface, where Lambda is not.
static inline float masking_length(Facets facets, float3 w) {
    return (facets.flags & FACETS_BECKMANN) != 0u ? beckmann_length(facets, w)
                                                  : ggx_length(facets, w);
}

/// Share of the facets that both directions see, over 4 |v.z|: masking as reflections need it, with
/// the cosine of `l`. `l` may be on either side.
static inline float masked_cosine(Facets facets, float3 v, float3 l) {
    float sv = masking_length(facets, v);
    float sl = masking_length(facets, l);
    float vz = absolute(v.z);
    float lz = absolute(l.z);
    if ((facets.flags & FACETS_SEPARABLE) != 0u) return lz / ((vz + sv) * (lz + sl));
    // Ross et al. 2005; Heitz 2014, equation 99.
    return lz / (2.0f * (vz * sl + lz * sv));
}

/// Value times cosine of facets that reflect all light, 1/sr, for `h` = v + l; both directions are
/// above the surface. Times the facets' Fresnel reflectance at c = |h| / 2 it is that of the
/// surface.
static inline float facet_reflection(Facets facets, float3 v, float3 l, float3 h) {
    return facet_density(facets, h) * masked_cosine(facets, v, l);
}

/// Cosine between a direction and the facet that reflects it into another, where h is their sum.
static inline float facet_cosine(float3 h) {
    return m_min(0.5f * square_root(dot3(h, h)), 1.0f);
}

// Facets are chosen in proportion to how large a direction sees them. Those of GGX (Heitz 2018) are
// points of a cap of the unit sphere that is cut off at z = -k times the height of the direction
// (Dupuy and Benyoub 2023): of k = 1 come all visible facets, of less only those that can reflect
// light upwards (Eto and Tokuyoshi 2023). For Beckmann's, all visible ones, k has no meaning.

/// The k for reflections.
static inline float reflecting_cap(Facets facets, float3 v) {
    float a = m_min(m_min(facets.alpha_x, facets.alpha_y), 1.0f);
    float t = 1.0f + square_root(v.x * v.x + v.y * v.y);
    float t2 = t * t;
    return (1.0f - a) * (1.0f + a) * t2 / (t2 + a * a * v.z * v.z);
}

/// A facet's normal, by numbers in [0, 1). v.z > 0.
static inline float3 sample_facet(Facets facets, float3 v, float k, float u, float w) {
    if ((facets.flags & FACETS_BECKMANN) != 0u) return sample_beckmann_facet(facets, v, u, w);
    float3 stretched = f3(facets.alpha_x * v.x, facets.alpha_y * v.y, v.z);
    float3 axis = stretched / square_root(dot3(stretched, stretched));
    // The height on the cap is 1 - less. Its distance from the axis by both, so that neither end
    // cancels.
    float less = w * (1.0f + k * axis.z);
    float more = (1.0f - w) * (1.0f + k * axis.z) + (1.0f - k * axis.z);
    float radius = square_root(less * more);
    float s, c;
    m_sincos(M_TWO_PI * u, &s, &c);
    float3 normal = f3(facets.alpha_x * (radius * c + axis.x),
                       facets.alpha_y * (radius * s + axis.y), m_max((1.0f - less) + axis.z, 0.0f));
    return normalize3(normal);
}

/// Pdf of a facet with the normal h, of any length, over 4 times its cosine with `v`: the pdf of
/// its reflection, 1/sr, of directions above the surface or not.
static inline float facet_pdf(Facets facets, float3 v, float k, float3 h) {
    if ((facets.flags & FACETS_BECKMANN) != 0u)
        return h.z > 0.0f ? beckmann_density(facets, h) / (4.0f * beckmann_seen(facets, v)) : 0.0f;
    return ggx_density(facets, h) / (2.0f * (k * v.z + ggx_length(facets, v)));
}

#endif
