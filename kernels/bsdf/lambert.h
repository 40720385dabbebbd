// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Lambert's law: a diffuse surface reflects the same radiance in all directions, which is its
// albedo over pi times the irradiance. Whatever takes a surface to be diffuse takes the law from
// here.
#ifndef WEFT_KERNELS_BSDF_LAMBERT_H
#define WEFT_KERNELS_BSDF_LAMBERT_H

#include "kernels/bsdf/lobe.h"
#include "kernels/core/sampling.h"

/// Radiance that a surface reflects by irradiance 1; its albedo is a float, a float3 or a WFloat.
#define LAMBERT_REFLECTANCE(albedo) ((albedo)*M_INV_PI)

/// The albedo with which irradiance and the radiance reflected are the same number.
#define LAMBERT_ALBEDO_OF_ONE M_ONE_PI

static inline uint lambert_flags(const Bsdf* bsdf) {
    return BSDF_DIFFUSE | BSDF_REFLECTION;
}

static inline BsdfValue lambert_eval(const Bsdf* bsdf, float3 out, float3 in) {
    BsdfValue value;
    value.colour = bsdf->albedo;
    value.share = in.z > 0.0f ? M_INV_PI : 0.0f;
    return value;
}

static inline float lambert_pdf(const Bsdf* bsdf, float3 out, float3 in) {
    return in.z > 0.0f ? cosine_pdf(in.z) : 0.0f;
}

/// Directions have the pdf cos / pi, by which the weight is the albedo.
static inline BsdfSample lambert_sample(const Bsdf* bsdf, float3 out, float u, float v) {
    BsdfSample sample;
    sample.in = cosine_direction(u, v);
    sample.weight = bsdf->albedo;
    sample.pdf = lambert_pdf(bsdf, out, sample.in);
    sample.flags = lambert_flags(bsdf);
    return sample;
}

static inline float3 lambert_albedo(const Bsdf* bsdf, float3 out) {
    return bsdf->albedo;
}

static inline float3 lambert_diffuse_albedo(const Bsdf* bsdf) {
    return bsdf->albedo;
}

#endif
