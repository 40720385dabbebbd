// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Sheets of glass without a thickness: what they do not reflect goes on beyond them without a bend,
// at rough ones scattered about that way.
#ifndef WEFT_KERNELS_BSDF_THIN_GLASS_H
#define WEFT_KERNELS_BSDF_THIN_GLASS_H

#include "kernels/bsdf/fresnel.h"
#include "kernels/bsdf/microfacet.h"

/// Facets that stand for both sides of a sheet in what it transmits, which is the clearer the less
/// its index bends light (as the Khronos glTF viewer has it: alpha times 2 ior - 2, at most 1).
static inline Facets sheet_facets(Facets facets, float ior) {
    float scale = m_clamp(2.0f * ior - 2.0f, 0.0f, 1.0f);
    return make_facets(facets.alpha_x * scale, facets.alpha_y * scale, facets.flags);
}

/// A direction beyond the sheet as one on this side, and back.
static inline float3 across_sheet(float3 l) {
    return f3(l.x, l.y, -l.z);
}

// The shares of light that a pane of clear glass reflects and transmits.
typedef struct {
    float reflected, transmitted;  // their sum is 1
} Pane;

/// Both surfaces of a pane with all reflections between them, R + T R T + T R^3 T + ...
/// (Stokes 1860), as Mitsuba's `thindielectric` has it. `c` is the cosine outside.
static inline Pane pane_of_glass(IndexRatio ratio, float c) {
    DielectricFresnel f = dielectric_fresnel(ratio, c);
    Pane pane;
    // Without total reflection, which only a pane of less than air would show from outside.
    float sum = 1.0f + f.reflected;
    pane.reflected = 2.0f * f.reflected / sum;
    pane.transmitted = f.transmitted / sum;
    return pane;
}

#endif
