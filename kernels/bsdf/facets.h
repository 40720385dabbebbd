// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces made of tiny facets, each a mirror or a refracting boundary: how rough they are.
//
// Directions are unit vectors about +z, the surface's normal, and the axes of roughness are x and
// y. `v` leads to where the light goes, `l` to where it comes from.
#ifndef WEFT_KERNELS_BSDF_FACETS_H
#define WEFT_KERNELS_BSDF_FACETS_H

#include "kernels/core/maths.h"
#include "kernels/core/vector.h"

// Surfaces with less roughness are smooth: they reflect in one direction, have no value, and the
// pdf of what they send is written as 0. An 8-bit roughness of 4 / 255 is the least that is not.
#define LEAST_ALPHA 0.000244140625f  // 2^-12

#define FACETS_BECKMANN 1u   // distribution of normals; GGX without it
#define FACETS_SEPARABLE 2u  // masking of both directions independent; height-correlated without it

// The facets at a point. Roughness by the usual parameter alpha, sqrt(2) times the deviation of
// slopes for Beckmann's distribution; both are 0 for a smooth surface, and neither is below
// LEAST_ALPHA else.
typedef struct {
    float alpha_x, alpha_y;
    uint flags;  // FACETS_*
} Facets;

/// Facets with that roughness along x and y. They are smooth only where both are; where one is, it
/// is raised to the least that is not.
static inline Facets make_facets(float alpha_x, float alpha_y, uint flags) {
    Facets facets;
    bool smooth = !(alpha_x >= LEAST_ALPHA || alpha_y >= LEAST_ALPHA);
    facets.alpha_x = smooth ? 0.0f : m_max(alpha_x, LEAST_ALPHA);
    facets.alpha_y = smooth ? 0.0f : m_max(alpha_y, LEAST_ALPHA);
    facets.flags = flags;
    return facets;
}

static inline bool facets_are_smooth(Facets facets) {
    return facets.alpha_x == 0.0f;
}

#endif
