// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The rays of gbuffer.cl and gbuffer_surfaces.cl, in packets of a small block of pixels, and what
// those that meet nothing leave.
#ifndef WEFT_KERNELS_FILM_PRIMARY_RAYS_H
#define WEFT_KERNELS_FILM_PRIMARY_RAYS_H

#include "kernels/core/random.h"
#include "kernels/film/camera_rays.h"
#include "kernels/film/gbuffer.h"
#include "kernels/light/environment.h"

// Keeps the random numbers of places in pixels apart from those of paths through them.
#define JITTER_SEED 0x5BE0CD19u

// Where to store what pixels show; see gbuffer.h.
typedef struct {
    GLOBAL uint* ids;
    GLOBAL float4* position;
    GLOBAL float4* normal;
    GLOBAL float4* shading;
    GLOBAL float4* albedo;
    GLOBAL float4* emission;
} PixelStore;

#define PIXEL_STORE_MAKE(name)   \
    PixelStore name;             \
    name.ids = gb_ids;           \
    name.position = gb_position; \
    name.normal = gb_normal;     \
    name.shading = gb_shading;   \
    name.albedo = gb_albedo;     \
    name.emission = gb_emission

// A block of pixels and their rays.
typedef struct {
    uint left, top, width;  // pixels
    uint inside;            // lanes whose pixels lie in the image
    CameraPacket rays;
} PixelBlock;

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

/// The rays of block number `number`, row by row.
static inline void make_pixel_block(const RenderParams* params, uint number, PixelBlock* block) {
    block->width = pixel_block_width((uint)LANES);
    const uint height = (uint)LANES / block->width;
    uint blocks = (params->camera.width + block->width - 1u) / block->width;
    block->left = number % blocks * block->width;
    block->top = number / blocks * height;
    block->inside = 0u;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        uint x = block->left + lane % block->width;
        uint y = block->top + lane / block->width;
        set_pixel_ray(params, x, y, lane, &block->rays);
        if (x < params->camera.width && y < params->camera.height) block->inside |= 1u << lane;
    }
}

/// The pixel of a lane.
static inline uint pixel_of_lane(const RenderParams* params, const PixelBlock* block, uint lane) {
    return (block->top + lane / block->width) * params->camera.width + block->left +
           lane % block->width;
}

/// Stores that a ray of the camera in that direction meets nothing.
static inline void store_background(const RenderParams* params, const EnvironmentImage* environment,
                                    uint pixel, float3 direction, const PixelStore* store) {
    float4 none = f4(0.0f, 0.0f, 0.0f, 0.0f);
    store->ids[2u * pixel] = INVALID_INDEX;
    store->ids[2u * pixel + 1u] = INVALID_INDEX;
    store->position[pixel] = none;
    store->normal[pixel] = none;
    store->shading[pixel] = none;
    store->albedo[pixel] = none;
    float3 sky = background_radiance(params, environment, direction);
    store->emission[pixel] = f4(sky.x, sky.y, sky.z, 0.0f);
}

/// Stores a surface that lies `depth` along a ray whose component along the viewing axis is 1.
static inline void store_surface(const RenderParams* params, uint pixel, uint instance,
                                 uint triangle, float3 position, float3 normal, float3 shading,
                                 float3 albedo, float3 emission, float3 direction, float depth,
                                 const PixelStore* store) {
    float length = length3(direction);
    float facing = -dot3(normal, direction) / length;
    float footprint = pixel_width(params, depth * length) / m_max(facing, 0.05f);
    float lit = albedo.x > 0.0f || albedo.y > 0.0f || albedo.z > 0.0f ? 1.0f : 0.0f;
    store->ids[2u * pixel] = instance;
    store->ids[2u * pixel + 1u] = triangle;
    store->position[pixel] = f4(position.x, position.y, position.z, depth);
    store->normal[pixel] = f4(normal.x, normal.y, normal.z, footprint);
    store->shading[pixel] = f4(shading.x, shading.y, shading.z, 0.0f);
    store->albedo[pixel] = f4(albedo.x, albedo.y, albedo.z, lit);
    store->emission[pixel] = f4(emission.x, emission.y, emission.z, 0.0f);
}

#endif
