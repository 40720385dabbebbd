// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Primary visibility: one ray a pixel, through its centre, the frame's jittered point or one of its
// own, in packets of a small block of pixels. One work-item per block, row by row.
#include "kernels/bsdf/surface.h"
#include "kernels/core/kernel.h"
#include "kernels/core/random.h"
#include "kernels/film/camera_rays.h"
#include "kernels/film/gbuffer.h"
#include "kernels/light/environment.h"

// Keeps the random numbers of places in pixels apart from those of paths through them.
#define JITTER_SEED 0x5BE0CD19u

/// Makes the ray through the pixel at (`x`, `y`) a lane's.
static inline void set_pixel_ray(const RenderParams* params, uint x, uint y, uint lane,
                                 CameraPacket* rays) {
    float right = params->camera.jitter_x;
    float down = params->camera.jitter_y;
    if (params->camera.own_jitter != 0u) {
        Random random = make_random(params->sampling.seed ^ JITTER_SEED,
                                    y * params->camera.width + x, params->sampling.sample);
        right = next_random(&random);
        down = next_random(&random);
    }
    set_camera_ray(params, rays, lane, (float)x + right, (float)y + down);
}

/// What a pixel's ray in that direction met; `facet` is the triangle's.
static inline void store_pixel(const RenderParams* params, const Geometry* geometry,
                               const EnvironmentImage* environment, const Facet* facet, uint pixel,
                               float3 direction, Hit hit, GLOBAL uint* gb_ids,
                               GLOBAL float4* gb_position, GLOBAL float4* gb_normal,
                               GLOBAL float4* gb_shading, GLOBAL float4* gb_albedo,
                               GLOBAL float4* gb_emission) {
    gb_ids[2u * pixel] = INVALID_INDEX;
    gb_ids[2u * pixel + 1u] = hit.triangle;
    if (hit.triangle == INVALID_INDEX) {
        gb_position[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        gb_normal[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        gb_shading[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        gb_albedo[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        float3 sky = background_radiance(params, environment, direction);
        gb_emission[pixel] = f4(sky.x, sky.y, sky.z, 0.0f);
        return;
    }
    Surface surface = surface_on(params, geometry, facet, hit, direction,
                                 seen_texture_angle(params, params->camera.texture_angle, hit.t));
    // The forward component of `direction` is 1, so t is the distance along the viewing axis.
    float depth = hit.t;
    float length = length3(direction);
    float distance = depth * length;
    float facing = -dot3(surface.normal, direction) / length;
    float footprint = pixel_width(params, distance) / m_max(facing, 0.05f);
    float3 albedo = bsdf_diffuse_albedo(&surface.bsdf);
    float lit = albedo.x > 0.0f || albedo.y > 0.0f || albedo.z > 0.0f ? 1.0f : 0.0f;
    gb_ids[2u * pixel] = surface.instance;
    gb_position[pixel] = f4(surface.position.x, surface.position.y, surface.position.z, depth);
    gb_normal[pixel] = f4(surface.normal.x, surface.normal.y, surface.normal.z, footprint);
    gb_shading[pixel] = f4(surface.shading.x, surface.shading.y, surface.shading.z, 0.0f);
    gb_albedo[pixel] = f4(albedo.x, albedo.y, albedo.z, lit);
    gb_emission[pixel] = f4(surface.emission.x, surface.emission.y, surface.emission.z, 0.0f);
}

WEFT_KERNEL(gbuffer)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint block = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    ENVIRONMENT_MAKE(environment);
    const uint block_width = pixel_block_width((uint)LANES);
    const uint block_height = (uint)LANES / block_width;
    uint blocks = (params.camera.width + block_width - 1u) / block_width;
    uint left = block % blocks * block_width;
    uint top = block / blocks * block_height;
    CameraPacket rays;
    uint inside = 0u;
    for (uint lane = 0u; lane < LANES; ++lane) {
        uint x = left + lane % block_width;
        uint y = top + lane / block_width;
        set_pixel_ray(&params, x, y, lane, &rays);
        if (x < params.camera.width && y < params.camera.height) inside |= 1u << lane;
    }
    Hit hits[LANES];
    trace_camera_packet(&params, scene, &rays, inside, hits);
    Facet facet;
    uint facet_id = INVALID_INDEX;
    for (uint lane = 0u; lane < LANES; ++lane) {
        if ((inside >> lane & 1u) == 0u) continue;
        // Neighbours mostly show the same triangle.
        if (hits[lane].triangle != facet_id) {
            facet_id = hits[lane].triangle;
            if (facet_id != INVALID_INDEX) facet = facet_of(&geometry, facet_id);
        }
        uint pixel = (top + lane / block_width) * params.camera.width + left + lane % block_width;
        store_pixel(&params, &geometry, &environment, &facet, pixel, lane_direction(&rays, lane),
                    hits[lane], gb_ids, gb_position, gb_normal, gb_shading, gb_albedo, gb_emission);
    }
}
