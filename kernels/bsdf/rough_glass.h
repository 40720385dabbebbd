// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Light that passes a boundary made of refracting facets (Walter et al. 2007): into a solid body of
// glass, or out of it.
//
// Values are of basic radiance, the radiance over the square of the index where it is. An interface
// leaves it as it is but for what it reflects, so that no factor eta^2 appears on either way, and
// light and importance use the same function: n_v^2 f(v, l) = n_l^2 f(l, v).
#ifndef WEFT_KERNELS_BSDF_ROUGH_GLASS_H
#define WEFT_KERNELS_BSDF_ROUGH_GLASS_H

#include "kernels/bsdf/fresnel.h"
#include "kernels/bsdf/microfacet.h"

// The facet that refracts `l`, on the other side of the surface, into `v`.
typedef struct {
    float3 h;        // its normal, above the surface, of any length; z is 0 where no facet does
    float c;         // cosine between the normal and v
    float g;         // see DielectricFresnel
    float jacobian;  // solid angle of normals per solid angle of l
} RefractingFacet;

/// v.z > 0. The normal is along v + eta l (Walter et al. 2007, equation 16).
static inline RefractingFacet refracting_facet(IndexRatio ratio, float3 v, float3 l) {
    RefractingFacet facet;
    float3 h = v + l * ratio.eta;
    // Towards the side with the smaller index, and so below the surface where that is the far one.
    facet.h = h.z < 0.0f ? -h : h;
    float length = square_root(dot3(h, h));
    float c = length > 0.0f ? dot3(facet.h, v) / length : 0.0f;
    float square = c * c + ratio.step;
    facet.c = m_min(c, 1.0f);
    facet.g = 0.0f;
    facet.jacobian = 0.0f;
    if (!(l.z < 0.0f && c > 0.0f && dot3(facet.h, l) < 0.0f && square > 0.0f)) {
        facet.h.z = 0.0f;
        return facet;
    }
    facet.g = square_root(square);
    // eta^2 |l.h| / (c + eta l.h)^2 (equation 17), whose denominator would cancel: it is (c - g)^2.
    float sum = (facet.c + facet.g) / ratio.step;
    facet.jacobian = ratio.eta * facet.g * sum * sum;
    return facet;
}

/// Value times cosine of facets that transmit all light, 1/sr of `l`. Times the facets' Fresnel
/// transmittance it is that of the surface (equation 21).
static inline float facet_refraction(Facets facets, float3 v, float3 l, RefractingFacet facet) {
    float density = facet_density(facets, facet.h);
    // 4 c in place of 1: facet_reflection has the Jacobian 1 / (4 c) of a mirror.
    return density * masked_cosine(facets, v, l) * (4.0f * facet.c) * facet.jacobian;
}

/// Pdf of the refraction at a facet that sample_facet chooses with k = 1, 1/sr of `l`.
static inline float refraction_pdf(Facets facets, float3 v, RefractingFacet facet) {
    if (!(facet.h.z > 0.0f)) return 0.0f;
    return facet_pdf(facets, v, 1.0f, facet.h) * (4.0f * facet.c) * facet.jacobian;
}

#endif
