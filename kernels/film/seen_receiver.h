// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The surface that a pixel of the G-buffer shows, as a receiver of light.
#ifndef WEFT_KERNELS_FILM_SEEN_RECEIVER_H
#define WEFT_KERNELS_FILM_SEEN_RECEIVER_H

#include "kernels/core/offset.h"
#include "kernels/core/vector.h"

typedef struct {
    float3 position;  // off the surface, where shadow rays end
    float3 normal, shading;
    float valid;  // 0 where the pixel shows no surface that light makes bright
} SeenReceiver;

static inline SeenReceiver seen_receiver(const RenderParams* params, GLOBAL const uint* gb_ids,
                                         GLOBAL const float4* gb_position,
                                         GLOBAL const float4* gb_normal,
                                         GLOBAL const float4* gb_shading,
                                         GLOBAL const float4* gb_albedo, uint pixel) {
    SeenReceiver seen;
    seen.valid = gb_ids[2u * pixel] != INVALID_INDEX ? gb_albedo[pixel].w : 0.0f;
    seen.normal = xyz(gb_normal[pixel]);
    seen.shading = xyz(gb_shading[pixel]);
    seen.position = xyz(gb_position[pixel]);
    seen.position += seen.normal * surface_offset(seen.position, params->scene.extent);
    return seen;
}

#endif
