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
