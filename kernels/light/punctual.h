// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Point and spot lights have an intensity, W/sr, which falls off between two cones for spot lights.
#ifndef WEFT_KERNELS_LIGHT_PUNCTUAL_H
#define WEFT_KERNELS_LIGHT_PUNCTUAL_H

#include "kernels/light/light_sample.h"

/// glTF's spot falloff between the cones (KHR_lights_punctual), in [0, 1].
static inline float spot_falloff(float cosine, float cos_inner, float cos_outer) {
    float width = m_max(0.001f, cos_inner - cos_outer);
    float x = m_clamp((cosine - cos_outer) / width, 0.0f, 1.0f);
    return x * x;
}

/// Mitsuba's spot falloff, linear with the angle to the axis, in [0, 1]. `angle` is in radians,
/// that of the outer cone `outer`, and between the cones `width`, above 0.
static inline float linear_falloff(float angle, float outer, float width) {
    return m_clamp((outer - angle) / width, 0.0f, 1.0f);
}

/// Share of the intensity in the direction `leaving`, of any length, at that cosine to the axis.
static inline float punctual_falloff(LightRecord light, float3 leaving, float cosine) {
    if (light.kind != EMITTER_SPOT) return 1.0f;
    if (!(light.position.w > 0.0f)) return spot_falloff(cosine, light.cos_inner, light.cos_outer);
    // Not by the arc cosine, which has few digits where a cone is narrow.
    float angle =
        m_atan2(length3(cross3(leaving, xyz(light.axis))), dot3(leaving, xyz(light.axis)));
    return linear_falloff(angle, light.axis.w, light.position.w);
}

/// First segment of a light path, uniform over the cone that is lit; `weight` is 1 over the
/// probability of the light.
static inline EmittedRay emit_from_point(LightRecord light, const EmissionNumbers* numbers,
                                         float weight) {
    float limit = light.kind == EMITTER_SPOT ? light.cos_outer : -1.0f;
    float3 local_vector = cone_direction(numbers->s, numbers->t, limit);
    weight *= M_TWO_PI * (1.0f - limit);
    EmittedRay ray;
    ray.direction = to_world(local_vector, xyz(light.axis));
    weight *= punctual_falloff(light, ray.direction, local_vector.z);
    ray.origin = xyz(light.position);
    ray.flux = xyz(light.power) * weight;
    return ray;
}

/// What the light sends to a surface.
static inline LightSample punctual_at_surface(const RenderParams* params, LightRecord light,
                                              const LitPoint* lit, float3 origin,
                                              float probability) {
    LightSample sample = no_light_sample();
    float3 towards = xyz(light.position) - lit->position;
    if (faces(lit, towards) == 0) return sample;
    float distance = length3(towards);
    sample.in = light_direction_at(params, lit, towards, distance);
    sample.power = xyz(light.power);
    sample.share = sample.in.z / distance / distance / probability *
                   punctual_falloff(light, -towards, -dot3(towards, xyz(light.axis)) / distance);
    sample.origin = origin;
    sample.towards = xyz(light.position) - origin;
    return sample;
}

/// What the light sends to a place, which is `found.distance` away along `found.direction`.
static inline PlaceLight punctual_at_place(const ChosenPoint* chosen, PlaceLight found) {
    float falloff = 1.0f / found.distance / found.distance / chosen->pdf;
    falloff *= punctual_falloff(chosen->light, -found.direction,
                                -dot3(found.direction, xyz(chosen->light.axis)));
    found.irradiance = xyz(chosen->light.power) * falloff;
    return found;
}

#endif
