// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Choosing lights and points on them.
#ifndef WEFT_LIGHT_H
#define WEFT_LIGHT_H

#include "geometry.h"
#include "offset.h"
#include "sampling.h"

// A point on an area light with the side it shines to.
typedef struct {
    float3 position, normal;
} LightPoint;

/// First of `count` entries whose inclusive sum of probabilities exceeds `u`, else the last. The
/// sums are `stride` floats apart.
static inline uint find_entry(GLOBAL const float* sums, uint stride, uint count, float u) {
    uint low = 0u;
    uint high = count - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (sums[middle * stride] > u)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}

#define LIGHT_STRIDE ((uint)(sizeof(LightRecord) / sizeof(float)))
#define EMISSIVE_STRIDE ((uint)(sizeof(EmissiveTriangle) / sizeof(float)))

/// Area light that `u` falls into by power.
static inline uint choose_area_light(GLOBAL const LightRecord* lights, uint count, float u) {
    return find_entry(&lights->area_cumulative, LIGHT_STRIDE, count, u);
}

/// Light of any kind that `*u` falls into by power; stretches `*u` over the chosen entry for reuse.
static inline uint choose_light(GLOBAL const LightRecord* lights, uint count, float* u) {
    uint chosen = find_entry(&lights->cumulative, LIGHT_STRIDE, count, *u);
    float before = lights[chosen].cumulative - lights[chosen].probability;
    *u = m_clamp((*u - before) / lights[chosen].probability, 0.0f, 0.99999994f);
    return chosen;
}

/// Point of an area light, uniform over its area; the outside of its triangles.
static inline LightPoint sample_area(const Geometry* geometry, LightRecord light,
                                     GLOBAL const EmissiveTriangle* emissive, float u, float v) {
    uint low = light.first +
               find_entry(&emissive[light.first].cumulative, EMISSIVE_STRIDE, light.count, u);
    float before = emissive[low].cumulative - emissive[low].probability;
    float s = m_clamp((u - before) / emissive[low].probability, 0.0f, 0.99999994f);
    Triangle triangle = geometry->triangles[emissive[low].triangle];
    float3 a = xyz(geometry->positions[triangle.v0]);
    float3 b = xyz(geometry->positions[triangle.v1]);
    float3 c = xyz(geometry->positions[triangle.v2]);
    float root = square_root(s);
    LightPoint point;
    point.position = a * (1.0f - root) + b * (root * (1.0f - v)) + c * (root * v);
    point.normal = normalize3(cross3(b - a, c - a));
    return point;
}

/// glTF's spot falloff between the cones (KHR_lights_punctual), in [0, 1].
static inline float spot_falloff(float cosine, float cos_inner, float cos_outer) {
    float width = m_max(0.001f, cos_inner - cos_outer);
    float x = m_clamp((cosine - cos_outer) / width, 0.0f, 1.0f);
    return x * x;
}

#endif
