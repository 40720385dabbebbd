// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Primary visibility: one ray a pixel, through its centre, the frame's jittered point or one of its
// own, in packets of a small block of pixels. One work-item per block, row by row.
#include "kernels/bsdf/surface.h"
#include "kernels/core/kernel.h"
#include "kernels/film/primary_rays.h"

/// What a pixel's ray in that direction met; `facet` is the triangle's.
static inline void store_pixel(const RenderParams* params, const Geometry* geometry,
                               const EnvironmentImage* environment, const Facet* facet, uint pixel,
                               float3 direction, Hit hit, const PixelStore* store) {
    if (hit.triangle == INVALID_INDEX) {
        store_background(params, environment, pixel, direction, store);
        return;
    }
    Surface surface = surface_on(params, geometry, facet, hit, direction,
                                 seen_texture_angle(params, params->camera.texture_angle, hit.t));
    // The forward component of `direction` is 1, so t is the distance along the viewing axis.
    store_surface(params, pixel, surface.instance, hit.triangle, surface.position, surface.normal,
                  surface.shading, bsdf_diffuse_albedo(&surface.bsdf), surface.emission, direction,
                  hit.t, store);
}

WEFT_KERNEL(gbuffer)
{
    if (WORK_ITEM(range) >= range.count) return;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    ENVIRONMENT_MAKE(environment);
    PIXEL_STORE_MAKE(store);
    PixelBlock block;
    make_pixel_block(&params, range.first + WORK_ITEM(range), &block);
    Hit hits[LANES];
    trace_camera_packet(&params, scene, &block.rays, block.inside, hits);
    Facet facet;
    uint facet_id = INVALID_INDEX;
    for (uint lane = 0u; lane < LANES; ++lane) {
        if ((block.inside >> lane & 1u) == 0u) continue;
        // Neighbours mostly show the same triangle.
        if (hits[lane].triangle != facet_id) {
            facet_id = hits[lane].triangle;
            if (facet_id != INVALID_INDEX) facet = facet_of(&geometry, facet_id);
        }
        store_pixel(&params, &geometry, &environment, &facet, pixel_of_lane(&params, &block, lane),
                    lane_direction(&block.rays, lane), hits[lane], &store);
    }
}
