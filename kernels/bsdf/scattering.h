// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// How a point of a surface scatters light towards a viewer, by its material's record and textures.
#ifndef WEFT_KERNELS_BSDF_SCATTERING_H
#define WEFT_KERNELS_BSDF_SCATTERING_H

#include "kernels/bsdf/layered_sample.h"
#include "kernels/bsdf/plastic.h"
#include "kernels/bsdf/surface_frame.h"

// Directions into which a material scatters light, as masks.
#define SCATTERS_ABOVE 1u  // over directions on the viewer's side
#define SCATTERS_BELOW 2u  // over directions on the other side

// A material, ready for a viewer.
typedef struct {
    uint model;          // SURFACE_*
    uint sides;          // SCATTERS_*; 0 where all is smooth
    SurfaceFrame frame;  // of the facets
    float3 v;            // direction of the viewer in that frame
    float3 albedo;       // diffuse colour and what facets reflect; see scattering_albedo
    float coverage;      // share of the light that meets the surface at all
    float3 straight;     // and of what passes straight on: gaps, and clear glass without thickness
    float3 smooth;       // unit vectors on the side of the viewer: normal without a map,
    float3 outward;      // and that of the triangle
    float shadowing;     // shadowing_roughness of a tilted normal, or 0
    LayeredBsdf layered;
    Plastic plastic;
} SurfaceScattering;

/// Alpha for a roughness on a scale, ROUGHNESS_*.
static inline float alpha_of_roughness(float roughness, uint scale) {
    float x = m_clamp(roughness, 0.0f, 1.0f);
    switch (scale) {
        case ROUGHNESS_GLOSS:
            return (1.0f - x) * (1.0f - x);
        case ROUGHNESS_ALPHA:
            return m_max(roughness, 0.0f);
        case ROUGHNESS_EXPONENT:
            return square_root(2.0f / (m_max(roughness, 0.0f) + 2.0f));
        case ROUGHNESS_SQUARED:
        default:
            return x * x;
    }
}

/// What a material's parameters are evaluated with.
typedef struct {
    const Geometry* geometry;
    const SurfaceTables* tables;
    GLOBAL const SurfaceRecord* record;
    SurfacePoint at;
} SurfaceLookup;

static inline SurfaceLookup lookup_at(const Geometry* geometry, const SurfaceTables* tables,
                                      GLOBAL const SurfaceRecord* record, Hit hit,
                                      float footprint) {
    SurfaceLookup look;
    look.geometry = geometry;
    look.tables = tables;
    look.record = record;
    look.at.triangle = geometry->triangles[hit.triangle];
    look.at.u = hit.u;
    look.at.v = hit.v;
    look.at.footprint = footprint;
    return look;
}

static inline float number_at(const SurfaceLookup* look, uint parameter, float factor) {
    return mapped_number(look->geometry, look->tables, look->record, parameter, &look->at, factor);
}

static inline float3 colour_at(const SurfaceLookup* look, uint parameter, float3 factor) {
    return mapped_colour(look->geometry, look->tables, look->record, parameter, &look->at, factor);
}

/// Direction of the greater roughness, in the world, and alpha along it and across.
static inline float3 find_roughness(const SurfaceLookup* look, const Surface* surface, float* along,
                                    float* across) {
    GLOBAL const SurfaceRecord* record = look->record;
    *across = alpha_of_roughness(number_at(look, MAP_ROUGHNESS, record->roughness_u),
                                 record->roughness_scale);
    *along = *across;
    float3 none = f3(0.0f, 0.0f, 0.0f);
    int by_both = record->roughness_v >= 0.0f ? 1 : 0;
    if (by_both == 0 && !(record->anisotropy > 0.0f)) return none;
    float3 outside = surface->front != 0 ? surface->shading : -surface->shading;
    float3 tangent, bitangent;
    tangents_at(look->tables, &look->at, outside, &tangent, &bitangent);
    if (by_both != 0) {
        *across = alpha_of_roughness(number_at(look, MAP_ROUGHNESS_V, record->roughness_v),
                                     record->roughness_scale);
        return tangent;
    }
    // KHR_materials_anisotropy: alpha along the direction is mix(alpha, 1, strength^2).
    float strength = record->anisotropy;
    float x = 1.0f;
    float y = 0.0f;
    if ((record->maps & MAP_ANISOTROPY) != 0u) {
        float3 colour = map_colour(look->geometry, look->tables, record, MAP_ANISOTROPY, &look->at);
        x = 2.0f * colour.x - 1.0f;
        y = 2.0f * colour.y - 1.0f;
        strength *= colour.z;
    }
    *along = *across + (1.0f - *across) * strength * strength;
    float sine, cosine;
    m_sincos(record->rotation, &sine, &cosine);
    return tangent * (x * cosine - y * sine) + bitangent * (x * sine + y * cosine);
}

static inline IndexRatio inverse_ratio(IndexRatio ratio, float step) {
    IndexRatio inverse;
    inverse.eta = 1.0f / ratio.eta;
    inverse.step = step;
    return inverse;
}

/// Reflectance at normal incidence of a dielectric at `ratio`. The record has it for its own ratio,
/// with the material's colour; where other glass is around it is as much less or more as by
/// Fresnel's equations.
static inline float3 reflectance_at_ratio(GLOBAL const SurfaceRecord* record, IndexRatio ratio,
                                          float3 f0) {
    if (ratio.eta == record->eta.x || ratio.eta == 1.0f / record->eta.x) return f0;
    IndexRatio own;
    own.eta = record->eta.x;
    own.step = record->k.x;
    float of_own = normal_reflectance(own);
    float here = normal_reflectance(ratio);
    return of_own > 0.0f ? f0 * (here / of_own) : f3(here, here, here);
}

/// The layered material of a record, in the frame of its facets. `ratio` is that of the indices
/// beyond the surface and on the viewer's side.
static inline LayeredMaterial layered_at(const SurfaceLookup* look, const Surface* surface,
                                         float3 vertex_colour, float3 coat_normal,
                                         const SurfaceFrame* frame, float3 v, Facets facets,
                                         IndexRatio ratio) {
    GLOBAL const SurfaceRecord* record = look->record;
    LayeredMaterial material;
    material.flags = record->flags & (SURFACE_THIN | SURFACE_CONDUCTOR | SURFACE_SINGLE_SCATTER |
                                      SURFACE_EXACT_FRESNEL);
    material.base = colour_at(look, MAP_BASE, xyz(record->base)) * vertex_colour;
    material.metallic = number_at(look, MAP_METALLIC, record->base.w);
    material.transmission = number_at(look, MAP_TRANSMISSION, record->transmission);
    float strength = number_at(look, MAP_SPECULAR, record->specular.w);
    float3 f0 = reflectance_at_ratio(record, ratio,
                                     colour_at(look, MAP_SPECULAR_COLOUR, xyz(record->specular)));
    material.f0 = f3(m_min(f0.x, 1.0f), m_min(f0.y, 1.0f), m_min(f0.z, 1.0f)) * strength;
    material.f90 = strength;
    if ((record->flags & SURFACE_SPECULAR_SCALES) != 0u)
        material.base = material.base * (1.0f - max_component(material.f0));
    if ((record->flags & SURFACE_ROOT_TINT) != 0u && material.transmission > 0.0f)
        material.base = f3(square_root(material.base.x), square_root(material.base.y),
                           square_root(material.base.z));
    material.facets = facets;
    material.ratio = ratio;
    material.sheet = sheet_facets(facets, ratio.eta);
    material.glass_albedo = 1.0f;
    if (record->table != INVALID_INDEX && material.transmission > 0.0f)
        material.glass_albedo =
            glass_albedo(look->tables->tables + record->table +
                             (surface->front != 0 ? 0u : GLASS_ALBEDO_NODES * GLASS_ALBEDO_NODES),
                         facets, v.z);
    material.eta = xyz(record->eta);
    material.k = xyz(record->k);
    material.coat = number_at(look, MAP_COAT, record->coat);
    float coat_alpha =
        alpha_of_roughness(number_at(look, MAP_COAT_ROUGHNESS, record->coat_roughness), 0u);
    material.coat_facets = make_facets(coat_alpha, coat_alpha, 0u);
    material.coat_normal = into_frame(frame, coat_normal);
    material.diffuse_normal = into_frame(frame, surface->shading);
    material.geometric_normal = into_frame(frame, surface->normal);
    return material;
}

static inline uint sides_of_layers(const LayeredBsdf* bsdf) {
    uint sides = bsdf->p_diffuse > 0.0f ? SCATTERS_ABOVE : 0u;
    if (bsdf->p_coat > 0.0f && !facets_are_smooth(bsdf->coat_facets)) sides |= SCATTERS_ABOVE;
    if (bsdf->p_boundary > 0.0f && !facets_are_smooth(bsdf->facets))
        sides |= bsdf->glass > 0.0f ? SCATTERS_ABOVE | SCATTERS_BELOW : SCATTERS_ABOVE;
    if (bsdf->p_sheet > 0.0f && !facets_are_smooth(bsdf->sheet)) sides |= SCATTERS_BELOW;
    return sides;
}

static inline Plastic plastic_at(const SurfaceLookup* look, float3 vertex_colour, Facets facets) {
    GLOBAL const SurfaceRecord* record = look->record;
    Plastic plastic;
    plastic.facets = facets;
    plastic.ratio.eta = record->eta.x;
    plastic.ratio.step = record->k.x;
    plastic.specular = colour_at(look, MAP_SPECULAR_COLOUR, xyz(record->specular));
    float3 diffuse = colour_at(look, MAP_BASE, xyz(record->base)) * vertex_colour;
    plastic.body = plastic_body(diffuse, record->inner, (record->flags & SURFACE_NONLINEAR) != 0u,
                                record->eta.x);
    plastic.weight = record->weight;
    plastic.transmittance =
        look->tables->tables + (record->table != INVALID_INDEX ? record->table : 0u);
    return plastic;
}

/// Leaves out the sheet of glass, which the path takes by itself.
static inline void drop_sheet(LayeredBsdf* bsdf) {
    float rest = bsdf->p_coat + bsdf->p_boundary + bsdf->p_diffuse;
    float scale = rest > 0.0f ? 1.0f / rest : 0.0f;
    bsdf->p_coat *= scale;
    bsdf->p_boundary *= scale;
    bsdf->p_diffuse *= scale;
    bsdf->p_sheet = 0.0f;
    bsdf->albedo = bsdf->albedo - bsdf->sheet_colour;
    bsdf->sheet_colour = f3(0.0f, 0.0f, 0.0f);
}

/// The share of the surface that is there.
static inline float coverage_at(const SurfaceLookup* look) {
    if ((look->record->flags & (SURFACE_MASK | SURFACE_BLEND)) == 0u) return 1.0f;
    float alpha =
        number_at(look, MAP_ALPHA, look->record->alpha) * vertex_alpha(look->tables, &look->at);
    if ((look->record->flags & SURFACE_MASK) != 0u)
        return alpha >= look->record->cutoff ? 1.0f : 0.0f;
    return m_clamp(alpha, 0.0f, 1.0f);
}

/// The record of a surface's material.
static inline GLOBAL const SurfaceRecord* record_of(const Geometry* geometry,
                                                    const SurfaceTables* tables,
                                                    const Surface* surface) {
    return tables->records + geometry->instances[surface->instance].material;
}

/// What a surface does with light towards the viewer, who is along `viewer`. `ratio` is that of the
/// indices beyond a transmitting surface and on the viewer's side.
static inline SurfaceScattering scattering_at(const RenderParams* params, const Geometry* geometry,
                                              const SurfaceTables* tables, const Surface* surface,
                                              Hit hit, float footprint, float3 viewer,
                                              IndexRatio ratio) {
    SurfaceScattering found;
    GLOBAL const SurfaceRecord* record = record_of(geometry, tables, surface);
    SurfaceLookup look = lookup_at(geometry, tables, record, hit, footprint);
    found.model = record->model;
    found.coverage = HAS(params, FEATURE_SEE_THROUGH) ? coverage_at(&look) : 1.0f;
    float gaps = 1.0f - found.coverage;
    found.straight = f3(gaps, gaps, gaps);
    found.smooth = surface->shading;
    found.outward = surface->normal;
    found.shadowing = 0.0f;
    Surface at = *surface;
    float3 coat_normal = surface->shading;
    // Mitsuba flips normals, or leaves them black, where others are bent.
    bool bends = (record->flags & SURFACE_MITSUBA_NORMALS) == 0u;
    if ((record->maps & MAP_NORMAL) != 0u)
        at.shading = bends ? mapped_normal(geometry, tables, record, MAP_NORMAL, &look.at,
                                           record->normal_scale, surface->shading, surface->front)
                           : mitsuba_normal(geometry, tables, record, &look.at, surface->shading,
                                            surface->front, viewer);
    if ((record->flags & SURFACE_NORMAL_SHADOWING) != 0u)
        found.shadowing = shadowing_roughness(dot3(at.shading, surface->shading));
    if ((record->maps & MAP_COAT_NORMAL) != 0u)
        coat_normal = mapped_normal(geometry, tables, record, MAP_COAT_NORMAL, &look.at,
                                    record->coat_normal_scale, surface->shading, surface->front);
    if (record->model == SURFACE_LAMBERT) {
        found.frame = frame_about(at.shading, f3(0.0f, 0.0f, 0.0f));
        found.v = into_frame(&found.frame, viewer);
        found.albedo = surface->bsdf.albedo;
        found.sides = max_component(found.albedo) > 0.0f ? SCATTERS_ABOVE : 0u;
        return found;
    }
    float along, across;
    float3 direction = find_roughness(&look, &at, &along, &across);
    uint kind = ((record->flags & SURFACE_BECKMANN) != 0u ? FACETS_BECKMANN : 0u) |
                ((record->flags & SURFACE_SEPARABLE) != 0u ? FACETS_SEPARABLE : 0u);
    Facets facets = make_facets(along, across, kind);
    found.frame = frame_about(bends ? bent_normal(viewer, at.shading, surface->normal) : at.shading,
                              direction);
    found.v = into_frame(&found.frame, viewer);
    float3 vertex_colour = f3(1.0f, 1.0f, 1.0f);
    if (HAS(params, FEATURE_VERTEX_COLOURS)) {
        float w = 1.0f - hit.u - hit.v;
        vertex_colour = attribute3(geometry->vertex_colours, look.at.triangle.v0) * w +
                        attribute3(geometry->vertex_colours, look.at.triangle.v1) * hit.u +
                        attribute3(geometry->vertex_colours, look.at.triangle.v2) * hit.v;
    }
    if (record->model == SURFACE_PLASTIC) {
        found.plastic = plastic_at(&look, vertex_colour, facets);
        found.sides = found.v.z > 0.0f ? SCATTERS_ABOVE : 0u;
        found.albedo = found.plastic.body;
        return found;
    }
    LayeredMaterial material =
        layered_at(&look, &at, vertex_colour, bent_normal(viewer, coat_normal, surface->normal),
                   &found.frame, found.v, facets, ratio);
    found.layered = make_layered(&material, found.v);
    // Solid glass of the index around it blocks shadow rays as all solid glass does, so that what
    // passes it is a sample of a smooth part.
    if (HAS(params, FEATURE_SEE_THROUGH) && (record->flags & SURFACE_THIN) != 0u &&
        found.layered.p_sheet > 0.0f && facets_are_smooth(found.layered.sheet)) {
        found.straight += found.layered.sheet_colour * found.coverage;
        drop_sheet(&found.layered);
    }
    found.sides = found.v.z > 0.0f ? sides_of_layers(&found.layered) : 0u;
    found.albedo = found.layered.albedo;
    return found;
}

/// Diffuse colour and what facets reflect towards the viewer, for layers of the image.
static inline float3 scattering_albedo(const SurfaceScattering* scattering) {
    return scattering->model == SURFACE_LAYERED && scattering->layered.alone != 0
               ? layered_albedo(&scattering->layered, scattering->v)
               : scattering->albedo;
}

/// `straight` of scattering_at in full detail, for shadow rays of a scene with FEATURE_SEE_THROUGH:
/// whatever has gaps alone is not evaluated further. `record` is that of the surface's material.
static inline float3 straight_at(const RenderParams* params, const Geometry* geometry,
                                 const SurfaceTables* tables, GLOBAL const SurfaceRecord* record,
                                 const Surface* surface, Hit hit, float3 viewer) {
    if ((record->flags & SURFACE_THIN) != 0u) {
        IndexRatio ratio;
        ratio.eta = record->eta.x;
        ratio.step = record->k.x;
        return scattering_at(params, geometry, tables, surface, hit, 0.0f, viewer, ratio).straight;
    }
    SurfaceLookup look = lookup_at(geometry, tables, record, hit, 0.0f);
    float gaps = 1.0f - coverage_at(&look);
    return f3(gaps, gaps, gaps);
}

/// Share of the light from `in` that a tilted normal's facets leave.
static inline float tilt_shadowing(const SurfaceScattering* scattering, float3 in) {
    if (!(scattering->shadowing > 0.0f)) return 1.0f;
    return normal_shadowing(scattering->shadowing, dot3(in, scattering->smooth));
}

/// Value times cosine and pdf for light from `in`, a unit vector in the world.
static inline LayeredValue scattering_value(const SurfaceScattering* scattering, float3 in) {
    float3 l = into_frame(&scattering->frame, in);
    LayeredValue value;
    value.value = f3(0.0f, 0.0f, 0.0f);
    value.pdf = 0.0f;
    if (scattering->model != SURFACE_LAMBERT && scattering->model != SURFACE_PLASTIC) {
        value = layered_eval(&scattering->layered, scattering->v, l);
    } else if (l.z > 0.0f && dot3(in, scattering->outward) > 0.0f) {
        // What does not let light through gets none from behind, whatever its shading normal.
        if (scattering->model == SURFACE_PLASTIC) {
            value.value = plastic_eval(&scattering->plastic, scattering->v, l, &value.pdf);
        } else {
            value.pdf = cosine_pdf(l.z);
            value.value = scattering->albedo * value.pdf;
        }
    }
    value.value = value.value * tilt_shadowing(scattering, in);
    return value;
}

/// Chooses where light comes from, in the world, by three numbers in [0, 1); see layered_sample.
static inline BsdfSample scattering_sample(const SurfaceScattering* scattering, float choice,
                                           float u, float w) {
    BsdfSample sample;
    if (scattering->model == SURFACE_LAMBERT) {
        sample.in = cosine_direction(u, w);
        sample.weight = scattering->albedo;
        sample.pdf = cosine_pdf(sample.in.z);
        sample.flags = BSDF_DIFFUSE | BSDF_REFLECTION;
    } else if (scattering->model == SURFACE_PLASTIC) {
        sample = plastic_sample(&scattering->plastic, scattering->v, choice, u, w);
    } else {
        sample = layered_sample(&scattering->layered, scattering->v, choice, u, w);
    }
    sample.in = normalize3(out_of_frame(&scattering->frame, sample.in));
    if ((scattering->model == SURFACE_LAMBERT || scattering->model == SURFACE_PLASTIC) &&
        !(dot3(sample.in, scattering->outward) > 0.0f))
        sample.weight = f3(0.0f, 0.0f, 0.0f);
    sample.weight = sample.weight * tilt_shadowing(scattering, sample.in);
    return sample;
}

#endif
