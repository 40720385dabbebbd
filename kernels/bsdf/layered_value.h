// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What the parts of a layered material reflect and transmit from one direction, and the pdf with
// which samples choose it (layered_sample.h).
#ifndef WEFT_KERNELS_BSDF_LAYERED_VALUE_H
#define WEFT_KERNELS_BSDF_LAYERED_VALUE_H

#include "kernels/bsdf/layered.h"

/// The k by which facets of the boundary are chosen (sample_facet).
static inline float boundary_cap(const LayeredBsdf* bsdf, float3 v) {
    return bsdf->glass > 0.0f ? 1.0f : reflecting_cap(bsdf->facets, v);
}

// A value times the cosine and the pdf of one part or of several.
typedef struct {
    float3 value;
    float pdf;
} LayeredValue;

static inline LayeredValue coat_value(const LayeredBsdf* bsdf, float3 v, float3 l) {
    LayeredValue part;
    part.value = f3(0.0f, 0.0f, 0.0f);
    part.pdf = 0.0f;
    if (!(bsdf->p_coat > 0.0f) || facets_are_smooth(bsdf->coat_facets)) return part;
    float3 coat_v = local_direction(v, bsdf->coat_normal);
    float3 coat_l = local_direction(l, bsdf->coat_normal);
    if (!(coat_v.z > 0.0f && coat_l.z > 0.0f)) return part;
    float3 h = coat_v + coat_l;
    float value = bsdf->coat * facet_reflection(bsdf->coat_facets, coat_v, coat_l, h);
    part.value = f3(value, value, value);
    float k = reflecting_cap(bsdf->coat_facets, coat_v);
    part.pdf = bsdf->p_coat * facet_pdf(bsdf->coat_facets, coat_v, k, h);
    return part;
}

/// What rough facets of the boundary with the normal h, of any length, and that reflectance reflect
/// from l.
static inline LayeredValue boundary_reflection(const LayeredBsdf* bsdf, float3 v, float3 l,
                                               float3 h, ColouredFresnel f) {
    LayeredValue part;
    part.value = f.reflected * facet_reflection(bsdf->facets, v, l, h);
    part.pdf = bsdf->p_boundary * reflection_share(f) *
               facet_pdf(bsdf->facets, v, boundary_cap(bsdf, v), h);
    return part;
}

/// What rough facets of glass that transmit as `f` says refract from l.
static inline LayeredValue boundary_refraction(const LayeredBsdf* bsdf, float3 v, float3 l,
                                               RefractingFacet facet, ColouredFresnel f) {
    LayeredValue part;
    part.value = f.transmitted * facet_refraction(bsdf->facets, v, l, facet);
    part.pdf =
        bsdf->p_boundary * (1.0f - reflection_share(f)) * refraction_pdf(bsdf->facets, v, facet);
    return part;
}

static inline LayeredValue boundary_value(const LayeredBsdf* bsdf, float3 v, float3 l) {
    LayeredValue part;
    part.value = f3(0.0f, 0.0f, 0.0f);
    part.pdf = 0.0f;
    if (!(bsdf->p_boundary > 0.0f) || facets_are_smooth(bsdf->facets)) return part;
    if (l.z > 0.0f) {
        float3 h = v + l;
        return boundary_reflection(bsdf, v, l, h, boundary_fresnel(bsdf, facet_cosine(h)));
    }
    if (!(bsdf->glass > 0.0f)) return part;
    RefractingFacet facet = refracting_facet(bsdf->ratio, v, l);
    if (!(facet.h.z > 0.0f)) return part;
    return boundary_refraction(bsdf, v, l, facet, boundary_fresnel(bsdf, facet.c));
}

static inline LayeredValue sheet_value(const LayeredBsdf* bsdf, float3 v, float3 l) {
    LayeredValue part;
    part.value = f3(0.0f, 0.0f, 0.0f);
    part.pdf = 0.0f;
    if (!(bsdf->p_sheet > 0.0f && l.z < 0.0f) || facets_are_smooth(bsdf->sheet)) return part;
    float3 mirrored = across_sheet(l);
    float3 h = v + mirrored;
    part.value = bsdf->sheet_colour * facet_reflection(bsdf->sheet, v, mirrored, h);
    part.pdf = bsdf->p_sheet * facet_pdf(bsdf->sheet, v, reflecting_cap(bsdf->sheet, v), h);
    return part;
}

/// What a coat that is not smooth and the body reflect from l, on the side of the triangle.
static inline LayeredValue coat_and_body(const LayeredBsdf* bsdf, float3 v, float3 l) {
    LayeredValue both = coat_value(bsdf, v, l);
    float cosine = dot3(l, bsdf->diffuse_normal);
    if (bsdf->p_diffuse > 0.0f && cosine > 0.0f) {
        both.value += bsdf->diffuse * (cosine * M_INV_PI);
        both.pdf += bsdf->p_diffuse * cosine_pdf(cosine);
    }
    return both;
}

/// The value times the cosine of `l`, 1/sr, of all parts that are not smooth, and the pdf with
/// which layered_sample chooses `l` by any of them.
static inline LayeredValue layered_eval(const LayeredBsdf* bsdf, float3 v, float3 l) {
    LayeredValue whole;
    whole.value = f3(0.0f, 0.0f, 0.0f);
    whole.pdf = 0.0f;
    if (!(v.z > 0.0f)) return whole;
    float side = dot3(l, bsdf->geometric_normal);
    if (side > 0.0f) whole = coat_and_body(bsdf, v, l);
    // Facets reflect to the side of the triangle on which they are, and refract to the other.
    if (side * l.z > 0.0f) {
        LayeredValue boundary = boundary_value(bsdf, v, l);
        LayeredValue sheet = sheet_value(bsdf, v, l);
        whole.value += boundary.value + sheet.value;
        whole.pdf += boundary.pdf + sheet.pdf;
    }
    return whole;
}

#endif
