// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The environment sends the same radiance from every direction in which nothing lies. Path tracing
// finds it by scattered rays alone, so that next-event estimation never chooses it.
#ifndef WEFT_KERNELS_LIGHT_ENVIRONMENT_H
#define WEFT_KERNELS_LIGHT_ENVIRONMENT_H

#include "kernels/light/distant.h"

#define SPHERE_SOLID_ANGLE 12.5663706f  // 4 pi

/// Radiance along a ray in that direction that meets nothing. For scenes with an environment only.
static inline float3 environment_radiance(const RenderParams* params, float3 direction) {
    return xyz(params->scene.environment);
}

/// 1 where the camera's rays that meet nothing show the environment.
static inline int environment_seen(const RenderParams* params) {
    return HAS(params, FEATURE_ENVIRONMENT) && params->camera.hides_environment == 0u ? 1 : 0;
}

/// What a ray of the camera in that direction that meets nothing shows.
static inline float3 background_radiance(const RenderParams* params, float3 direction) {
    return environment_seen(params) != 0 ? environment_radiance(params, direction)
                                         : f3(0.0f, 0.0f, 0.0f);
}

/// Alpha of a ray of the camera that meets no surface, by the share of light from beyond that media
/// let through, by channel.
static inline float background_alpha(const RenderParams* params, float3 transmittance) {
    if (environment_seen(params) != 0) return 1.0f;
    return 1.0f - (transmittance.x + transmittance.y + transmittance.z) * (1.0f / 3.0f);
}

/// A direction towards the environment, of pdf 1 / SPHERE_SOLID_ANGLE.
static inline float3 environment_direction(float u, float v) {
    return cone_direction(u, v, -1.0f);
}

/// A local direction about +z, the normal of what is lit, for the irradiance by the environment:
/// with pdf cos / pi, so that each stands for COSINE_IRRADIANCE times its radiance.
static inline float3 environment_local_direction(float u, float v) {
    return cosine_direction(u, v);
}

/// First segment of a light path; `weight` is 1 over the probability of the light.
static inline EmittedRay emit_from_environment(const RenderParams* params, LightRecord light,
                                               const EmissionNumbers* numbers, float weight) {
    weight *= SPHERE_SOLID_ANGLE;
    return emit_through_disk(params, xyz(light.power),
                             environment_direction(numbers->s, numbers->t), numbers->u, numbers->v,
                             weight);
}

#endif
