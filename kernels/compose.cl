// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Components to radiance, and radiance into the film. What is not finite or negative is counted,
// set to 0 and never reaches the film. The film sums samples in compensated float pairs.
#include "gbuffer.h"
#include "guard.h"
#include "triangle.h"

/// Neumaier's compensated sum; the first sample starts it.
static inline void add_to_film(GLOBAL float* high, GLOBAL float* low, uint at, int starts,
                               float x) {
    float sum = starts != 0 ? 0.0f : high[at];
    float rest = starts != 0 ? 0.0f : low[at];
    float total = sum + x;
    if (absolute(sum) >= absolute(x))
        rest += (sum - total) + x;
    else
        rest += (x - total) + sum;
    high[at] = total;
    low[at] = rest;
}

static inline void add_vector(GLOBAL float* high, GLOBAL float* low, uint at, uint stride,
                              int starts, float3 x) {
    add_to_film(high, low, at, starts, x.x);
    add_to_film(high, low, at + stride, starts, x.y);
    add_to_film(high, low, at + 2u * stride, starts, x.z);
}

WEFT_KERNEL(compose)
(PARAMS, GBUFFER_ARGS, GLOBAL const uint* pixel_slot, GLOBAL const float4* direct,
 GLOBAL const float* exact_irradiance, GLOBAL const float4* indirect, GLOBAL float* film_high,
 GLOBAL float* film_low, GLOBAL NonfiniteCounter* nonfinite) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    uint stride = FILM_STRIDE(params.width * params.height);
    int starts = params.film_starts != 0u ? 1 : 0;
    float3 reflectance = xyz(gb_albedo[pixel]) * 0.318309886f;
    float3 direct_irradiance = f3(0.0f, 0.0f, 0.0f);
    if (HAS(&params, FEATURE_SAMPLED_DIRECT)) direct_irradiance = xyz(direct[pixel]);
    if (HAS(&params, FEATURE_EXACT_DIRECT) && gb_ids[2u * pixel] != NO_TRIANGLE &&
        gb_albedo[pixel].w > 0.0f) {
        uint slot = pixel_slot[pixel];
        direct_irradiance += f3(exact_irradiance[slot], exact_irradiance[params.slots + slot],
                                exact_irradiance[2u * params.slots + slot]);
    }
    float3 indirect_irradiance = f3(0.0f, 0.0f, 0.0f);
    if (HAS(&params, FEATURE_INDIRECT)) indirect_irradiance = xyz(indirect[pixel]);
    float3 emission = guard(nonfinite, COMPONENT_EMISSION, pixel, xyz(gb_emission[pixel]));
    float3 direct_light =
        guard(nonfinite, COMPONENT_DIRECT, pixel, reflectance * direct_irradiance);
    float3 indirect_light =
        guard(nonfinite, COMPONENT_INDIRECT, pixel, reflectance * indirect_irradiance);
    add_vector(film_high, film_low, FILM_EMISSION * stride + pixel, stride, starts, emission);
    add_vector(film_high, film_low, FILM_DIRECT * stride + pixel, stride, starts, direct_light);
    add_vector(film_high, film_low, FILM_INDIRECT * stride + pixel, stride, starts, indirect_light);
    float3 albedo = guard(nonfinite, COMPONENT_SURFACE, pixel, xyz(gb_albedo[pixel]));
    float depth = gb_position[pixel].w / params.unit;
    add_vector(film_high, film_low, FILM_ALBEDO * stride + pixel, stride, starts, albedo);
    add_vector(film_high, film_low, FILM_NORMAL * stride + pixel, stride, starts,
               xyz(gb_shading[pixel]));
    add_to_film(film_high, film_low, FILM_DEPTH * stride + pixel, starts,
                guard(nonfinite, COMPONENT_SURFACE, pixel, f3(depth, 0.0f, 0.0f)).x);
}
