// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// How surfaces scatter light, whatever their lobe (docs/adding-a-lobe.md): each function here calls
// the one of the lobe that has its name.
//
// Directions are unit vectors in the frame of the surface, about +z, its normal (local_direction,
// to_world): `out` leads to where light goes, to the camera for a path from there, and `in` to
// where it comes from. Both point away from the surface.
#ifndef WEFT_KERNELS_BSDF_BSDF_H
#define WEFT_KERNELS_BSDF_BSDF_H

#include "kernels/bsdf/lambert.h"
#include "kernels/bsdf/lobe.h"

// Each is a case of a switch over the lobe, which returns what the lobe's function of that name
// does. They use the parameters of the functions below by their names.
#define LOBE_FLAGS(NUMBER, name, surface) \
    case LOBE_##NUMBER:                   \
        return name##_flags(bsdf);
#define LOBE_EVAL(NUMBER, name, surface) \
    case LOBE_##NUMBER:                  \
        return name##_eval(bsdf, out, in);
#define LOBE_PDF(NUMBER, name, surface) \
    case LOBE_##NUMBER:                 \
        return name##_pdf(bsdf, out, in);
#define LOBE_SAMPLE(NUMBER, name, surface) \
    case LOBE_##NUMBER:                    \
        return name##_sample(bsdf, out, u, v);
#define LOBE_ALBEDO(NUMBER, name, surface) \
    case LOBE_##NUMBER:                    \
        return name##_albedo(bsdf, out);
#define LOBE_DIFFUSE_ALBEDO(NUMBER, name, surface) \
    case LOBE_##NUMBER:                            \
        return name##_diffuse_albedo(bsdf);

/// What the BSDF does with light: BSDF_*.
static inline uint bsdf_flags(const Bsdf* bsdf) {
    switch (bsdf->lobe) {
        default:
            ALL_LOBES(LOBE_FLAGS)
    }
}

/// Radiance towards `out` per irradiance from `in`; 0 where `in` is not above the surface.
static inline BsdfValue bsdf_eval(const Bsdf* bsdf, float3 out, float3 in) {
    switch (bsdf->lobe) {
        default:
            ALL_LOBES(LOBE_EVAL)
    }
}

/// Pdf with which bsdf_sample chooses `in`, 1/sr; 0 where `in` is not above the surface.
static inline float bsdf_pdf(const Bsdf* bsdf, float3 out, float3 in) {
    switch (bsdf->lobe) {
        default:
            ALL_LOBES(LOBE_PDF)
    }
}

/// Chooses `in` for `out` by u and v, uniform in [0, 1).
static inline BsdfSample bsdf_sample(const Bsdf* bsdf, float3 out, float u, float v) {
    switch (bsdf->lobe) {
        default:
            ALL_LOBES(LOBE_SAMPLE)
    }
}

/// Share of the light towards `out` that the BSDF scatters, by channel, over all directions. Only
/// Russian roulette uses it, so that an estimate is enough for a lobe without a closed form.
static inline float3 bsdf_albedo(const Bsdf* bsdf, float3 out) {
    switch (bsdf->lobe) {
        default:
            ALL_LOBES(LOBE_ALBEDO)
    }
}

/// Albedo of the Lambertian surface that stands for the BSDF where no outgoing direction is known:
/// a mean over all `out`. Black for lobes without BSDF_DIFFUSE.
static inline float3 bsdf_diffuse_albedo(const Bsdf* bsdf) {
    switch (bsdf->lobe) {
        default:
            ALL_LOBES(LOBE_DIFFUSE_ALBEDO)
    }
}

#endif
