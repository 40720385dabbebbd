// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Film of previews to colours for a display: the mean of the compensated sums, exposed. The film
// holds Params::samples samples; `exposure` is what a sum is multiplied with.
#include "display.h"

/// Adds the sum of one plane to `sum`; after a single sample nothing is compensated.
static inline FloatPair add_film_plane(GLOBAL const float* high, GLOBAL const float* low, uint at,
                                       uint samples, FloatPair sum) {
    FloatPair total = m_two_sum(sum.high, high[at]);
    total.low = total.low + sum.low;
    if (samples > 1u) total.low = total.low + low[at];
    return total;
}

/// All light of one channel.
static inline float film_light(const Params* params, GLOBAL const float* high,
                               GLOBAL const float* low, uint pixel, uint channel) {
    uint stride = FILM_STRIDE(params->width * params->height);
    uint at = pixel + channel * stride;
    FloatPair sum;
    sum.high = 0.0f;
    sum.low = 0.0f;
    sum = add_film_plane(high, low, at + FILM_EMISSION * stride, params->samples, sum);
    sum = add_film_plane(high, low, at + FILM_DIRECT * stride, params->samples, sum);
    sum = add_film_plane(high, low, at + FILM_INDIRECT * stride, params->samples, sum);
    if (HAS(params, FEATURE_AIRLIGHT))
        sum = add_film_plane(high, low, at + FILM_MEDIA * stride, params->samples, sum);
    return sum.high + sum.low;
}

WEFT_KERNEL(resolve_display)
(PARAMS, GLOBAL const float* film_high, GLOBAL const float* film_low, GLOBAL const float* exposure,
 GLOBAL uint* colours) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    float factor = exposure[0];
    float3 light;
    light.x = film_light(&params, film_high, film_low, pixel, 0u) * factor;
    light.y = film_light(&params, film_high, film_low, pixel, 1u) * factor;
    light.z = film_light(&params, film_high, film_low, pixel, 2u) * factor;
    colours[pixel] = display_colour(&params, pixel, light);
}
