// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What the facets that previews call glossy reflect from one direction, and the pdf with which
// seen_lobes.h chooses it.
#ifndef WEFT_KERNELS_BSDF_GLOSSY_VALUE_H
#define WEFT_KERNELS_BSDF_GLOSSY_VALUE_H

#include "kernels/bsdf/seen_lobes.h"

/// The facets as seen where the surface's normal turns by that angle.
static inline Facets facets_turned(Facets facets, float turn) {
    if (!(turn > 0.0f)) return facets;
    float square = turn * turn;
    return make_facets(square_root(facets.alpha_x * facets.alpha_x + square),
                       square_root(facets.alpha_y * facets.alpha_y + square), facets.flags);
}

/// Adds what facets with that reflectance reflect from l to v, directions in their frame; `share`
/// is the probability with which they are chosen.
static inline void add_glossy_facets(Facets facets, float3 reflected, float share, float3 v,
                                     float3 l, LayeredValue* sum) {
    if (!(v.z > 0.0f && l.z > 0.0f)) return;
    float3 h = v + l;
    sum->value += reflected * facet_reflection(facets, v, l, h);
    sum->pdf += share * facet_pdf(facets, v, reflecting_cap(facets, v), h);
}

/// Of a layered material; directions in its frame.
static inline void add_glossy_layers(const LayeredBsdf* bsdf, const SeenLobes* lobes, float3 v,
                                     float3 l, float turn, LayeredValue* sum) {
    if (!(dot3(l, bsdf->geometric_normal) > 0.0f)) return;
    float coat = lobes->glossy_coat / (lobes->glossy_coat + lobes->glossy_boundary);
    if (coat > 0.0f)
        add_glossy_facets(
            facets_turned(bsdf->coat_facets, turn), f3(bsdf->coat, bsdf->coat, bsdf->coat), coat,
            local_direction(v, bsdf->coat_normal), local_direction(l, bsdf->coat_normal), sum);
    if (lobes->glossy_boundary > 0.0f)
        add_glossy_facets(facets_turned(bsdf->facets, turn),
                          boundary_fresnel(bsdf, facet_cosine(v + l)).reflected, 1.0f - coat, v, l,
                          sum);
}

/// The value times the cosine of `in`, 1/sr, of the facets on WAY_GLOSSY of `lobes`, and the pdf
/// with which the way's direction is `in`, a unit vector in the world. `turn` widens the facets by
/// an angle that the surface's normal turns by.
static inline LayeredValue glossy_value(const SurfaceScattering* scattering, const SeenLobes* lobes,
                                        float3 in, float turn) {
    LayeredValue sum;
    sum.value = f3(0.0f, 0.0f, 0.0f);
    sum.pdf = 0.0f;
    if (!(lobes->glossy_coat + lobes->glossy_boundary > 0.0f)) return sum;
    float3 v = scattering->v;
    float3 l = into_frame(&scattering->frame, in);
    if (scattering->model == SURFACE_PLASTIC) {
        const Plastic* plastic = &scattering->plastic;
        if (!(dot3(in, scattering->outward) > 0.0f)) return sum;
        float mirrored = dielectric_fresnel(plastic->ratio, facet_cosine(v + l)).reflected;
        add_glossy_facets(facets_turned(plastic->facets, turn), plastic->specular * mirrored, 1.0f,
                          v, l, &sum);
    } else {
        add_glossy_layers(&scattering->layered, lobes, v, l, turn, &sum);
    }
    sum.value = sum.value * (tilt_shadowing(scattering, in) * scattering->coverage);
    return sum;
}

#endif
