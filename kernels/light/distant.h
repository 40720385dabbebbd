// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Directional lights send parallel light from infinitely far away; their power is its irradiance.
#ifndef WEFT_KERNELS_LIGHT_DISTANT_H
#define WEFT_KERNELS_LIGHT_DISTANT_H

#include "kernels/light/light_sample.h"

/// Where the light comes from, a unit vector.
static inline float3 distant_direction(LightRecord light) {
    return -xyz(light.axis);
}

/// Light that travels along `direction` and has `power` per area across it: through a point of the
/// disk that the scene's bounding sphere fills, from outside of it.
static inline EmittedRay emit_through_disk(const RenderParams* params, float3 power,
                                           float3 direction, float u, float v, float weight) {
    float radius = params->scene.bounding_sphere.w;
    float x, y;
    concentric_disk(u, v, &x, &y);
    float3 disk = to_world(f3(x, y, 0.0f), direction);
    EmittedRay ray;
    ray.direction = direction;
    ray.origin = xyz(params->scene.bounding_sphere) + (disk - direction * 1.5f) * radius;
    ray.flux = power * (weight * M_ONE_PI * radius * radius);
    return ray;
}

/// First segment of a light path; `weight` is 1 over the probability of the light.
static inline EmittedRay emit_from_distant(const RenderParams* params, LightRecord light,
                                           const EmissionNumbers* numbers, float weight) {
    return emit_through_disk(params, xyz(light.power), xyz(light.axis), numbers->u, numbers->v,
                             weight);
}

/// What the light sends to a surface.
static inline LightSample distant_at_surface(const RenderParams* params, LightRecord light,
                                             const LitPoint* lit, float3 origin,
                                             float probability) {
    LightSample sample = no_light_sample();
    float3 towards = distant_direction(light);
    if (faces(lit, towards) == 0) return sample;
    sample.in = light_direction_at(params, lit, towards, 1.0f);
    sample.power = xyz(light.power);
    sample.share = sample.in.z / probability;
    sample.origin = origin;
    sample.towards = towards;
    sample.distant = 1;
    return sample;
}

/// What the light sends to a place.
static inline PlaceLight distant_at_place(const ChosenPoint* chosen, PlaceLight found) {
    found.direction = distant_direction(chosen->light);
    found.irradiance = xyz(chosen->light.power) / chosen->pdf;
    return found;
}

#endif
