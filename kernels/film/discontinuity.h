// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells which pixels may share irradiance: those on the same surface by normal and plane distance
// (discontinuity buffer, Wald et al. 2002).
#ifndef WEFT_KERNELS_FILM_DISCONTINUITY_H
#define WEFT_KERNELS_FILM_DISCONTINUITY_H

#include "kernels/bvh/triangle.h"
#include "kernels/film/gbuffer.h"

// The surface of a pixel, which others are tested against.
typedef struct {
    float3 position, normal, shading;
    float reach;   // largest distance of others from its plane
    float cosine;  // least cosine between shading normals
} PixelSurface;

/// 1 where the pixel shows a surface that reflects, so that it has an irradiance.
static inline int pixel_is_lit(GLOBAL const uint* gb_ids, GLOBAL const float4* gb_albedo,
                               uint pixel) {
    return gb_ids[2u * pixel] != INVALID_INDEX && gb_albedo[pixel].w > 0.0f ? 1 : 0;
}

/// The surface of a pixel that is lit, with `share` of the discontinuity buffer's tolerances; 1 for
/// the buffer itself.
static inline PixelSurface pixel_surface(const RenderParams* params,
                                         GLOBAL const float4* gb_position,
                                         GLOBAL const float4* gb_normal,
                                         GLOBAL const float4* gb_shading, uint pixel, float share) {
    PixelSurface surface;
    surface.position = xyz(gb_position[pixel]);
    surface.normal = xyz(gb_normal[pixel]);
    surface.shading = xyz(gb_shading[pixel]);
    surface.reach = share * params->filter.planes * gb_normal[pixel].w;
    surface.cosine = 1.0f - share * (1.0f - params->filter.cosine);
    return surface;
}

/// 1 where `other`, which is lit, lies on the same surface.
static inline int on_surface(const PixelSurface* surface, GLOBAL const float4* gb_position,
                             GLOBAL const float4* gb_shading, uint other) {
    if (!(dot3(surface->shading, xyz(gb_shading[other])) > surface->cosine)) return 0;
    float distance = dot3(xyz(gb_position[other]) - surface->position, surface->normal);
    return absolute(distance) < surface->reach ? 1 : 0;
}

static inline int footprint_start(int centre, int radius, int size) {
    int last = size - (2 * radius + 1);
    int start = centre - radius;
    if (start > last) start = last;
    return start < 0 ? 0 : start;
}

/// Irradiance of a slot, which three planes of `stride` floats hold.
static inline float3 slot_irradiance(GLOBAL const float* irradiance, uint stride, uint slot) {
    return f3(irradiance[slot], irradiance[stride + slot], irradiance[2u * stride + slot]);
}

/// Mean irradiance over those samples of a lit pixel's filter footprint, (2r+1)^2 pixels, that lie
/// on its surface; w: their number. An even surface has every sample set once. At the image's
/// border the footprint is moved inwards, to hold all sets there too. 0 where the footprint has no
/// sample.
static inline float4 footprint_mean(const RenderParams* params, GLOBAL const uint* gb_ids,
                                    GLOBAL const float4* gb_albedo,
                                    GLOBAL const float4* gb_position,
                                    GLOBAL const float4* gb_shading, const PixelSurface* surface,
                                    GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
                                    uint slots, uint pixel) {
    int radius = (int)params->filter.radius;
    int width = (int)params->camera.width;
    int height = (int)params->camera.height;
    int x0 = footprint_start((int)(pixel % params->camera.width), radius, width);
    int y0 = footprint_start((int)(pixel / params->camera.width), radius, height);
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    for (int y = y0; y <= y0 + 2 * radius && y < height; ++y) {
        for (int x = x0; x <= x0 + 2 * radius && x < width; ++x) {
            uint other = (uint)y * params->camera.width + (uint)x;
            if (other != pixel) {
                if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) continue;
                if (on_surface(surface, gb_position, gb_shading, other) == 0) continue;
            }
            uint slot = pixel_slot[other];
            if (slot == INVALID_INDEX) continue;
            sum += slot_irradiance(irradiance, slots, slot);
            weight += 1.0f;
        }
    }
    float share = weight > 0.0f ? 1.0f / weight : 0.0f;
    return f4(sum.x * share, sum.y * share, sum.z * share, weight);
}

#endif
