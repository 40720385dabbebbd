// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A ray of the camera on its way by mirrors and through glass, and the surfaces that it meets, as
// previews see them.
#ifndef WEFT_KERNELS_PATH_VIEW_CHAIN_H
#define WEFT_KERNELS_PATH_VIEW_CHAIN_H

#include "kernels/bsdf/glossy_value.h"
#include "kernels/path/surface_path.h"

// Most gaps and absent boundaries that a ray passes: more than any foliage has, but not endless.
#define MOST_GAPS 256u

// A surface that the ray has met.
typedef struct {
    Surface surface;
    SurfaceScattering scattering;  // where `lobes` has more than a diffuse part
    Crossing crossing;
    SeenLobes lobes;
    float3 shading;   // unit normal of the diffuse part, with that of normal maps
    float3 emission;  // towards the ray's origin
    int is_there;     // 0 in a gap, and where another solid that counts more is around
} SeenSurface;

/// A ray of the camera, outside of everything.
static inline SurfacePath start_view_chain(float3 direction) {
    SurfacePath path;
    float3 none = f3(0.0f, 0.0f, 0.0f);
    path.ray.origin = none;
    path.ray.direction = direction;
    path.ray.throughput = f3(1.0f, 1.0f, 1.0f);
    path.ray.ratio = path.ray.throughput;
    path.ray.absorption = none;
    path.ray.basic = 1.0f;
    path.ray.enclosing_media = 0u;
    path.ray.bounce = 0u;
    path.ray.smooth = 0u;
    path.ray.kind = RAY_OF_CAMERA;
    path.ray.pdf = 0.0f;
    path.around = no_interfaces();
    path.passed = 0.0f;
    return path;
}

/// The surface at a hit of the ray. Textures are averaged over a cone of `angle` radians about it,
/// `choice` says which facets are seen. Corrects which solids the ray is inside of.
static inline SeenSurface see_surface(const RenderParams* params, const Geometry* geometry,
                                      const SurfaceTables* tables, Hit hit, float angle,
                                      FacetChoice choice, SurfacePath* path) {
    SeenSurface seen;
    float3 direction = path->ray.direction;
    Facet facet = facet_of(geometry, hit.triangle);
    seen.surface = surface_on(params, geometry, &facet, hit, direction, angle);
    seen.emission = seen.surface.emission;
    seen.shading = seen.surface.shading;
    seen.lobes = no_lobes();
    GLOBAL const SurfaceRecord* record = record_of(geometry, tables, &seen.surface);
    seen.crossing = crossing_at(tables, record, seen.surface.instance, seen.surface.front, path);
    if (seen.crossing.solid != 0) enclose_path(tables, path->around, path);
    seen.is_there = 1 - seen.crossing.absent;
    if (seen.is_there == 0) return seen;
    if (record->model == SURFACE_LAMBERT && record->maps == 0u) {
        seen.lobes.diffuse = bsdf_diffuse_albedo(&seen.surface.bsdf);
        return seen;
    }
    float3 viewer = normalize3(-direction);
    seen.scattering = scattering_at(params, geometry, tables, &seen.surface, hit,
                                    texture_footprint(&facet, hit, direction, angle), viewer,
                                    seen.crossing.ratio);
    const SurfaceScattering* scattering = &seen.scattering;
    if (!(scattering->coverage > 0.0f)) {
        seen.is_there = 0;
        return seen;
    }
    seen.emission = seen.emission * scattering->coverage;
    seen.shading = scattering->frame.normal;
    // The back of a one-sided material is black, but for what it emits.
    int black = seen.surface.front == 0 && seen.crossing.solid == 0 &&
                        (record->flags & SURFACE_THIN) == 0u && HAS(params, FEATURE_ONE_SIDED) &&
                        (facet.material.flags & MATERIAL_TWO_SIDED) == 0u
                    ? 1
                    : 0;
    if (black != 0) {
        seen.lobes.ways[WAY_REFRACTION].share = scattering->straight;
        seen.lobes.ways[WAY_REFRACTION].direction = -viewer;
        return seen;
    }
    if (record->model == SURFACE_UNLIT) seen.emission += scattering->albedo * scattering->coverage;
    // What the host knows not to be glossy anywhere has no component of gloss.
    if ((record->flags & SURFACE_GLOSSY) == 0u) choice.widest = GLOSSY_ALPHA;
    seen.lobes = seen_lobes(scattering, viewer, choice);
    return seen;
}

/// Lets the ray go on as it is behind a surface that it has met after `t`.
static inline void pass_chain(const RenderParams* params, const SurfaceTables* tables,
                              const SeenSurface* seen, float t, SurfacePath* path) {
    const Surface* surface = &seen->surface;
    path->passed += t;
    path->ray.origin = surface->position -
                       surface->normal * surface_offset(surface->position, params->scene.extent);
    if (seen->crossing.solid != 0) enclose_path(tables, seen->crossing.beyond, path);
}

#endif
