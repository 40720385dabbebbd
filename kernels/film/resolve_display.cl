// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts the film of previews to colours for a display: the mean of the compensated sums,
// exposed, under the tone curve `tone`. The film holds `samples` samples; `exposure` is what a sum
// is multiplied with. One work-item per pixel.
#include "kernels/core/kernel.h"
#include "kernels/film/display.h"

/// Adds the sum of one plane to `sum`; after a single sample nothing is compensated.
static inline FloatPair add_film_plane(GLOBAL const float* high, GLOBAL const float* low, uint at,
                                       uint samples, FloatPair sum) {
    FloatPair total = m_two_sum(sum.high, high[at]);
    total.low = total.low + sum.low;
    if (samples > 1u) total.low = total.low + low[at];
    return total;
}

/// All light of one channel.
static inline float film_light(const RenderParams* params, uint samples, GLOBAL const float* high,
                               GLOBAL const float* low, uint pixel, uint channel) {
    uint stride = FILM_STRIDE(params->camera.width * params->camera.height);
    uint at = pixel + channel * stride;
    FloatPair sum;
    sum.high = 0.0f;
    sum.low = 0.0f;
    sum = add_film_plane(high, low, at + FILM_EMISSION * stride, samples, sum);
    sum = add_film_plane(high, low, at + FILM_DIRECT * stride, samples, sum);
    sum = add_film_plane(high, low, at + FILM_INDIRECT * stride, samples, sum);
    for (uint plane = FILM_PLANES; plane < film_plane_count(params->features); plane += 3u)
        sum = add_film_plane(high, low, at + plane * stride, samples, sum);
    return sum.high + sum.low;
}

WEFT_KERNEL(resolve_display)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    float3 light;
    light.x = film_light(&params, samples, film_high, film_low, pixel, 0u) * exposure;
    light.y = film_light(&params, samples, film_high, film_low, pixel, 1u) * exposure;
    light.z = film_light(&params, samples, film_high, film_low, pixel, 2u) * exposure;
    colours[pixel] = display_colour(&params, pixel, tone, light);
}
