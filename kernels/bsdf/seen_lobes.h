// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What previews make of a material that is seen from a direction: what smooth facets mirror, what
// glossy ones do, what is seen through it, each in one direction, and a diffuse surface for all the
// rest. The direction of glossy facets and of rough glass is that of one facet, which is chosen.
// Rough facets count as diffuse light of the same albedo where a surface is seen in a mirror, and
// where they reflect little (way_of_facets).
#ifndef WEFT_KERNELS_BSDF_SEEN_LOBES_H
#define WEFT_KERNELS_BSDF_SEEN_LOBES_H

#include "kernels/bsdf/scattering.h"

// Alpha up to which facets are seen as a mirror, about the angle of a pixel, and from which on they
// count as diffuse where a surface is seen in a mirror.
#define MIRROR_ALPHA 0.001f
#define GLOSSY_ALPHA 0.25f
// FacetChoice::widest of what the camera sees itself: no facets are as rough.
#define ANY_ALPHA 1e6f
// Alpha from which on facets count as diffuse wherever they are if they reflect no more than that
// at normal incidence: the mirror of a rough dielectric is all but even.
#define EVEN_ALPHA 0.5f
#define EVEN_REFLECTANCE 0.08f

// The ways on which light comes; SeenLobes::ways.
#define WAY_REFLECTION 0
#define WAY_GLOSSY 1
#define WAY_REFRACTION 2
#define WAY_COUNT 3

// Numbers in [0, 1): `part` chooses between a coat and what lies below it, `u` and `v` choose the
// facet that is seen. Facets that reflect count as diffuse from alpha `widest` on, across their
// narrow axis.
typedef struct {
    float part, u, v;
    float widest;  // GLOSSY_ALPHA or ANY_ALPHA
} FacetChoice;

// Light from one direction.
typedef struct {
    float3 share;      // of the light from there
    float3 direction;  // a unit vector
    float alpha;       // of the facets where they are chosen, across their narrow axis; else 0
    int missed;        // 1 where the chosen facet reflects downwards, and the mean one is taken
} SeenWay;

typedef struct {
    float3 diffuse;  // albedo
    SeenWay ways[WAY_COUNT];
    int refracts;  // 1 where what is transmitted enters or leaves a solid
    // Luminance of what the facets of a coat, and of the boundary below it, send on WAY_GLOSSY.
    float glossy_coat, glossy_boundary;
} SeenLobes;

static inline SeenLobes no_lobes(void) {
    SeenLobes lobes;
    float3 none = f3(0.0f, 0.0f, 0.0f);
    lobes.diffuse = none;
    for (int i = 0; i < WAY_COUNT; ++i) {
        lobes.ways[i].share = none;
        lobes.ways[i].direction = none;
        lobes.ways[i].alpha = 0.0f;
        lobes.ways[i].missed = 0;
    }
    lobes.refracts = 0;
    lobes.glossy_coat = 0.0f;
    lobes.glossy_boundary = 0.0f;
    return lobes;
}

static inline float alpha_of_facets(Facets facets) {
    return m_max(facets.alpha_x, facets.alpha_y);
}

static inline float narrow_alpha(Facets facets) {
    return m_min(facets.alpha_x, facets.alpha_y);
}

/// The way of what facets reflect, which is `reflectance` at normal incidence: WAY_REFLECTION,
/// WAY_GLOSSY, or WAY_COUNT where they count as diffuse.
static inline int way_of_facets(Facets facets, float reflectance, FacetChoice choice) {
    float alpha = alpha_of_facets(facets);
    if (alpha <= MIRROR_ALPHA) return WAY_REFLECTION;
    float narrow = narrow_alpha(facets);
    int even = narrow >= EVEN_ALPHA && reflectance <= EVEN_REFLECTANCE ? 1 : 0;
    return narrow < choice.widest && even == 0 ? WAY_GLOSSY : WAY_COUNT;
}

// A facet that is seen.
typedef struct {
    float3 normal;
    int missed;  // SeenWay's
} SeenFacet;

/// The facet that is seen, where it is chosen at all.
static inline SeenFacet chosen_facet(Facets facets, float3 v, FacetChoice choice) {
    SeenFacet seen;
    seen.normal = f3(0.0f, 0.0f, 1.0f);
    seen.missed = 0;
    if (alpha_of_facets(facets) <= MIRROR_ALPHA) return seen;
    float3 facet = sample_facet(facets, v, reflecting_cap(facets, v), choice.u, choice.v);
    // What it reflects stays above the surface, and the viewer sees it.
    float c = dot3(facet, v);
    if (c > 0.0f && reflected_direction(v, facet, c).z > 0.0f)
        seen.normal = facet;
    else
        seen.missed = 1;
    return seen;
}

static inline float3 reflected_by(SeenFacet facet, float3 v) {
    return reflected_direction(v, facet.normal, dot3(v, facet.normal));
}

/// Adds light from a direction in the frame of the material to a way. All of its light comes from
/// one direction: `part` chooses which, by luminance.
static inline void add_to_way(float3 share, float3 direction, int missed, Facets facets, float part,
                              SeenWay* way) {
    float brightness = luminance(share);
    if (!(brightness > 0.0f)) return;
    way->share += share;
    if (alpha_of_facets(facets) > MIRROR_ALPHA)
        way->alpha = m_max(way->alpha, m_max(narrow_alpha(facets), MIRROR_ALPHA));
    if (!(part * luminance(way->share) < brightness)) return;
    way->direction = direction;
    way->missed = missed;
}

/// What a coat reflects.
static inline void add_coat(const LayeredBsdf* bsdf, float3 v, FacetChoice choice,
                            SeenLobes* lobes) {
    float coat = 1.0f - bsdf->under_coat;
    if (!(coat > 0.0f)) return;
    float3 share = f3(coat, coat, coat);
    int way = way_of_facets(bsdf->coat_facets, 0.04f, choice);
    float3 coat_v = local_direction(v, bsdf->coat_normal);
    if (way == WAY_COUNT || !(coat_v.z > 0.0f)) {
        lobes->diffuse += share;
        return;
    }
    SeenFacet facet = chosen_facet(bsdf->coat_facets, coat_v, choice);
    add_to_way(share, to_world(reflected_by(facet, coat_v), bsdf->coat_normal), facet.missed,
               bsdf->coat_facets, choice.part, &lobes->ways[way]);
    if (way == WAY_GLOSSY) lobes->glossy_coat = luminance(share);
}

/// The refracted direction by the facet with the normal `m`, or where that reflects all light, by
/// the mean one.
static inline float3 refracted_by_facet(const LayeredBsdf* bsdf, float3 v, float3 m,
                                        ColouredFresnel mean) {
    float c = m_clamp(dot3(v, m), 0.0f, 1.0f);
    ColouredFresnel f = boundary_fresnel(bsdf, c);
    if (!(max_component(f.transmitted) > 0.0f))
        return refracted_direction(bsdf->ratio, v, f3(0.0f, 0.0f, 1.0f), v.z, mean.g);
    return refracted_direction(bsdf->ratio, v, m, c, f.g);
}

/// Of a layered material; directions in its frame. The share of light of each part is its albedo
/// for the viewer, whichever facet is chosen.
static inline void find_layered_lobes(const LayeredBsdf* bsdf, float3 v, FacetChoice choice,
                                      SeenLobes* lobes) {
    float cosine = m_clamp(v.z, 0.0f, 1.0f);
    lobes->diffuse = bsdf->diffuse;
    add_coat(bsdf, v, choice, lobes);
    SeenWay* through = &lobes->ways[WAY_REFRACTION];
    float3 sheet = bsdf->sheet_colour;
    if (max_component(sheet) > 0.0f) {
        SeenFacet facet = chosen_facet(bsdf->sheet, v, choice);
        sheet = sheet * facet_albedo(bsdf->sheet, cosine).all;
        add_to_way(sheet, across_sheet(reflected_by(facet, v)), facet.missed, bsdf->sheet, 0.0f,
                   through);
    }
    if (!(bsdf->p_boundary > 0.0f)) return;
    SeenFacet facet = chosen_facet(bsdf->facets, v, choice);
    ColouredFresnel f = boundary_fresnel(bsdf, cosine);
    float3 transmitted = f.transmitted * bsdf->glass_albedo;
    if (max_component(transmitted) > 0.0f) {
        // A material has either a sheet of glass or a solid's boundary.
        add_to_way(transmitted, refracted_by_facet(bsdf, v, facet.normal, f), facet.missed,
                   bsdf->facets, 0.0f, through);
        lobes->refracts = 1;
    }
    float3 reflected = f.reflected;
    if (!facets_are_smooth(bsdf->facets)) {
        float3 others = bsdf->diffuse + sheet + transmitted;
        float coat = 1.0f - bsdf->under_coat;
        reflected =
            highest3(layered_albedo(bsdf, v) - others - f3(coat, coat, coat), f3(0.0f, 0.0f, 0.0f));
        // Facets that hide each other lose light only where nothing makes up for it.
        if (bsdf->alone != 0 && (bsdf->flags & LAYERED_CONDUCTOR) != 0u)
            reflected = reflected * facet_albedo(bsdf->facets, cosine).all;
    }
    int way = way_of_facets(bsdf->facets, max_component(bsdf->f0), choice);
    if (way == WAY_COUNT) {
        lobes->diffuse += reflected;
        return;
    }
    add_to_way(reflected, reflected_by(facet, v), facet.missed, bsdf->facets, choice.part,
               &lobes->ways[way]);
    if (way == WAY_GLOSSY) lobes->glossy_boundary = luminance(reflected);
}

/// Of Mitsuba's plastics.
static inline void find_plastic_lobes(const Plastic* plastic, float3 v, FacetChoice choice,
                                      SeenLobes* lobes) {
    float entering = plastic_transmittance(plastic, v.z);
    // Of what leaves the body, the mean over all directions: by reciprocity the share that does not
    // enter from inside, times the ratio of the solid angles.
    float eta = plastic->ratio.eta;
    float leaving = (1.0f - inner_reflectance(eta)) * (eta * eta);
    lobes->diffuse = plastic->body * (entering * leaving);
    float3 mirror = plastic->specular * (1.0f - entering);
    float eta_step = (eta - 1.0f) / (eta + 1.0f);
    int way = way_of_facets(plastic->facets,
                            max_component(plastic->specular) * (eta_step * eta_step), choice);
    if (way == WAY_COUNT) {
        lobes->diffuse += mirror;
        return;
    }
    SeenFacet facet = chosen_facet(plastic->facets, v, choice);
    add_to_way(mirror, reflected_by(facet, v), facet.missed, plastic->facets, 0.0f,
               &lobes->ways[way]);
    if (way == WAY_GLOSSY) lobes->glossy_boundary = luminance(mirror);
}

/// Turns the ways into the world. Where normal maps or interpolated normals send smooth ones to the
/// wrong side they are left out, and those of facets stay on the side of most.
static inline void place_ways(const SurfaceScattering* scattering, SeenLobes* lobes) {
    for (int i = 0; i < WAY_COUNT; ++i) {
        SeenWay* way = &lobes->ways[i];
        way->direction = out_of_frame(&scattering->frame, way->direction);
        way->share = way->share * scattering->coverage;
        float side = dot3(way->direction, scattering->outward);
        bool fits = i == WAY_REFRACTION ? side < 0.0f : side > 0.0f;
        if (fits) continue;
        if (way->alpha > 0.0f) {
            way->direction = way->direction - scattering->outward * (2.0f * side);
            way->missed = 1;
        } else {
            way->share = f3(0.0f, 0.0f, 0.0f);
        }
    }
}

/// What a preview makes of the material for its viewer; directions in the world. Gaps let light
/// through as they are.
static inline SeenLobes seen_lobes(const SurfaceScattering* scattering, float3 viewer,
                                   FacetChoice choice) {
    SeenLobes lobes = no_lobes();
    if (scattering->model == SURFACE_LAMBERT) {
        lobes.diffuse = scattering->albedo;
    } else if (scattering->model == SURFACE_PLASTIC) {
        if (scattering->v.z > 0.0f)
            find_plastic_lobes(&scattering->plastic, scattering->v, choice, &lobes);
    } else if (scattering->model == SURFACE_LAYERED && scattering->v.z > 0.0f) {
        find_layered_lobes(&scattering->layered, scattering->v, choice, &lobes);
    }
    lobes.diffuse = lobes.diffuse * scattering->coverage;
    place_ways(scattering, &lobes);
    if (!(max_component(scattering->straight) > 0.0f)) return lobes;
    SeenWay* through = &lobes.ways[WAY_REFRACTION];
    if (!(luminance(through->share) > luminance(scattering->straight))) {
        through->direction = -viewer;
        lobes.refracts = 0;
    }
    through->share += scattering->straight;
    return lobes;
}

#endif
