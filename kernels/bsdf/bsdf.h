// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// How surfaces scatter light: the one place that knows which lobes there are
// (docs/adding-a-lobe.md).
//
// Directions are unit vectors in the frame of the surface, about +z, its normal (local_direction,
// turn_to): `out` leads to where light goes, to the camera for a path from there, and `in` to where
// it comes from. Both point away from the surface.
#ifndef WEFT_BSDF_BSDF_H
#define WEFT_BSDF_BSDF_H

#include "bsdf/lambert.h"
#include "types.h"

// What lobes do with light. Those that are diffuse send it all over the hemisphere: only their part
// is held by virtual lights, irradiance records and the albedo of the G-buffer.
#define BSDF_DIFFUSE 1u
#define BSDF_REFLECTION 2u

// A surface's way to scatter light.
typedef struct {
    uint lobe;      // LOBE_*
    float3 albedo;  // of LOBE_LAMBERT: share of the light that is reflected, by channel
} Bsdf;

// A value, 1/sr: `colour` times `share`. They are apart because products are rounded: a path
// multiplies what it carries by the colour, then by the light, and by the share last.
typedef struct {
    float3 colour;
    float share;
} BsdfValue;

// A direction that light may come from.
typedef struct {
    float3 in;
    float3 weight;  // value times cosine over density: what a path's throughput is multiplied by
    float pdf;      // density of `in`, 1/sr
    uint flags;     // BSDF_* of the lobe that was sampled
} BsdfSample;

/// What the BSDF does with light: BSDF_*.
static inline uint bsdf_flags(const Bsdf* bsdf) {
    switch (bsdf->lobe) {
        case LOBE_LAMBERT:
        default:
            return BSDF_DIFFUSE | BSDF_REFLECTION;
    }
}

/// Radiance towards `out` per irradiance from `in`.
static inline BsdfValue bsdf_eval(const Bsdf* bsdf, float3 out, float3 in) {
    BsdfValue value;
    switch (bsdf->lobe) {
        case LOBE_LAMBERT:
        default:
            value.colour = bsdf->albedo;
            value.share = lambert_eval(in);
    }
    return value;
}

/// Density with which bsdf_sample chooses `in`, 1/sr.
static inline float bsdf_pdf(const Bsdf* bsdf, float3 out, float3 in) {
    switch (bsdf->lobe) {
        case LOBE_LAMBERT:
        default:
            return lambert_pdf(in);
    }
}

/// Chooses `in` for `out` by u and v, uniform in [0, 1).
static inline BsdfSample bsdf_sample(const Bsdf* bsdf, float3 out, float u, float v) {
    BsdfSample sample;
    switch (bsdf->lobe) {
        case LOBE_LAMBERT:
        default:
            sample.in = lambert_sample(u, v);
            sample.weight = bsdf->albedo;
            sample.pdf = lambert_pdf(sample.in);
            sample.flags = BSDF_DIFFUSE | BSDF_REFLECTION;
    }
    return sample;
}

/// Share of the light towards `out` that the BSDF scatters, by channel, all directions together: by
/// that Russian roulette decides. For a lobe without a closed form an estimate is enough.
static inline float3 bsdf_albedo(const Bsdf* bsdf, float3 out) {
    switch (bsdf->lobe) {
        case LOBE_LAMBERT:
        default:
            return bsdf->albedo;
    }
}

/// The part of it that lobes with BSDF_DIFFUSE scatter.
static inline float3 bsdf_diffuse_albedo(const Bsdf* bsdf) {
    switch (bsdf->lobe) {
        case LOBE_LAMBERT:
        default:
            return bsdf->albedo;
    }
}

#endif
