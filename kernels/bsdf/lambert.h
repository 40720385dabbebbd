// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Lambert's law: a diffuse surface reflects the same radiance in all directions, which is its
// albedo over pi times the irradiance. Whatever takes a surface to be diffuse takes the law from
// here.
//
// Directions are local: about +z, the normal. `in` leads to where the light comes from.
#ifndef WEFT_BSDF_LAMBERT_H
#define WEFT_BSDF_LAMBERT_H

#include "sampling.h"

/// Radiance that an albedo makes of irradiance 1, of one number: a float, a float3 or a WFloat.
#define LAMBERT_REFLECTANCE(albedo) ((albedo)*M_INV_PI)

/// The albedo with which irradiance and the radiance reflected are the same number.
#define LAMBERT_ALBEDO_OF_ONE M_ONE_PI

/// Radiance per irradiance of an albedo of 1 for light from `in`, 1/sr; 0 from below the surface.
static inline float lambert_eval(float3 in) {
    return in.z > 0.0f ? M_INV_PI : 0.0f;
}

/// Density of lambert_sample, 1/sr.
static inline float lambert_pdf(float3 in) {
    return in.z > 0.0f ? cosine_pdf(in.z) : 0.0f;
}

/// A direction with density cos / pi, by which the weight of a sample is the albedo.
static inline float3 lambert_sample(float u, float v) {
    return cosine_direction(u, v);
}

#endif
