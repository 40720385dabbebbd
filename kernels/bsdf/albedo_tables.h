// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The light that one reflection at GGX facets sends on, and what the light that it leaves between
// them adds (Kulla and Conty 2017). Albedos come from tables that lie nowhere below the truth:
// what is divided by them, or gets what they leave, errs to loss.
#ifndef WEFT_KERNELS_BSDF_ALBEDO_TABLES_H
#define WEFT_KERNELS_BSDF_ALBEDO_TABLES_H

#include "kernels/bsdf/albedo_values.h"
#include "kernels/bsdf/fresnel.h"
#include "kernels/bsdf/microfacet.h"

// A place between the nodes of a table.
typedef struct {
    uint first;  // of the cell's nodes; the others are 1, a row, and a row and 1 further
    float along, up;
} TablePlace;

/// Row of a table for alpha, in steps: even in x, where the roughness is (x + x^2) / 2.
static inline float table_row(float alpha, uint nodes) {
    float roughness = square_root(m_min(alpha, 1.0f));
    return 0.5f * (square_root(1.0f + 8.0f * roughness) - 1.0f) * (float)(nodes - 1u);
}

/// Where a table of nodes x nodes has the albedo of alpha for a direction with that cosine.
static inline TablePlace table_place(float alpha, float cosine, uint nodes) {
    float column = square_root(m_clamp(cosine, 0.0f, 1.0f)) * (float)(nodes - 1u);
    float row = table_row(alpha, nodes);
    uint c = (uint)m_min(column, (float)(nodes - 2u));
    uint r = (uint)m_min(row, (float)(nodes - 2u));
    TablePlace place;
    place.first = r * nodes + c;
    place.along = column - (float)c;
    place.up = row - (float)r;
    return place;
}

// Bilinear; `values` is an array in any address space.
#define TABLE_VALUE(values, place, nodes)                          \
    (((values)[(place).first] * (1.0f - (place).along) +           \
      (values)[(place).first + 1u] * (place).along) *              \
         (1.0f - (place).up) +                                     \
     ((values)[(place).first + (nodes)] * (1.0f - (place).along) + \
      (values)[(place).first + (nodes) + 1u] * (place).along) *    \
         (place).up)

// Albedos of facets by what each reflects, for one direction or as a mean over all of them.
typedef struct {
    float all;      // all light
    float schlick;  // Schlick's weight
} FacetAlbedo;

/// How far the alphas of facets are apart: 0 where they are isotropic, below 1.
static inline float anisotropy(Facets facets) {
    float least = m_min(facets.alpha_x, facets.alpha_y);
    float most = m_max(facets.alpha_x, facets.alpha_y);
    return 1.0f - least / most;
}

/// Albedos of facets of two alphas have no table of their own. Those of either alpha alone bound
/// them by these margins: along the surface they rise up to 4 % above the larger one, and 25 % for
/// Schlick's weight.
static inline FacetAlbedo anisotropic_albedo(Facets facets, FacetAlbedo x, FacetAlbedo y) {
    float apart = anisotropy(facets);
    FacetAlbedo albedo;
    albedo.all = m_min(m_max(x.all, y.all) * (1.0f + 0.06f * apart), 1.0f);
    albedo.schlick = m_min(m_max(x.schlick, y.schlick) * (1.0f + 0.55f * apart), albedo.all);
    return albedo;
}

static inline FacetAlbedo isotropic_albedo(float alpha, float cosine) {
    TablePlace place = table_place(alpha, cosine, ALBEDO_NODES);
    FacetAlbedo albedo;
    albedo.all = TABLE_VALUE(facet_albedos, place, ALBEDO_NODES);
    albedo.schlick = TABLE_VALUE(schlick_albedos, place, ALBEDO_NODES);
    return albedo;
}

/// Albedos for the direction with that cosine: from above, within 2e-3 where the facets are
/// isotropic.
static inline FacetAlbedo facet_albedo(Facets facets, float cosine) {
    FacetAlbedo smooth;
    smooth.all = 1.0f;
    smooth.schlick = schlick_weight(cosine);
    if (facets_are_smooth(facets)) return smooth;
    FacetAlbedo albedo = isotropic_albedo(facets.alpha_x, cosine);
    if (facets.alpha_x == facets.alpha_y) return albedo;
    return anisotropic_albedo(facets, albedo, isotropic_albedo(facets.alpha_y, cosine));
}

static inline FacetAlbedo mean_isotropic_albedo(float alpha) {
    float row = table_row(alpha, ALBEDO_NODES);
    uint r = (uint)m_min(row, (float)(ALBEDO_NODES - 2u));
    float up = row - (float)r;
    FacetAlbedo albedo;
    albedo.all = mean_facet_albedos[r] * (1.0f - up) + mean_facet_albedos[r + 1u] * up;
    albedo.schlick = mean_schlick_albedos[r] * (1.0f - up) + mean_schlick_albedos[r + 1u] * up;
    return albedo;
}

/// The mean over all directions, weighted by their cosines.
static inline FacetAlbedo mean_facet_albedo(Facets facets) {
    FacetAlbedo albedo = mean_isotropic_albedo(facets.alpha_x);
    if (facets.alpha_x == facets.alpha_y) return albedo;
    return anisotropic_albedo(facets, albedo, mean_isotropic_albedo(facets.alpha_y));
}

/// Albedo of facets with Schlick's reflectance from f0 to f90, for light reflected once.
static inline float3 schlick_albedo(FacetAlbedo albedo, float3 f0, float3 f90) {
    return f0 * m_max(albedo.all - albedo.schlick, 0.0f) + f90 * albedo.schlick;
}

static inline float compensation1(float f0, float f90, float all, float mean) {
    // The mean of Schlick's reflectance over all directions.
    float reflected = f0 + (f90 - f0) * (1.0f / 21.0f);
    // What all later reflections send on of the light that the first leaves between facets, a
    // geometric series. Both are 1 for facets that absorb nothing.
    float rest = m_max(1.0f - reflected * (1.0f - mean), 1e-6f);
    return 1.0f + reflected * mean / rest * (1.0f - all) / all;
}

/// Factor for a lobe of facets with Schlick's reflectance, which adds the light of later
/// reflections in the shape of the first. `albedo` is for the viewer's direction, `mean` that over
/// all: a lobe that absorbs nothing then has the albedo 1.
static inline float3 compensation(float3 f0, float3 f90, FacetAlbedo albedo, FacetAlbedo mean) {
    return f3(compensation1(f0.x, f90.x, albedo.all, mean.all),
              compensation1(f0.y, f90.y, albedo.all, mean.all),
              compensation1(f0.z, f90.z, albedo.all, mean.all));
}

// Nodes of a table of what rough glass reflects and transmits in one step, along each axis. The
// host makes one for each ratio of indices (host/scene/surface/facet_albedo.h).
#define GLASS_ALBEDO_NODES 24

/// The value of such a table for a direction; 1 for smooth glass.
static inline float glass_albedo(GLOBAL const float* table, Facets facets, float cosine) {
    if (facets_are_smooth(facets)) return 1.0f;
    TablePlace x = table_place(facets.alpha_x, cosine, GLASS_ALBEDO_NODES);
    float albedo = TABLE_VALUE(table, x, GLASS_ALBEDO_NODES);
    if (facets.alpha_x == facets.alpha_y) return albedo;
    TablePlace y = table_place(facets.alpha_y, cosine, GLASS_ALBEDO_NODES);
    albedo = m_max(albedo, TABLE_VALUE(table, y, GLASS_ALBEDO_NODES));
    return m_min(albedo * (1.0f + 0.06f * anisotropy(facets)), 1.0f);
}

#endif
