// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The G-buffer of a scene with metals, plastics and glass (gbuffer.cl is that of others): it has
// the normals of normal maps, and of each material what previews make diffuse
// (kernels/bsdf/seen_lobes.h). What is reflected and let through is left to view_chains.cl. Rays
// pass gaps of masks. One work-item per block of pixels, row by row.
#include "kernels/core/kernel.h"
#include "kernels/film/primary_rays.h"
#include "kernels/path/view_chain.h"

WEFT_KERNEL(gbuffer_surfaces)
{
    if (WORK_ITEM(range) >= range.count) return;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    SURFACES_MAKE(tables);
    ENVIRONMENT_MAKE(environment);
    PIXEL_STORE_MAKE(store);
    PixelBlock block;
    make_pixel_block(&params, range.first + WORK_ITEM(range), &block);
    Hit hits[LANES];
    trace_camera_packet(&params, scene, &block.rays, block.inside, hits);
    // Which facet is seen makes no difference to what is diffuse.
    FacetChoice mean_facet = {0.5f, 0.5f, 0.5f, ANY_ALPHA};
    for (uint lane = 0u; lane < LANES; ++lane) {
        if ((block.inside >> lane & 1u) == 0u) continue;
        uint pixel = pixel_of_lane(&params, &block, lane);
        float3 direction = lane_direction(&block.rays, lane);
        Hit hit = hits[lane];
        float depth = hit.t;
        SurfacePath path = start_view_chain(direction);
        SeenSurface seen;
        seen.is_there = 0;
        for (uint gaps = 0u; hit.triangle != INVALID_INDEX && gaps < MOST_GAPS; ++gaps) {
            // A cone about the last part of the ray that is as wide there as one from the camera.
            float angle =
                seen_texture_angle(&params, params.camera.texture_angle, depth) * (depth / hit.t);
            seen = see_surface(&params, &geometry, &tables, hit, angle, mean_facet, &path);
            if (seen.is_there != 0) break;
            pass_chain(&params, &tables, &seen, hit.t, &path);
            hit = trace_closest(scene, path.ray.origin, direction, RAY_INFINITY);
            depth += hit.t;
        }
        if (seen.is_there == 0) {
            store_background(&params, &environment, pixel, direction, &store);
            continue;
        }
        store_surface(&params, pixel, seen.surface.instance, hit.triangle, seen.surface.position,
                      seen.surface.normal, seen.shading, seen.lobes.diffuse, seen.emission,
                      direction, depth, &store);
    }
}
