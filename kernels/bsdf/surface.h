// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// From a hit to the surface there: position, normals, how it scatters light, emission.
#ifndef WEFT_KERNELS_BSDF_SURFACE_H
#define WEFT_KERNELS_BSDF_SURFACE_H

#include "kernels/bsdf/bsdf.h"
#include "kernels/bsdf/triangle_texture.h"

// A surface point seen from a direction; both normals face the viewer.
typedef struct {
    float3 position;
    float3 normal;    // geometric
    float3 shading;   // interpolated, on the side of `normal`
    Bsdf bsdf;        // black on the back of one-sided materials
    float3 out;       // bsdf.h's `out`, towards the viewer; without FEATURE_LOBES any
    float3 emission;  // towards the viewer
    uint triangle;
    uint instance;
    int front;  // 1 where the viewer sees the outside
} Surface;

static inline float3 attribute3(GLOBAL const float* values, uint index) {
    return f3(values[3u * index], values[3u * index + 1u], values[3u * index + 2u]);
}

// What all hits of a triangle share.
typedef struct {
    Triangle triangle;
    MaterialRecord material;
    float3 a, b, c;  // vertices
    float3 doubled_area, outside;
} Facet;

static inline Facet facet_of(const Geometry* geometry, uint id) {
    Facet facet;
    facet.triangle = geometry->triangles[id];
    facet.material = geometry->materials[geometry->instances[facet.triangle.instance].material];
    facet.a = xyz(geometry->positions[facet.triangle.v0]);
    facet.b = xyz(geometry->positions[facet.triangle.v1]);
    facet.c = xyz(geometry->positions[facet.triangle.v2]);
    facet.doubled_area = cross3(facet.b - facet.a, facet.c - facet.a);
    facet.outside = normalize3(facet.doubled_area);
    return facet;
}

/// Square root of the share of a facet's doubled area that a cone of `angle` radians about a ray
/// covers where the ray meets it, or 0 where it meets it edge-on.
static inline float texture_footprint(const Facet* facet, Hit hit, float3 direction, float angle) {
    // A cone of width w covers w^2 / cos of the surface.
    float slant = absolute(dot3(direction, facet->doubled_area));
    float width = angle * hit.t * length3(direction) * square_root(length3(direction));
    return slant > 0.0f ? width / square_root(slant) : 0.0f;
}

/// Radiance that a facet emits where a ray meets it, to the side of its outside.
static inline float3 facet_emission(const RenderParams* params, const Geometry* geometry,
                                    const Facet* facet, Hit hit, float3 direction, float angle) {
    float3 radiance = xyz(facet->material.emission);
    uint texture = facet->material.emission_texture;
    if (!HAS(params, FEATURE_EMISSION_TEXTURES) || texture == INVALID_INDEX) return radiance;
    return radiance * emission_texture_at(geometry, texture, facet->triangle, hit.u, hit.v,
                                          texture_footprint(facet, hit, direction, angle));
}

/// The surface at a hit, on that facet, of a ray that travels along `direction`. Textures are
/// averaged over a cone of `angle` radians about the ray; 0 asks for full detail.
static inline Surface surface_on(const RenderParams* params, const Geometry* geometry,
                                 const Facet* facet, Hit hit, float3 direction, float angle) {
    Surface surface;
    Triangle triangle = facet->triangle;
    MaterialRecord material = facet->material;
    float w = 1.0f - hit.u - hit.v;
    surface.position = facet->a * w + facet->b * hit.u + facet->c * hit.v;
    surface.triangle = hit.triangle;
    surface.instance = triangle.instance;
    surface.front = dot3(facet->outside, direction) < 0.0f ? 1 : 0;
    surface.normal = surface.front != 0 ? facet->outside : -facet->outside;
    surface.shading = surface.normal;
    if (HAS(params, FEATURE_SMOOTH_NORMALS)) {
        float3 smooth = normalize3(attribute3(geometry->normals, triangle.v0) * w +
                                   attribute3(geometry->normals, triangle.v1) * hit.u +
                                   attribute3(geometry->normals, triangle.v2) * hit.v);
        if (surface.front == 0) smooth = -smooth;
        if (dot3(smooth, surface.normal) > 0.0f) surface.shading = smooth;
    }
    surface.out = f3(0.0f, 0.0f, 1.0f);
    if (HAS(params, FEATURE_LOBES))
        surface.out = local_direction(normalize3(-direction), surface.shading);
    surface.bsdf.lobe = HAS(params, FEATURE_LOBES) ? material.lobe : (uint)LOBE_LAMBERT;
    surface.bsdf.albedo = xyz(material.albedo);
    surface.bsdf.parameters = material.parameters;
    if (HAS(params, FEATURE_TEXTURES) && material.texture != INVALID_INDEX)
        surface.bsdf.albedo *= texture_at(geometry, material.texture, triangle, hit.u, hit.v,
                                          texture_footprint(facet, hit, direction, angle));
    if (HAS(params, FEATURE_VERTEX_COLOURS))
        surface.bsdf.albedo *= attribute3(geometry->vertex_colours, triangle.v0) * w +
                               attribute3(geometry->vertex_colours, triangle.v1) * hit.u +
                               attribute3(geometry->vertex_colours, triangle.v2) * hit.v;
    if (HAS(params, FEATURE_ONE_SIDED) && surface.front == 0 &&
        (material.flags & MATERIAL_TWO_SIDED) == 0u)
        surface.bsdf.albedo = f3(0.0f, 0.0f, 0.0f);
    surface.emission = f3(0.0f, 0.0f, 0.0f);
    if ((material.flags & MATERIAL_EMITS) != 0u &&
        (surface.front != 0 || (material.flags & MATERIAL_EMITS_BOTH_SIDES) != 0u))
        surface.emission = facet_emission(params, geometry, facet, hit, direction, angle);
    return surface;
}

/// The same for a single hit.
static inline Surface surface_at(const RenderParams* params, const Geometry* geometry, Hit hit,
                                 float3 direction, float angle) {
    Facet facet = facet_of(geometry, hit.triangle);
    return surface_on(params, geometry, &facet, hit, direction, angle);
}

#endif
