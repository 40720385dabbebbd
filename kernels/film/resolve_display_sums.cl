// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts the film of path tracing to colours for a display: the mean of the exact sums, exposed,
// under the tone curve `tone`. `exposure` is what the nearest float of a sum, in its unit, is
// multiplied with. One work-item per pixel.
#include "kernels/core/kernel.h"
#include "kernels/film/display.h"

#if FILM_SUM_SHIFT % 2 != 0 || FILM_SUM_SHIFT >= 64
#error "film_sum_value halves FILM_SUM_SHIFT"
#endif

// The words of a sum as one number.
typedef struct {
    uint word[FILM_SUM_WORDS];
} FilmSum;

/// Adds the sum of one plane, exactly.
static inline void add_film_sum(GLOBAL const uint* sums, uint plane, FilmSum* total) {
    uint carry = 0u;
    for (uint k = 0u; k < FILM_SUM_WORDS; ++k) {
        uint word = sums[plane * FILM_SUM_WORDS + k];
        uint sum = total->word[k] + word;
        uint next = sum + carry;
        carry = (sum < word ? 1u : 0u) | (next < sum ? 1u : 0u);
        total->word[k] = next;
    }
}

/// The value of a sum in its unit, within a few ulp; 0 where it is negative.
static inline float film_sum_value(const FilmSum* sum) {
    if (sum->word[FILM_SUM_WORDS - 1u] >> 31 != 0u) return 0.0f;
    float value = 0.0f;
    for (uint k = FILM_SUM_WORDS; k > 0u; --k)
        value = value * 4294967296.0f + (float)sum->word[k - 1u];
    // Twice half of the shift: 2^-FILM_SUM_SHIFT in two exact steps of powers of two.
    float half_unit = 1.0f / (float)(1u << (FILM_SUM_SHIFT / 2));
    return value * half_unit * half_unit;
}

/// All light of one channel of a pixel, by its sums.
static inline float sums_light(GLOBAL const uint* sums, uint channel) {
    FilmSum total;
    for (uint k = 0u; k < FILM_SUM_WORDS; ++k) total.word[k] = 0u;
    add_film_sum(sums, FILM_EMISSION + channel, &total);
    add_film_sum(sums, FILM_DIRECT + channel, &total);
    add_film_sum(sums, FILM_INDIRECT + channel, &total);
    return film_sum_value(&total);
}

WEFT_KERNEL(resolve_display_sums)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    GLOBAL const uint* sums = film_sums + (size_t)pixel * FILM_PIXEL_WORDS;
    float3 light;
    light.x = sums_light(sums, 0u) * exposure;
    light.y = sums_light(sums, 1u) * exposure;
    light.z = sums_light(sums, 2u) * exposure;
    colours[pixel] = display_colour(&params, pixel, tone, light);
}
