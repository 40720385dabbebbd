// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of surfaces whose lobes have a direction of their own: normal maps and tangents.
#ifndef WEFT_KERNELS_BSDF_SURFACE_FRAME_H
#define WEFT_KERNELS_BSDF_SURFACE_FRAME_H

#include "kernels/bsdf/bent_normal.h"
#include "kernels/bsdf/surface.h"
#include "kernels/bsdf/surface_maps.h"

// Unit vectors that are orthogonal to each other.
typedef struct {
    float3 tangent, bitangent, normal;
} SurfaceFrame;

static inline float3 into_frame(const SurfaceFrame* frame, float3 w) {
    return f3(dot3(w, frame->tangent), dot3(w, frame->bitangent), dot3(w, frame->normal));
}

static inline float3 out_of_frame(const SurfaceFrame* frame, float3 w) {
    return frame->tangent * w.x + frame->bitangent * w.y + frame->normal * w.z;
}

/// Interpolated tangent and bitangent, which need be neither unit nor orthogonal; both are 0 where
/// the mesh has none.
static inline void tangents_at(const SurfaceTables* tables, const SurfacePoint* at,
                               float3 smooth_normal, float3* tangent, float3* bitangent) {
    float4 a = tables->tangents[at->triangle.v0];
    float w = 1.0f - at->u - at->v;
    *tangent = xyz(a) * w + xyz(tables->tangents[at->triangle.v1]) * at->u +
               xyz(tables->tangents[at->triangle.v2]) * at->v;
    *bitangent = cross3(smooth_normal, *tangent) * a.w;
}

/// The normal that a map gives, on the side of `shading`, which is returned where the map has none.
/// `smooth_normal` is that of the outside, and `front` tells whether the viewer is there.
static inline float3 mapped_normal(const Geometry* geometry, const SurfaceTables* tables,
                                   GLOBAL const SurfaceRecord* record, uint parameter,
                                   const SurfacePoint* at, float scale, float3 shading, int front) {
    float3 outside = front != 0 ? shading : -shading;
    float3 tangent, bitangent;
    tangents_at(tables, at, outside, &tangent, &bitangent);
    float3 colour = map_colour(geometry, tables, record, parameter, at);
    float3 slope = f3(scale * (2.0f * colour.x - 1.0f), scale * (2.0f * colour.y - 1.0f),
                      2.0f * colour.z - 1.0f);
    // A map without slopes changes no bit.
    if (slope.x == 0.0f && slope.y == 0.0f && slope.z > 0.0f) return shading;
    float3 normal = tangent * slope.x + bitangent * slope.y + outside * slope.z;
    float square = dot3(normal, normal);
    if (!(square > 0.0f && square < RAY_INFINITY)) return shading;
    normal = normalize3(normal);
    return front != 0 ? normal : -normal;
}

/// The normal that a map gives by the rules of Mitsuba's `normalmap`: the frame is orthonormal, its
/// bitangent the normal times the tangent, and the back has it mirrored. With SURFACE_NORMAL_FLIP a
/// normal that does not face `viewer`, a unit vector, is turned about `shading` until it does.
static inline float3 mitsuba_normal(const Geometry* geometry, const SurfaceTables* tables,
                                    GLOBAL const SurfaceRecord* record, const SurfacePoint* at,
                                    float3 shading, int front, float3 viewer) {
    float3 outside = front != 0 ? shading : -shading;
    float3 tangent, bitangent;
    tangents_at(tables, at, outside, &tangent, &bitangent);
    tangent = tangent - outside * dot3(outside, tangent);
    if (dot3(tangent, tangent) > 0.0f) {
        tangent = normalize3(tangent);
        bitangent = cross3(outside, tangent);
    } else {
        make_basis(outside, &tangent, &bitangent);
    }
    float3 colour = map_colour(geometry, tables, record, MAP_NORMAL, at);
    float3 slope = f3(2.0f * colour.x - 1.0f, 2.0f * colour.y - 1.0f, 2.0f * colour.z - 1.0f);
    float across = slope.x * dot3(viewer, tangent) + slope.y * dot3(viewer, bitangent);
    if ((record->flags & SURFACE_NORMAL_FLIP) != 0u &&
        !(across + slope.z * dot3(viewer, shading) > 0.0f)) {
        slope.x = -slope.x;
        slope.y = -slope.y;
    }
    float3 normal = tangent * slope.x + bitangent * slope.y + shading * slope.z;
    float square = dot3(normal, normal);
    return square > 0.0f && square < RAY_INFINITY ? normalize3(normal) : shading;
}

/// Square of the tangent of the angle whose cosine is `c`.
static inline float tangent_square(float c) {
    return m_max(1.0f - c * c, 0.0f) / (c * c);
}

/// Roughness, squared, of the facets by which a normal that is tilted by an angle of the cosine
/// `tilt` is shaded (Conty Estevez, Lecocq and Stein 2019).
static inline float shadowing_roughness(float tilt) {
    // Of a normal along the surface the tangent is infinite.
    return m_min(0.125f * tangent_square(tilt), 1.0f);
}

/// Share of the light that those facets leave, that comes at the cosine `c` with the surface's own
/// normal.
static inline float normal_shadowing(float roughness, float c) {
    return 2.0f / (1.0f + square_root(1.0f + roughness * tangent_square(c)));
}

/// A frame about a normal whose tangent is as near as possible to `along`, or any where that is 0
/// or along the normal.
static inline SurfaceFrame frame_about(float3 normal, float3 along) {
    SurfaceFrame frame;
    frame.normal = normal;
    float3 across = cross3(normal, along);
    if (dot3(across, across) > 1e-12f * dot3(along, along)) {
        frame.bitangent = normalize3(across);
        frame.tangent = cross3(frame.bitangent, normal);
    } else {
        make_basis(normal, &frame.tangent, &frame.bitangent);
    }
    return frame;
}

#endif
