// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The environment sends radiance from every direction in which nothing lies: the same from all, or
// that of an image. Path tracing finds one that is the same everywhere by scattered rays alone, so
// that next-event estimation never chooses it; an image, of which most light may come from a few
// texels, is found both ways.
#ifndef WEFT_KERNELS_LIGHT_ENVIRONMENT_H
#define WEFT_KERNELS_LIGHT_ENVIRONMENT_H

#include "kernels/light/distant.h"
#include "kernels/light/environment_image.h"

/// Radiance along a ray in that direction, of any length, that meets nothing. For scenes with an
/// environment only.
static inline float3 environment_radiance(const RenderParams* params, const EnvironmentImage* image,
                                          float3 direction) {
    float3 radiance = xyz(params->scene.environment);
    if (HAS(params, FEATURE_IMAGE_ENVIRONMENT)) radiance *= image_radiance(image, direction);
    return radiance;
}

/// 1 where the camera's rays that meet nothing show the environment.
static inline int environment_seen(const RenderParams* params) {
    return HAS(params, FEATURE_ENVIRONMENT) && params->camera.hides_environment == 0u ? 1 : 0;
}

/// What a ray of the camera in that direction that meets nothing shows.
static inline float3 background_radiance(const RenderParams* params, const EnvironmentImage* image,
                                         float3 direction) {
    return environment_seen(params) != 0 ? environment_radiance(params, image, direction)
                                         : f3(0.0f, 0.0f, 0.0f);
}

/// Alpha of a ray of the camera that meets no surface, by the share of light from beyond that media
/// let through, by channel.
static inline float background_alpha(const RenderParams* params, float3 transmittance) {
    if (environment_seen(params) != 0) return 1.0f;
    return 1.0f - (transmittance.x + transmittance.y + transmittance.z) * (1.0f / 3.0f);
}

/// Radiance along a ray in that direction, of any length, that meets nothing. `*pdf` is that, 1/sr,
/// with which next-event estimation samples it where it chooses the environment; 0 where it never
/// does.
static inline float3 environment_met(const RenderParams* params, const EnvironmentImage* image,
                                     float3 direction, float* pdf) {
    float3 radiance = xyz(params->scene.environment);
    *pdf = 0.0f;
    if (!HAS(params, FEATURE_IMAGE_ENVIRONMENT)) return radiance;
    ImagePlace place = image_place(image, direction);
    *pdf = pdf_at_place(image, place);
    return radiance * radiance_at_place(image, place);
}

/// A direction towards the environment, of pdf 1 / SPHERE_SOLID_ANGLE.
static inline float3 environment_direction(float u, float v) {
    return cone_direction(u, v, -1.0f);
}

/// A local direction about +z, the normal of what is lit, for the irradiance by an environment that
/// is the same everywhere: with pdf cos / pi, so that each stands for COSINE_IRRADIANCE times its
/// radiance.
static inline float3 environment_local_direction(float u, float v) {
    return cosine_direction(u, v);
}

/// A direction towards the environment for what is lit from all around, with its radiance.
static inline EnvironmentSample sample_environment(const RenderParams* params,
                                                   const EnvironmentImage* image, float u,
                                                   float v) {
    EnvironmentSample sample;
    if (HAS(params, FEATURE_IMAGE_ENVIRONMENT)) {
        sample = sample_image(image, u, v);
        sample.radiance *= xyz(params->scene.environment);
        return sample;
    }
    sample.direction = environment_direction(u, v);
    sample.radiance = xyz(params->scene.environment);
    sample.pdf = 1.0f / SPHERE_SOLID_ANGLE;
    return sample;
}

/// First segment of a light path; `weight` is 1 over the probability of the light.
static inline EmittedRay emit_from_environment(const RenderParams* params,
                                               const EnvironmentImage* image, LightRecord light,
                                               const EmissionNumbers* numbers, float weight) {
    if (HAS(params, FEATURE_IMAGE_ENVIRONMENT)) {
        EnvironmentSample from = sample_image(image, numbers->s, numbers->t);
        float3 power = from.radiance * xyz(light.power);
        return emit_through_disk(params, power, -from.direction, numbers->u, numbers->v,
                                 weight / from.pdf);
    }
    weight *= SPHERE_SOLID_ANGLE;
    return emit_through_disk(params, xyz(light.power),
                             environment_direction(numbers->s, numbers->t), numbers->u, numbers->v,
                             weight);
}

/// What an image sends to a surface from one direction (u, v).
static inline LightSample environment_at_surface(const RenderParams* params,
                                                 const EnvironmentImage* image, const LitPoint* lit,
                                                 float3 origin, float probability, float u,
                                                 float v) {
    LightSample sample = no_light_sample();
    EnvironmentSample from = sample_environment(params, image, u, v);
    if (faces(lit, from.direction) == 0) return sample;
    sample.in = light_direction_at(params, lit, from.direction, 1.0f);
    sample.power = from.radiance;
    sample.pdf = from.pdf * probability;
    sample.origin = origin;
    sample.towards = from.direction;
    sample.distant = 1;
    return sample;
}

/// A direction of an image in place of a point: its light travels along the point's normal.
/// `*pdf`, the probability of the light, is multiplied with that of the direction.
static inline LightPoint environment_point(const RenderParams* params,
                                           const EnvironmentImage* image, float u, float v,
                                           float* pdf) {
    EnvironmentSample from = sample_environment(params, image, u, v);
    LightPoint point;
    point.position = f3(0.0f, 0.0f, 0.0f);
    point.normal = -from.direction;
    point.radiance = from.radiance;
    point.area = 0.0f;
    point.entry = 0u;
    point.u = 0.0f;
    point.v = 0.0f;
    *pdf *= from.pdf;
    return point;
}

/// What the environment sends to a place from a direction that has been chosen.
static inline PlaceLight environment_at_place(const ChosenPoint* chosen, PlaceLight found) {
    found.direction = -chosen->point.normal;
    found.pdf = chosen->pdf;
    found.irradiance = chosen->point.radiance / chosen->pdf;
    return found;
}

#endif
