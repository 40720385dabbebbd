// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Next-event estimation of path tracing: one light is chosen for a surface point, and one point on
// it. Area lights are also met by scattered rays; both techniques are weighted by the power
// heuristic with exponent 2 (Veach and Guibas 1995).
#ifndef WEFT_KERNELS_PATH_PATH_LIGHTS_H
#define WEFT_KERNELS_PATH_PATH_LIGHTS_H

#include "kernels/bsdf/surface.h"
#include "kernels/bvh/visibility.h"
#include "kernels/light/light.h"

/// Weight of a technique of pdf `own` beside one of pdf `other`.
static inline float power_heuristic(float own, float other) {
    // As a ratio: squares of pdfs overflow.
    float ratio = own >= other ? other / own : own / other;
    float square = ratio * ratio;
    float weight = 1.0f / (1.0f + square);
    return own >= other ? weight : square * weight;
}

/// The surface as functions of lights take it.
static inline LitPoint lit_point(const Surface* surface) {
    LitPoint lit;
    lit.position = surface->position;
    lit.normal = surface->normal;
    lit.shading = surface->shading;
    return lit;
}

/// Irradiance that a sample of a light brings, weighted against scattered rays that may meet the
/// light too; `scattered` is their pdf.
static inline float3 weighted_irradiance(const LightSample* light, float scattered) {
    if (!(light->pdf > 0.0f)) return light->power * light->share;
    float weight = power_heuristic(light->pdf, scattered);
    return light->power * (weight * light->in.z / light->pdf);
}

/// A sample of the light that falls on a surface point. `origin` is that point, moved off.
static inline LightSample sample_lights(const RenderParams* params, const Geometry* geometry,
                                        GLOBAL const LightRecord* lights, uint count,
                                        GLOBAL const EmissiveTriangle* emissive,
                                        const Surface* surface, float3 origin, float choice,
                                        float u, float v) {
    float probability;
    LightRecord light = lights[choose_for_next_event(lights, count, choice, &probability)];
    LitPoint lit = lit_point(surface);
    return light_at_surface(params, geometry, light, emissive, &lit, origin, probability, u, v);
}

#endif
