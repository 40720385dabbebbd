// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Chooses lights and samples what they send: the one place that knows which kinds of light there
// are (docs/adding-a-light.md).
#ifndef WEFT_KERNELS_LIGHT_LIGHT_H
#define WEFT_KERNELS_LIGHT_LIGHT_H

#include "kernels/light/area.h"
#include "kernels/light/distant.h"
#include "kernels/light/environment.h"
#include "kernels/light/light_tree.h"
#include "kernels/light/punctual.h"

#define LIGHT_STRIDE ((uint)(sizeof(LightRecord) / sizeof(float)))

/// Chooses an area light by power with the random number `u`.
static inline uint choose_area_light(GLOBAL const LightRecord* lights, uint count, float u) {
    return find_entry(&lights->area_cumulative, LIGHT_STRIDE, count, u);
}

/// Chooses a light of any kind by power with `*u`, which it rescales for reuse.
static inline uint choose_light(GLOBAL const LightRecord* lights, uint count, float* u) {
    uint chosen = find_entry(&lights->cumulative, LIGHT_STRIDE, count, *u);
    float before = lights[chosen].cumulative - lights[chosen].probability;
    *u = rescale_number(*u, before, lights[chosen].probability);
    return chosen;
}

/// Chooses a light for next-event estimation with `u`; `*probability` receives that of the choice.
static inline uint choose_for_next_event(GLOBAL const LightRecord* lights, uint count, float u,
                                         float* probability) {
    uint chosen = find_entry(&lights->choice_cumulative, LIGHT_STRIDE, count, u);
    *probability = lights[chosen].choice_probability;
    return chosen;
}

/// First segment of a light path: flux is the light's power over the probability of choosing it.
static inline EmittedRay emit_light(const RenderParams* params, const Geometry* geometry,
                                    LightRecord light, GLOBAL const EmissiveTriangle* emissive,
                                    const EnvironmentImage* environment,
                                    const EmissionNumbers* numbers) {
    float weight = 1.0f / light.probability;
    switch (light.kind) {
        case EMITTER_AREA:
            return emit_from_area(params, geometry, light, emissive, numbers, weight);
        case EMITTER_POINT:
        case EMITTER_SPOT:
            return emit_from_point(light, numbers, weight);
        case EMITTER_ENVIRONMENT:
            return emit_from_environment(params, environment, light, numbers, weight);
        case EMITTER_DIRECTIONAL:
        default:
            return emit_from_distant(params, light, numbers, weight);
    }
}

/// What a light that was chosen with that probability sends to a surface, by a point (u, v) of it.
/// `origin` is the surface's point, moved off. Of environments for images only.
static inline LightSample light_at_surface(const RenderParams* params, const Geometry* geometry,
                                           LightRecord light,
                                           GLOBAL const EmissiveTriangle* emissive,
                                           const EnvironmentImage* environment, const LitPoint* lit,
                                           float3 origin, float probability, float u, float v) {
    switch (light.kind) {
        case EMITTER_AREA:
            return area_at_surface(params, geometry, light, emissive, lit, origin, probability, u,
                                   v);
        case EMITTER_DIRECTIONAL:
            return distant_at_surface(params, light, lit, origin, probability);
        case EMITTER_ENVIRONMENT:
            return environment_at_surface(params, environment, lit, origin, probability, u, v);
        case EMITTER_POINT:
        case EMITTER_SPOT:
        default:
            return punctual_at_surface(params, light, lit, origin, probability);
    }
}

/// Point (u, v) of a light that was chosen with that probability. Of environments for images only.
static inline ChosenPoint point_on_light(const RenderParams* params, const Geometry* geometry,
                                         LightRecord light, GLOBAL const EmissiveTriangle* emissive,
                                         const EnvironmentImage* environment, float probability,
                                         float u, float v) {
    ChosenPoint chosen;
    chosen.light = light;
    chosen.pdf = probability;
    chosen.point.position = xyz(light.position);
    chosen.point.normal = f3(0.0f, 0.0f, 0.0f);
    if (light.kind == EMITTER_AREA) {
        chosen.point = sample_emitter(params, geometry, light, emissive, u, v);
        chosen.pdf = probability / chosen.point.area;
    }
    if (HAS(params, FEATURE_IMAGE_ENVIRONMENT) && light.kind == EMITTER_ENVIRONMENT)
        chosen.point = environment_point(params, environment, u, v, &chosen.pdf);
    return chosen;
}

/// 1 where the light has a place: all but those infinitely far away.
static inline int has_place(LightRecord light) {
    return light.kind != EMITTER_DIRECTIONAL && light.kind != EMITTER_ENVIRONMENT ? 1 : 0;
}

/// What a chosen point of a light sends to a place in a medium. Of environments for images only.
static inline PlaceLight light_at_place(const RenderParams* params, const ChosenPoint* chosen,
                                        float3 place) {
    PlaceLight found;
    found.irradiance = f3(0.0f, 0.0f, 0.0f);
    found.pdf = 0.0f;
    found.target = chosen->point.position;
    found.distance = RAY_INFINITY;
    if (HAS(params, FEATURE_IMAGE_ENVIRONMENT) && chosen->light.kind == EMITTER_ENVIRONMENT)
        return environment_at_place(chosen, found);
    if (has_place(chosen->light) == 0) return distant_at_place(chosen, found);
    float3 towards = chosen->point.position - place;
    found.distance = length3(towards);
    found.direction = towards;
    if (!(found.distance > 0.0f)) return found;
    found.direction = towards / found.distance;
    switch (chosen->light.kind) {
        case EMITTER_AREA:
            return area_at_place(params, chosen, found);
        case EMITTER_POINT:
        case EMITTER_SPOT:
        default:
            return punctual_at_place(chosen, found);
    }
}

/// Pdf, 1/sr, with which light samples have the direction of a ray that met an emitting surface
/// after `t`, where its light is chosen: on that triangle, with that normal on the ray's side. 0
/// where they never do.
static inline float met_light_pdf(const RenderParams* params, const Geometry* geometry,
                                  GLOBAL const LightRecord* lights,
                                  GLOBAL const EmissiveTriangle* emissive, uint triangle,
                                  uint instance, float3 normal, float3 direction, float t) {
    uint index = geometry->instances[instance].light;
    if (index == INVALID_INDEX) return 0.0f;
    LightRecord light = lights[index];
    float facing = -dot3(direction, normal);
    if (!(facing > 0.0f)) return 0.0f;
    float area = sampled_area(params, geometry, light, emissive, triangle);
    return area_pdf(area, t, facing);
}

#endif
