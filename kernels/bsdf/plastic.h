// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Mitsuba's `plastic` and `roughplastic`, with the bits of its formulas that its images depend on:
// a diffuse body below a dielectric boundary, whose light is refracted at both ways through it.
// Directions as in kernels/bsdf/layered.h; the whole lies above the surface.
#ifndef WEFT_KERNELS_BSDF_PLASTIC_H
#define WEFT_KERNELS_BSDF_PLASTIC_H

#include "kernels/bsdf/fresnel.h"
#include "kernels/bsdf/lobe.h"
#include "kernels/bsdf/microfacet.h"

// Nodes of a table of what rough boundaries transmit from outside, by even steps of the cosine. The
// host makes one for each roughness and index (host/scene/surface/plastic_table.h).
#define PLASTIC_NODES 64

typedef struct {
    Facets facets;
    IndexRatio ratio;  // from outside
    float3 specular;   // factor of the boundary's reflection
    float3 body;       // plastic_body
    float weight;      // share of the specular reflectance in the sum of both, by their means
    GLOBAL const float* transmittance;  // PLASTIC_NODES values, for facets that are not smooth
} Plastic;

/// Share of diffuse light from inside that a smooth boundary reflects, by the fit that Mitsuba has
/// of it (Egan and Hilgeman 1973).
static inline float inner_reflectance(float eta) {
    float x = 1.0f / eta;
    return -1.4399f * (x * x) + 0.7099f * x + 0.6681f + 0.0636f * eta;
}

/// The body's albedo with all reflections at the boundary from inside, over the eta^2 of basic
/// radiance. `nonlinear`: each of them takes up the colour once more.
static inline float3 plastic_body(float3 diffuse, float inner, bool nonlinear, float eta) {
    float3 lost = nonlinear ? diffuse * inner : f3(inner, inner, inner);
    float scale = 1.0f / (eta * eta);
    return f3(diffuse.x * scale / (1.0f - lost.x), diffuse.y * scale / (1.0f - lost.y),
              diffuse.z * scale / (1.0f - lost.z));
}

/// Share of the light of a direction that enters the body.
static inline float plastic_transmittance(const Plastic* plastic, float cosine) {
    if (facets_are_smooth(plastic->facets))
        return dielectric_fresnel(plastic->ratio, cosine).transmitted;
    float at = m_clamp(cosine, 0.0f, 1.0f) * (float)(PLASTIC_NODES - 1);
    uint node = (uint)m_min(at, (float)(PLASTIC_NODES - 2));
    float along = at - (float)node;
    return plastic->transmittance[node] * (1.0f - along) +
           plastic->transmittance[node + 1u] * along;
}

/// Probability with which samples choose the boundary.
static inline float plastic_choice(const Plastic* plastic, float transmitted) {
    float boundary = plastic->weight * (1.0f - transmitted);
    float body = (1.0f - plastic->weight) * transmitted;
    if (!(boundary > 0.0f)) return 0.0f;
    return body > 0.0f ? boundary / (boundary + body) : 1.0f;
}

/// Value times cosine, 1/sr, and `*pdf` of plastic_sample; without the mirror of a smooth boundary.
static inline float3 plastic_eval(const Plastic* plastic, float3 v, float3 l, float* pdf) {
    *pdf = 0.0f;
    if (!(v.z > 0.0f && l.z > 0.0f)) return f3(0.0f, 0.0f, 0.0f);
    float entering = plastic_transmittance(plastic, v.z);
    float choice = plastic_choice(plastic, entering);
    float leaving = plastic_transmittance(plastic, l.z);
    *pdf = (1.0f - choice) * cosine_pdf(l.z);
    float3 value = plastic->body * (entering * leaving * cosine_pdf(l.z));
    if (facets_are_smooth(plastic->facets)) return value;
    float3 h = v + l;
    float reflected = dielectric_fresnel(plastic->ratio, facet_cosine(h)).reflected;
    *pdf += choice * facet_pdf(plastic->facets, v, reflecting_cap(plastic->facets, v), h);
    return value + plastic->specular * (reflected * facet_reflection(plastic->facets, v, l, h));
}

/// Chooses `in` for v; see layered_sample.
static inline BsdfSample plastic_sample(const Plastic* plastic, float3 v, float choice, float u,
                                        float w) {
    BsdfSample sample = no_sample(v);
    if (!(v.z > 0.0f)) return sample;
    float entering = plastic_transmittance(plastic, v.z);
    float mirror = plastic_choice(plastic, entering);
    bool smooth = facets_are_smooth(plastic->facets);
    if (choice < mirror && smooth) {
        sample.in = f3(-v.x, -v.y, v.z);
        sample.weight = plastic->specular * ((1.0f - entering) / mirror);
        sample.flags = BSDF_REFLECTION | BSDF_DELTA;
        return sample;
    }
    sample.flags = BSDF_REFLECTION | BSDF_DIFFUSE;
    if (choice < mirror) {
        float3 m = sample_facet(plastic->facets, v, reflecting_cap(plastic->facets, v), u, w);
        sample.in = reflected_direction(v, m, dot3(v, m));
        sample.flags = BSDF_REFLECTION;
    } else {
        sample.in = cosine_direction(u, w);
    }
    // 0 where the facet reflects downwards.
    float3 value = plastic_eval(plastic, v, sample.in, &sample.pdf);
    if (sample.pdf > 0.0f)
        sample.weight = value / sample.pdf;
    else
        sample.flags = 0u;
    return sample;
}

#endif
