// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Next-event estimation of path tracing: one light is chosen for a surface point, and one point on
// it. Area lights are also met by scattered rays; both ways are weighted by the power heuristic
// with exponent 2 (Veach and Guibas 1995).
#ifndef WEFT_PATH_LIGHTS_H
#define WEFT_PATH_LIGHTS_H

#include "light.h"
#include "surface.h"
#include "visibility.h"

/// Weight of a technique of density `own` beside one of density `other`.
static inline float power_heuristic(float own, float other) {
    // As a ratio: squares of densities overflow.
    if (own >= other) {
        float ratio = other / own;
        return 1.0f / (1.0f + ratio * ratio);
    }
    float ratio = own / other;
    return ratio * ratio / (1.0f + ratio * ratio);
}

/// Light that `u` falls into, and `*probability` of that.
static inline uint choose_for_surface(GLOBAL const LightRecord* lights, uint count, float u,
                                      float* probability) {
    uint chosen = find_entry(&lights->choice_cumulative, LIGHT_STRIDE, count, u);
    *probability = lights[chosen].choice_probability;
    return chosen;
}

// Irradiance that one light sample brings, before its shadow ray from `origin` along `towards`.
typedef struct {
    float3 irradiance;  // 0: nothing to trace
    float3 origin, towards;
    int distant;  // 1: the ray goes on to infinity
} LightSample;

static inline LightSample no_light_sample(void) {
    LightSample sample;
    sample.irradiance = f3(0.0f, 0.0f, 0.0f);
    sample.origin = sample.irradiance;
    sample.towards = sample.irradiance;
    sample.distant = 0;
    return sample;
}

/// 1 where light from `direction` (any length) falls on the outside of both normals.
static inline int faces(const Surface* surface, float3 direction) {
    return dot3(direction, surface->normal) > 0.0f && dot3(direction, surface->shading) > 0.0f ? 1
                                                                                               : 0;
}

static inline LightSample area_light_sample(const RenderParams* params, const Geometry* geometry,
                                            LightRecord light,
                                            GLOBAL const EmissiveTriangle* emissive,
                                            const Surface* surface, float3 origin,
                                            float probability, float u, float v) {
    LightSample sample = no_light_sample();
    LightPoint point = sample_area(geometry, light, emissive, u, v);
    float3 towards = point.position - surface->position;
    if (faces(surface, towards) == 0) return sample;
    float distance = length3(towards);
    float facing = -dot3(towards, point.normal) / distance;
    float3 normal = point.normal;
    if (facing < 0.0f && light.both_sides != 0u) {
        facing = -facing;
        normal = -normal;
    }
    if (!(facing > 0.0f) || !(distance > 0.0f)) return sample;
    float cosine = dot3(towards, surface->shading) / distance;
    float density = (distance / facing) * (distance / light.area) * probability;
    float weight = power_heuristic(density, cosine * 0.318309886f);
    sample.irradiance = xyz(light.power) * (weight * cosine / density);
    float3 target = point.position + normal * surface_offset(point.position, params->scene.extent);
    sample.origin = origin;
    sample.towards = target - origin;
    return sample;
}

static inline LightSample punctual_sample(LightRecord light, const Surface* surface, float3 origin,
                                          float probability) {
    LightSample sample = no_light_sample();
    float3 towards = xyz(light.position) - surface->position;
    if (faces(surface, towards) == 0) return sample;
    float distance = length3(towards);
    float cosine = dot3(towards, surface->shading) / distance;
    float falloff = cosine / distance / distance / probability;
    if (light.kind == EMITTER_SPOT)
        falloff *= spot_falloff(-dot3(towards, xyz(light.axis)) / distance, light.cos_inner,
                                light.cos_outer);
    sample.irradiance = xyz(light.power) * falloff;
    sample.origin = origin;
    sample.towards = xyz(light.position) - origin;
    return sample;
}

static inline LightSample distant_sample(LightRecord light, const Surface* surface, float3 origin,
                                         float probability) {
    LightSample sample = no_light_sample();
    float3 towards = -xyz(light.axis);
    if (faces(surface, towards) == 0) return sample;
    sample.irradiance = xyz(light.power) * (dot3(towards, surface->shading) / probability);
    sample.origin = origin;
    sample.towards = towards;
    sample.distant = 1;
    return sample;
}

/// A sample of the light that falls on a surface point. `origin` is that point, moved off.
static inline LightSample sample_lights(const RenderParams* params, const Geometry* geometry,
                                        GLOBAL const LightRecord* lights, uint count,
                                        GLOBAL const EmissiveTriangle* emissive,
                                        const Surface* surface, float3 origin, float choice,
                                        float u, float v) {
    float probability;
    LightRecord light = lights[choose_for_surface(lights, count, choice, &probability)];
    if (light.kind == EMITTER_AREA)
        return area_light_sample(params, geometry, light, emissive, surface, origin, probability, u,
                                 v);
    if (light.kind == EMITTER_DIRECTIONAL)
        return distant_sample(light, surface, origin, probability);
    return punctual_sample(light, surface, origin, probability);
}

#endif
