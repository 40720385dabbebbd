// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Discontinuity buffer (Wald et al. 2002): the irradiance of a pixel is the mean over those
// neighbours in a (2r+1)^2 window that lie on the same surface by normal and plane distance, so
// that every sample set is met once. Texture never passes through it. At the picture's border the
// window is moved inwards, to hold all sets there too.
#include "gbuffer.h"
#include "triangle.h"

static inline int window_start(int centre, int radius, int size) {
    int last = size - (2 * radius + 1);
    int start = centre - radius;
    if (start > last) start = last;
    return start < 0 ? 0 : start;
}

WEFT_KERNEL(reconstruct)
(PARAMS, GBUFFER_ARGS, GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
 GLOBAL float4* filtered) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    if (gb_ids[2u * pixel] == NO_TRIANGLE || !(gb_albedo[pixel].w > 0.0f)) {
        filtered[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        return;
    }
    float3 position = xyz(gb_position[pixel]);
    float3 normal = xyz(gb_normal[pixel]);
    float3 shading = xyz(gb_shading[pixel]);
    float reach = params.filter_planes * gb_normal[pixel].w;
    int radius = (int)params.filter_radius;
    int width = (int)params.width;
    int height = (int)params.height;
    int x0 = window_start((int)(pixel % params.width), radius, width);
    int y0 = window_start((int)(pixel / params.width), radius, height);
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    for (int y = y0; y <= y0 + 2 * radius && y < height; ++y) {
        for (int x = x0; x <= x0 + 2 * radius && x < width; ++x) {
            uint other = (uint)y * params.width + (uint)x;
            if (other != pixel) {
                if (gb_ids[2u * other] == NO_TRIANGLE || !(gb_albedo[other].w > 0.0f)) continue;
                if (!(dot3(shading, xyz(gb_shading[other])) > params.filter_cosine)) continue;
                float distance = dot3(xyz(gb_position[other]) - position, normal);
                if (!(absolute(distance) < reach)) continue;
            }
            uint slot = pixel_slot[other];
            sum += f3(irradiance[slot], irradiance[params.slots + slot],
                      irradiance[2u * params.slots + slot]);
            weight += 1.0f;
        }
    }
    float share = 1.0f / weight;
    filtered[pixel] = f4(sum.x * share, sum.y * share, sum.z * share, weight);
}
