// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The layered material of glTF: under a coat lies a boundary of facets, of a metal, a dielectric or
// a mixture of both, and under the dielectric a diffuse body or clear glass. Its parts share what
// light they leave each other by albedos (kernels/bsdf/albedo_tables.h), so that a white one
// reflects or transmits all light and none more than it gets.
//
// All directions are in the frame of the facets: their normal is +z, their axes of roughness are x
// and y. `v` leads to where light goes and is above the surface, `l` to where it comes from.
#ifndef WEFT_KERNELS_BSDF_LAYERED_H
#define WEFT_KERNELS_BSDF_LAYERED_H

#include "kernels/bsdf/albedo_tables.h"
#include "kernels/bsdf/lobe.h"
#include "kernels/bsdf/rough_glass.h"
#include "kernels/bsdf/thin_glass.h"

#define LAYERED_THIN 1u            // what is transmitted goes straight on; solid glass without it
#define LAYERED_CONDUCTOR 2u       // the metal by its index, times the base colour
#define LAYERED_SINGLE_SCATTER 4u  // light that is reflected twice between facets is lost
// A clear dielectric whose f0 and base are factors of what Fresnel's equations say is reflected and
// transmitted; where it is thin, with all reflections between its sides (pane_of_glass).
#define LAYERED_EXACT_FRESNEL 16384u

// What a material is at one point, with textures in it. Colours and shares are in [0, 1].
typedef struct {
    uint flags;             // LAYERED_*
    float metallic;         // share of metal, 1 with LAYERED_CONDUCTOR
    float transmission;     // share of the dielectric that is clear
    float3 base;            // reflected by metal and body, transmitted by each boundary of glass
    float3 f0;              // of the dielectric, at normal incidence
    float f90;              // of the dielectric, along the surface
    Facets facets, sheet;   // `sheet`: of what LAYERED_THIN transmits (sheet_facets)
    IndexRatio ratio;       // of the dielectric from the side of v; from outside where it is thin
    float glass_albedo;     // of rough solid glass (glass_albedo), else 1
    float3 eta, k;          // index of the metal, with LAYERED_CONDUCTOR
    float coat;             // share of the surface that is coated, by a clear varnish of index 1.5
    Facets coat_facets;     // isotropic
    float3 coat_normal;     // unit vectors, on the side of v
    float3 diffuse_normal;  // of the body
    float3 geometric_normal;  // of the triangle: divides reflection and transmission
} LayeredMaterial;

// A material as light reaches `v` from it: what each part reflects or transmits. Those of the
// boundary and below it are what the coat leaves of them.
typedef struct {
    uint flags;
    Facets facets, sheet, coat_facets;
    float3 f0, f90;  // of metal and opaque dielectric; `f0` the colour of a LAYERED_CONDUCTOR
    float3 eta, k;   // of a LAYERED_CONDUCTOR
    float glass;     // share of the boundary that is one of solid glass
    float3 glass_f0, tint;
    float glass_f90;
    IndexRatio ratio;
    float coat;  // factors of the facets' values
    float3 sheet_colour;
    float3 diffuse;  // albedo
    float3 coat_normal, diffuse_normal, geometric_normal;
    float under_coat;    // share of the light from below that the coat leaves
    float glass_albedo;  // LayeredMaterial's
    int alone;           // 1 for is_boundary_alone
    float3 albedo;  // of all together; an estimate where glass is rough. Not of a lone boundary
    float p_coat, p_boundary, p_sheet,
        p_diffuse;  // with which samples choose; 0 where there is none
} LayeredBsdf;

/// A part's probability is that of its light, but not below a twentieth.
static inline float part_probability(float light, float sum) {
    return light > 0.0f ? m_max(light / sum, 0.05f) : 0.0f;
}

/// Sets the probabilities by the luminance of what each part sends towards v.
static inline void choose_parts(LayeredBsdf* bsdf, float coat, float boundary, float sheet,
                                float diffuse) {
    float sum = coat + boundary + sheet + diffuse;
    bsdf->p_coat = part_probability(coat, sum);
    bsdf->p_boundary = part_probability(boundary, sum);
    bsdf->p_sheet = part_probability(sheet, sum);
    bsdf->p_diffuse = part_probability(diffuse, sum);
    float total = bsdf->p_coat + bsdf->p_boundary + bsdf->p_sheet + bsdf->p_diffuse;
    float scale = total > 0.0f ? 1.0f / total : 0.0f;
    bsdf->p_coat *= scale;
    bsdf->p_boundary *= scale;
    bsdf->p_sheet *= scale;
    bsdf->p_diffuse *= scale;
}

/// Share of the light that a coat reflects, by Schlick from the cosine with its own normal.
static inline float coat_reflectance(float share, float cosine) {
    return cosine > 0.0f ? share * (0.04f + 0.96f * schlick_weight(cosine)) : 0.0f;
}

// The dielectric of a material as a mirror of facets with Schlick's reflectance.
typedef struct {
    float3 f0, f90;
    float3 albedo;
} DielectricMirror;

/// A sheet of glass reflects as Fresnel's equations have it where it is smooth. At a rough one the
/// same factor on Schlick's reflectance keeps the sum of what it reflects and transmits.
static inline float sheet_factor1(float exact, float schlick, float albedo, float share) {
    float factor = schlick > 0.0f ? 1.0f + share * (exact / schlick - 1.0f) : 1.0f;
    return albedo * factor <= 1.0f ? factor : 1.0f / albedo;
}

static inline DielectricMirror dielectric_mirror(const LayeredMaterial* material, float cosine,
                                                 FacetAlbedo albedo, FacetAlbedo mean) {
    DielectricMirror mirror;
    mirror.f0 = material->f0;
    mirror.f90 = f3(material->f90, material->f90, material->f90);
    mirror.albedo = schlick_albedo(albedo, mirror.f0, mirror.f90);
    if ((material->flags & LAYERED_EXACT_FRESNEL) != 0u) {
        // A pane reflects by the cosine of the viewer: it is smooth.
        mirror.f0 = material->f0 * pane_of_glass(material->ratio, cosine).reflected;
        mirror.f90 = mirror.f0;
        mirror.albedo = mirror.f0;
        return mirror;
    }
    float3 factor = f3(1.0f, 1.0f, 1.0f);
    if ((material->flags & LAYERED_SINGLE_SCATTER) == 0u)
        factor = compensation(mirror.f0, mirror.f90, albedo, mean);
    if ((material->flags & LAYERED_THIN) != 0u && material->transmission > 0.0f) {
        float3 schlick = schlick_fresnel(mirror.f0, mirror.f90, cosine);
        float3 exact =
            coloured_fresnel(material->ratio, mirror.f0, material->f90, cosine).reflected;
        float share = material->transmission;
        float3 light = mirror.albedo * factor;
        factor = factor * f3(sheet_factor1(exact.x, schlick.x, light.x, share),
                             sheet_factor1(exact.y, schlick.y, light.y, share),
                             sheet_factor1(exact.z, schlick.z, light.z, share));
    }
    mirror.f0 = mirror.f0 * factor;
    mirror.f90 = mirror.f90 * factor;
    mirror.albedo = mirror.albedo * factor;
    return mirror;
}

/// What the boundary does with light at a facet that has the cosine `c` with v.
static inline ColouredFresnel boundary_fresnel(const LayeredBsdf* bsdf, float c) {
    ColouredFresnel f;
    f.transmitted = f3(0.0f, 0.0f, 0.0f);
    f.g = 0.0f;
    if ((bsdf->flags & LAYERED_CONDUCTOR) != 0u) {
        f.reflected = conductor_fresnel(bsdf->eta, bsdf->k, c) * bsdf->f0;
        return f;
    }
    f.reflected = schlick_fresnel(bsdf->f0, bsdf->f90, c);
    if (!(bsdf->glass > 0.0f)) return f;
    if ((bsdf->flags & LAYERED_EXACT_FRESNEL) != 0u) {
        DielectricFresnel exact = dielectric_fresnel(bsdf->ratio, c);
        f.reflected += bsdf->glass_f0 * (exact.reflected * bsdf->glass);
        f.transmitted = bsdf->tint * (exact.transmitted * bsdf->glass);
        f.g = exact.g;
        return f;
    }
    ColouredFresnel glass = coloured_fresnel(bsdf->ratio, bsdf->glass_f0, bsdf->glass_f90, c);
    f.reflected += glass.reflected * bsdf->glass;
    f.transmitted = glass.transmitted * bsdf->tint * bsdf->glass;
    f.g = glass.g;
    return f;
}

/// Probability with which samples are reflected at a facet of the boundary rather than refracted.
static inline float reflection_share(ColouredFresnel f) {
    float reflected = luminance(f.reflected);
    float transmitted = luminance(f.transmitted);
    return transmitted > 0.0f ? reflected / (reflected + transmitted) : 1.0f;
}

/// Whether a material is nothing but its boundary, by Fresnel's equations and without the light
/// that facets reflect twice: Mitsuba's metals and solid glass.
static inline bool is_boundary_alone(const LayeredMaterial* material) {
    if ((material->flags & LAYERED_SINGLE_SCATTER) == 0u || material->coat > 0.0f) return false;
    if ((material->flags & LAYERED_CONDUCTOR) != 0u) return true;
    return (material->flags & (LAYERED_EXACT_FRESNEL | LAYERED_THIN)) == LAYERED_EXACT_FRESNEL &&
           material->metallic == 0.0f && material->transmission >= 1.0f &&
           bends_light(material->ratio);
}

/// make_layered of such a material, which shares its light with nothing, and so needs no albedo.
static inline void make_boundary_alone(const LayeredMaterial* material, LayeredBsdf* bsdf) {
    bool metal = (material->flags & LAYERED_CONDUCTOR) != 0u;
    float3 black = f3(0.0f, 0.0f, 0.0f);
    bsdf->alone = 1;
    bsdf->f0 = metal ? material->base : black;
    bsdf->f90 = black;
    bsdf->glass = metal ? 0.0f : 1.0f / material->glass_albedo;
    bsdf->coat = 0.0f;
    bsdf->under_coat = 1.0f;
    bsdf->sheet_colour = black;
    bsdf->diffuse = black;
    bsdf->albedo = black;
    bsdf->p_coat = 0.0f;
    bsdf->p_boundary = 1.0f;
    bsdf->p_sheet = 0.0f;
    bsdf->p_diffuse = 0.0f;
}

/// Share of the light that all parts together send towards v; an estimate where glass is rough.
static inline float3 layered_albedo(const LayeredBsdf* bsdf, float3 v) {
    if (bsdf->alone == 0) return bsdf->albedo;
    ColouredFresnel f = boundary_fresnel(bsdf, m_clamp(v.z, 0.0f, 1.0f));
    return (f.reflected + f.transmitted) * bsdf->glass_albedo;
}

/// The material as it sends light towards v; v.z > 0.
static inline LayeredBsdf make_layered(const LayeredMaterial* material, float3 v) {
    LayeredBsdf bsdf;
    bsdf.flags = material->flags;
    bsdf.facets = material->facets;
    bsdf.sheet = material->sheet;
    bsdf.coat_facets = material->coat_facets;
    bsdf.eta = material->eta;
    bsdf.k = material->k;
    bsdf.ratio = material->ratio;
    bsdf.glass_f0 = material->f0;
    bsdf.glass_f90 = material->f90;
    bsdf.tint = material->base;
    bsdf.coat_normal = material->coat_normal;
    bsdf.diffuse_normal = material->diffuse_normal;
    bsdf.geometric_normal = material->geometric_normal;
    bsdf.glass_albedo = material->glass_albedo;
    if (is_boundary_alone(material)) {
        make_boundary_alone(material, &bsdf);
        return bsdf;
    }
    bsdf.alone = 0;

    float cosine = m_clamp(v.z, 0.0f, 1.0f);
    bool thin = (material->flags & LAYERED_THIN) != 0u;
    float body = 1.0f - material->metallic;
    float clear = body * material->transmission;
    float solid = thin ? 0.0f : clear;
    FacetAlbedo albedo = facet_albedo(material->facets, cosine);
    FacetAlbedo mean = mean_facet_albedo(material->facets);
    float3 one = f3(1.0f, 1.0f, 1.0f);
    float coat_cosine = dot3(v, material->coat_normal);
    float coat = coat_reflectance(material->coat, coat_cosine);
    bsdf.coat = coat / facet_albedo(material->coat_facets, coat_cosine).all;
    bsdf.under_coat = 1.0f - coat;

    // Metal and dielectric share their facets and so are one lobe. Each is compensated for itself:
    // a factor of their mixture would lose light, 23 % of a half metallic white at roughness 1.
    DielectricMirror mirror = dielectric_mirror(material, cosine, albedo, mean);
    float3 metal = one * material->metallic;
    if ((material->flags & LAYERED_SINGLE_SCATTER) == 0u)
        metal = compensation(material->base, one, albedo, mean) * material->metallic;
    float opaque = (body - solid) * bsdf.under_coat;
    bsdf.f0 = metal * material->base * bsdf.under_coat + mirror.f0 * opaque;
    bsdf.f90 = metal * bsdf.under_coat + mirror.f90 * opaque;
    if ((material->flags & LAYERED_CONDUCTOR) != 0u) bsdf.f0 = material->base * bsdf.under_coat;
    float3 boundary = schlick_albedo(albedo, bsdf.f0, bsdf.f90);

    // Solid glass of the index before it lets all light pass straight on, whatever its roughness.
    bool bends = bends_light(material->ratio);
    bsdf.glass = bends ? solid * bsdf.under_coat / material->glass_albedo : 0.0f;
    if (bsdf.glass > 0.0f || (material->flags & LAYERED_CONDUCTOR) != 0u) {
        ColouredFresnel f = boundary_fresnel(&bsdf, cosine);
        boundary = f.reflected + f.transmitted;
        if (bsdf.glass > 0.0f) boundary = boundary * material->glass_albedo;
    }
    bsdf.sheet_colour = f3(0.0f, 0.0f, 0.0f);
    float sheet_albedo = 1.0f;
    if (thin) {
        sheet_albedo = facet_albedo(material->sheet, cosine).all;
        float3 passes = one - mirror.albedo;
        if ((material->flags & LAYERED_EXACT_FRESNEL) != 0u)
            passes = one * pane_of_glass(material->ratio, cosine).transmitted;
        bsdf.sheet_colour = material->base * passes * (clear / sheet_albedo);
    } else if (bends == false) {
        bsdf.sheet = make_facets(0.0f, 0.0f, 0u);
        bsdf.sheet_colour = material->base * solid;
    }
    bsdf.sheet_colour = highest3(bsdf.sheet_colour * bsdf.under_coat, f3(0.0f, 0.0f, 0.0f));

    // One factor for all channels: a coloured mirror does not give the body its complement.
    float left = m_max(1.0f - max_component(mirror.albedo), 0.0f);
    bsdf.diffuse = material->base * ((body - clear) * left * bsdf.under_coat);

    float3 sheet = bsdf.sheet_colour * sheet_albedo;
    bsdf.albedo = one * coat + boundary + sheet + bsdf.diffuse;
    choose_parts(&bsdf, coat, luminance(boundary), luminance(sheet), luminance(bsdf.diffuse));
    return bsdf;
}

/// Albedo of the diffuse surface that stands for the body where no outgoing direction is known: its
/// mean over all of them.
static inline float3 layered_diffuse_albedo(const LayeredMaterial* material) {
    FacetAlbedo mean = mean_facet_albedo(material->facets);
    float3 f90 = f3(material->f90, material->f90, material->f90);
    float3 mirror = schlick_albedo(mean, material->f0, f90);
    if ((material->flags & LAYERED_SINGLE_SCATTER) == 0u)
        mirror = mirror * compensation(material->f0, f90, mean, mean);
    float left = m_max(1.0f - max_component(mirror), 0.0f);
    float coat = material->coat * (0.04f + 0.96f / 21.0f);
    return material->base *
           ((1.0f - material->metallic) * (1.0f - material->transmission) * left * (1.0f - coat));
}

#endif
