// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Averages the residual of each pixel (vpl_residual.cl) with that of the eight places about it that
// lie `spacing` pixels away, as far as they are on its surface by the discontinuity buffer: a step
// of the a-trous algorithm (Dammertz, Sewtz, Hanika and Lensch 2010). After filter_residual.cl,
// whose places are neighbours, each pixel has the mean over a square of 9 x 9 pixels where
// `spacing` is 3. One path a pixel is so rare a look at bright surfaces close by that the mean over
// 3 x 3 shows as specks. One work-item per pixel.
//
// The mean over 9 x 9 pixels still shows as a square where one path brings a hundred times the
// light of the pixel. So no path counts for more than `most` times (number of the sample + 1) what
// the pixel has without the residual: such a path makes it brighter by `most` / 81 at most. The
// bound grows as fast as the number of samples that are averaged, so that their mean misses nothing
// in the limit.
#include "kernels/core/kernel.h"
#include "kernels/film/discontinuity.h"

/// The greatest luminance of a path's irradiance that counts at a pixel.
static inline float most_irradiance(const RenderParams* params, GLOBAL const float4* direct,
                                    GLOBAL const float4* indirect, float most, uint pixel) {
    float sum = 0.0f;
    if (HAS(params, FEATURE_SAMPLED_DIRECT)) sum += luminance(xyz(direct[pixel]));
    if (HAS(params, FEATURE_INDIRECT)) sum += luminance(xyz(indirect[pixel]));
    return sum * most * ((float)params->sampling.sample + 1.0f);
}

/// The irradiance, darker where its luminance is above `most`, in the same hue.
static inline float3 limited_to(float3 irradiance, float most) {
    float brightness = luminance(irradiance);
    return brightness > most ? irradiance * (most / brightness) : irradiance;
}

WEFT_KERNEL(widen_residual)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    uint slot = pixel_slot[pixel];
    if (slot == INVALID_INDEX) return;
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    if (pixel_is_lit(gb_ids, gb_albedo, pixel) != 0) {
        PixelSurface surface =
            pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
        int column = (int)(pixel % params.camera.width);
        int row = (int)(pixel / params.camera.width);
        float limit = most_irradiance(&params, direct, indirect, most, pixel);
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                int x = column + i * (int)spacing;
                int y = row + j * (int)spacing;
                if (x < 0 || y < 0 || x >= (int)params.camera.width ||
                    y >= (int)params.camera.height)
                    continue;
                uint other = (uint)y * params.camera.width + (uint)x;
                if (other != pixel) {
                    if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) continue;
                    if (on_surface(&surface, gb_position, gb_shading, other) == 0) continue;
                }
                uint from = pixel_slot[other];
                if (from == INVALID_INDEX) continue;
                sum += limited_to(slot_irradiance(irradiance, slots, from), limit);
                weight += 1.0f;
            }
        }
    }
    float share = weight > 0.0f ? 1.0f / weight : 0.0f;
    widened[slot] = sum.x * share;
    widened[slots + slot] = sum.y * share;
    widened[2u * slots + slot] = sum.z * share;
}
