// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Next-event estimation of path tracing: one light is chosen for a surface point, and one point on
// it. Area lights, and an image of the environment, are also met by scattered rays; both techniques
// are weighted by the power heuristic with exponent 2 (Veach and Guibas 1995).
#ifndef WEFT_KERNELS_PATH_PATH_LIGHTS_H
#define WEFT_KERNELS_PATH_PATH_LIGHTS_H

#include "kernels/bsdf/surface.h"
#include "kernels/bsdf/surface_maps.h"
#include "kernels/bvh/visibility.h"
#include "kernels/light/light.h"

// What paths meet.
typedef struct {
    Scene scene;
    Geometry geometry;
    GLOBAL const LightRecord* lights;
    GLOBAL const EmissiveTriangle* emissive;
    GLOBAL const LightNode* light_nodes;  // of FEATURE_LIGHT_TREE
    uint light_count;                     // that next-event estimation chooses from
    EnvironmentImage environment;         // of FEATURE_IMAGE_ENVIRONMENT
    const SurfaceTables* tables;          // of materials; 0 where all surfaces are diffuse
} PathScene;

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
    lit.any_side = 0;
    return lit;
}

/// Irradiance that a sample of a light brings, weighted against scattered rays that may meet the
/// light too; `scattered` is their pdf.
static inline float3 weighted_irradiance(const LightSample* light, float scattered) {
    if (!(light->pdf > 0.0f)) return light->power * light->share;
    float weight = power_heuristic(light->pdf, scattered);
    return light->power * (weight * light->in.z / light->pdf);
}

/// Chooses a light for next-event estimation at a surface point by the random number `u`.
/// `*probability` receives that of the choice, which is 0 where no light shines there.
static inline uint choose_light_for(const RenderParams* params, const PathScene* world,
                                    const LitPoint* lit, float u, float* probability) {
    if (HAS(params, FEATURE_LIGHT_TREE))
        return choose_light_at(params, world->light_nodes, lit, u, probability);
    *probability = 1.0f;
    return 0u;
}

/// Probability with which choose_light_for chooses light number `light`.
static inline float probability_at(const RenderParams* params, const PathScene* world,
                                   const LitPoint* lit, uint light) {
    if (!HAS(params, FEATURE_LIGHT_TREE)) return 1.0f;
    return light_probability_at(params, world->light_nodes, lit, world->lights[light].node);
}

/// Index of the environment in the light table, where there is one.
static inline uint environment_index(const RenderParams* params) {
    return params->scene.lights - 1u;
}

/// A sample of the light that falls on a surface point. `origin` is that point, moved off.
static inline LightSample sample_lights(const RenderParams* params, const PathScene* world,
                                        const Surface* surface, float3 origin, float choice,
                                        float u, float v) {
    LitPoint lit = lit_point(surface);
    float probability;
    uint chosen = choose_light_for(params, world, &lit, choice, &probability);
    if (!(probability > 0.0f)) return no_light_sample();
    return light_at_surface(params, &world->geometry, world->lights[chosen], world->emissive,
                            &world->environment, &lit, origin, probability, u, v);
}

#endif
