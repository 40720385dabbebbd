// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Shadow rays among surfaces with any material: those with gaps, and smooth glass without
// thickness, let light pass straight on.
#ifndef WEFT_KERNELS_PATH_LIGHT_PASSING_H
#define WEFT_KERNELS_PATH_LIGHT_PASSING_H

#include "kernels/bsdf/scattering.h"
#include "kernels/path/path_lights.h"

// Most surfaces that a shadow ray looks through: more than any foliage has, but not endless.
#define MOST_SEEN_THROUGH 4096

/// Share of the light that comes along a shadow ray from a point off a surface, or in a medium, to
/// the end of `towards`, or from infinity: what passes straight through surfaces. Solid glass
/// blocks it.
static inline float3 light_passing(const RenderParams* params, const PathScene* world,
                                   const SurfaceTables* tables, float3 origin, float3 towards,
                                   int distant, uint* rays) {
    float3 passes = f3(1.0f, 1.0f, 1.0f);
    float3 none = f3(0.0f, 0.0f, 0.0f);
    if (!HAS(params, FEATURE_SEE_THROUGH)) {
        ++*rays;
        int seen = distant != 0 ? sees_infinity(world->scene, params, origin, towards)
                                : sees_point(world->scene, params, origin, towards);
        return seen != 0 ? passes : none;
    }
    const Geometry* geometry = &world->geometry;
    float3 viewer = normalize3(-towards);
    for (int i = 0; i < MOST_SEEN_THROUGH; ++i) {
        float near = 4.0f * surface_offset(origin, params->scene.extent);
        float3 ahead = towards * (near / length3(towards));
        float3 way = distant != 0 ? towards : towards - ahead;
        ++*rays;
        Hit hit = trace_closest(world->scene, origin + ahead, way,
                                distant != 0 ? RAY_INFINITY : SHADOW_END);
        if (hit.triangle == INVALID_INDEX) return passes;
        Surface surface = surface_at(params, geometry, hit, way, 0.0f);
        GLOBAL const SurfaceRecord* record = record_of(geometry, tables, &surface);
        if ((record->flags & (SURFACE_THIN | SURFACE_MASK | SURFACE_BLEND)) == 0u) return none;
        passes = passes * straight_at(params, geometry, tables, record, &surface, hit, viewer);
        if (!(max_component(passes) > 0.0f)) return none;
        float3 behind = surface.position -
                        surface.normal * surface_offset(surface.position, params->scene.extent);
        if (distant == 0) {
            towards = origin + towards - behind;
            if (!(dot3(towards, way) > 0.0f)) return passes;
        }
        origin = behind;
    }
    return none;
}

#endif
