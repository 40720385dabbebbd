// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Samples of a layered material: one of its parts is chosen, and by it a direction. Smooth parts
// send light into one direction; a sample of a rough part has the value and the pdf of all.
#ifndef WEFT_KERNELS_BSDF_LAYERED_SAMPLE_H
#define WEFT_KERNELS_BSDF_LAYERED_SAMPLE_H

#include "kernels/bsdf/layered_value.h"

/// A sample of the one direction into which a smooth part sends light. Of the wrong side of the
/// triangle it has no weight.
static inline BsdfSample smooth_sample(const LayeredBsdf* bsdf, float3 in, float3 weight,
                                       uint kind) {
    BsdfSample sample;
    sample.in = in;
    sample.pdf = 0.0f;
    sample.flags = kind | BSDF_DELTA;
    float side = dot3(in, bsdf->geometric_normal);
    bool fits = kind == BSDF_REFLECTION ? side > 0.0f : side < 0.0f;
    sample.weight = fits ? weight : f3(0.0f, 0.0f, 0.0f);
    return sample;
}

/// A sample of value and pdf `whole`; without weight where that is 0.
static inline BsdfSample valued_sample(float3 in, LayeredValue whole, uint kind) {
    BsdfSample sample = no_sample(in);
    if (!(whole.pdf > 0.0f)) return sample;
    sample.pdf = whole.pdf;
    sample.weight = whole.value / whole.pdf;
    sample.flags = kind;
    return sample;
}

/// Whether what a part sends from `in` counts as chosen by it: `height` is that of `in` in the
/// frame of the part, which other parts must not get where facets reflect down or refract up.
static inline bool fits_kind(const LayeredBsdf* bsdf, float3 in, float height, uint kind) {
    float side = dot3(in, bsdf->geometric_normal);
    return (kind & BSDF_REFLECTION) != 0u ? side > 0.0f && height > 0.0f
                                          : side < 0.0f && height < 0.0f;
}

/// A sample of a part that is not smooth: its weight and pdf are those of all parts.
static inline BsdfSample rough_sample(const LayeredBsdf* bsdf, float3 v, float3 in, float height,
                                      uint kind) {
    LayeredValue whole;
    whole.value = f3(0.0f, 0.0f, 0.0f);
    whole.pdf = 0.0f;
    if (fits_kind(bsdf, in, height, kind)) whole = layered_eval(bsdf, v, in);
    return valued_sample(in, whole, kind);
}

/// rough_sample of the boundary, whose Fresnel's equations are solved.
static inline BsdfSample rough_boundary_sample(const LayeredBsdf* bsdf, float3 v, float3 in,
                                               ColouredFresnel f, uint kind) {
    LayeredValue whole;
    whole.value = f3(0.0f, 0.0f, 0.0f);
    whole.pdf = 0.0f;
    if (!fits_kind(bsdf, in, in.z, kind)) return valued_sample(in, whole, kind);
    if (kind == BSDF_REFLECTION) {
        LayeredValue boundary = boundary_reflection(bsdf, v, in, v + in, f);
        if (bsdf->alone == 0) whole = coat_and_body(bsdf, v, in);
        whole.value += boundary.value;
        whole.pdf += boundary.pdf;
        return valued_sample(in, whole, kind);
    }
    RefractingFacet facet = refracting_facet(bsdf->ratio, v, in);
    if (facet.h.z > 0.0f) whole = boundary_refraction(bsdf, v, in, facet, f);
    LayeredValue sheet = sheet_value(bsdf, v, in);
    whole.value += sheet.value;
    whole.pdf += sheet.pdf;
    return valued_sample(in, whole, kind);
}

static inline BsdfSample sample_coat(const LayeredBsdf* bsdf, float3 v, float u, float w) {
    float3 coat_v = local_direction(v, bsdf->coat_normal);
    if (facets_are_smooth(bsdf->coat_facets)) {
        float value = bsdf->coat / bsdf->p_coat;
        return smooth_sample(bsdf, reflected_direction(v, bsdf->coat_normal, coat_v.z),
                             f3(value, value, value), BSDF_REFLECTION);
    }
    float3 m =
        sample_facet(bsdf->coat_facets, coat_v, reflecting_cap(bsdf->coat_facets, coat_v), u, w);
    float3 in = reflected_direction(coat_v, m, dot3(coat_v, m));
    return rough_sample(bsdf, v, to_world(in, bsdf->coat_normal), in.z, BSDF_REFLECTION);
}

/// `choice`, in [0, 1), takes the side at boundaries of glass.
static inline BsdfSample sample_boundary(const LayeredBsdf* bsdf, float3 v, float choice, float u,
                                         float w) {
    bool rough = !facets_are_smooth(bsdf->facets);
    float3 m = f3(0.0f, 0.0f, 1.0f);
    if (rough) m = sample_facet(bsdf->facets, v, boundary_cap(bsdf, v), u, w);
    float c = m_clamp(dot3(v, m), 0.0f, 1.0f);
    ColouredFresnel f = boundary_fresnel(bsdf, c);
    float share = reflection_share(f);
    if (choice < share) {
        float3 in = reflected_direction(v, m, c);
        if (rough) return rough_boundary_sample(bsdf, v, in, f, BSDF_REFLECTION);
        return smooth_sample(bsdf, in, f.reflected / (bsdf->p_boundary * share), BSDF_REFLECTION);
    }
    float3 in = refracted_direction(bsdf->ratio, v, m, c, f.g);
    if (rough) return rough_boundary_sample(bsdf, v, in, f, BSDF_TRANSMISSION);
    return smooth_sample(bsdf, in, f.transmitted / (bsdf->p_boundary * (1.0f - share)),
                         BSDF_TRANSMISSION);
}

static inline BsdfSample sample_sheet(const LayeredBsdf* bsdf, float3 v, float u, float w) {
    if (facets_are_smooth(bsdf->sheet))
        return smooth_sample(bsdf, -v, bsdf->sheet_colour / bsdf->p_sheet, BSDF_TRANSMISSION);
    float3 m = sample_facet(bsdf->sheet, v, reflecting_cap(bsdf->sheet, v), u, w);
    float3 in = across_sheet(reflected_direction(v, m, dot3(v, m)));
    return rough_sample(bsdf, v, in, in.z, BSDF_TRANSMISSION);
}

/// Chooses `in` for v by three numbers in [0, 1). Without BSDF_DELTA in its flags the sample has
/// the pdf and the weight of layered_eval; with it the pdf is 0. Flags and weight are 0 where no
/// light comes of it.
static inline BsdfSample layered_sample(const LayeredBsdf* bsdf, float3 v, float choice, float u,
                                        float w) {
    if (!(v.z > 0.0f)) return no_sample(v);
    float before = bsdf->p_coat;
    if (choice < before) return sample_coat(bsdf, v, u, w);
    if (choice < before + bsdf->p_boundary)
        return sample_boundary(bsdf, v, rescale_number(choice, before, bsdf->p_boundary), u, w);
    before += bsdf->p_boundary;
    if (choice < before + bsdf->p_sheet) return sample_sheet(bsdf, v, u, w);
    if (!(bsdf->p_diffuse > 0.0f)) {
        // The sum of the probabilities may be one rounding below 1.
        if (bsdf->p_sheet > 0.0f) return sample_sheet(bsdf, v, u, w);
        if (bsdf->p_boundary > 0.0f) return sample_boundary(bsdf, v, 0.0f, u, w);
        return bsdf->p_coat > 0.0f ? sample_coat(bsdf, v, u, w) : no_sample(v);
    }
    float3 in = cosine_direction(u, w);
    return rough_sample(bsdf, v, to_world(in, bsdf->diffuse_normal), in.z,
                        BSDF_REFLECTION | BSDF_DIFFUSE);
}

#endif
