// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Exposed linear colours to the 8-bit sRGB that displays take, dithered as PNG files are
// (host/image/png.cpp).
#ifndef WEFT_KERNELS_FILM_DISPLAY_H
#define WEFT_KERNELS_FILM_DISPLAY_H

#include "kernels/core/maths.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"
#include "kernels/film/tone.h"

/// The sRGB transfer function of a value in [0, 1].
static inline float srgb_encoded(float linear) {
    if (linear <= 0.0031308f) return 12.92f * linear;
    return 1.055f * m_pow(linear, 0.416666667f) - 0.055f;
}

/// Threshold in (0, 1) of the 8x8 Bayer matrix, whose 64 values are (k + 1/2) / 64.
static inline float dither_threshold(uint x, uint y) {
    uint rank = 0u;
    for (uint bit = 0u; bit < 3u; ++bit) {
        uint x_bit = (x >> bit) & 1u;
        uint y_bit = (y >> bit) & 1u;
        rank = rank * 4u + ((x_bit ^ y_bit) * 2u + y_bit);
    }
    return ((float)rank + 0.5f) / 64.0f;
}

/// A linear value as a code from 0 to 255; NaN and what is negative are 0.
static inline uint display_code(float linear, float threshold) {
    if (!(linear > 0.0f)) return 0u;
    float value = 255.0f * srgb_encoded(m_min(linear, 1.0f));
    return (uint)m_min(255.0f, m_floor(value + threshold));
}

/// The colour of a pixel under a tone curve (TONE_*), as one word: red in the lowest byte, then
/// green, blue and 255.
static inline uint display_colour(const RenderParams* params, uint pixel, uint tone,
                                  float3 exposed) {
    float3 linear = toned(tone, exposed);
    float threshold = dither_threshold(pixel % params->camera.width, pixel / params->camera.width);
    return display_code(linear.x, threshold) | display_code(linear.y, threshold) << 8 |
           display_code(linear.z, threshold) << 16 | 255u << 24;
}

#endif
