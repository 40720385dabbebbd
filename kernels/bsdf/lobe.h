// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Structs of all lobes: the parameters at one point of a surface, and what a lobe's functions
// return (bsdf/bsdf.h).
#ifndef WEFT_KERNELS_BSDF_LOBE_H
#define WEFT_KERNELS_BSDF_LOBE_H

#include "kernels/bsdf/lobes.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

// Numbers of the lobes.
#define LOBE_ENUMERATOR(NUMBER, name, surface) LOBE_##NUMBER,
enum { ALL_LOBES(LOBE_ENUMERATOR) LOBE_COUNT };

// What lobes do with light. Diffuse ones scatter it over the whole hemisphere: virtual lights,
// irradiance records and the albedo of the G-buffer hold only their part.
#define BSDF_DIFFUSE 1u
#define BSDF_REFLECTION 2u
#define BSDF_TRANSMISSION 4u
// Light of one direction: there is no value, and the pdf of a sample is written as 0.
#define BSDF_DELTA 8u

// A surface's way to scatter light.
typedef struct {
    uint lobe;          // LOBE_*
    float3 albedo;      // colour; of Lambert's lobe the share of the light that is reflected
    float4 parameters;  // of lobes other than Lambert's: see MaterialRecord
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
    float3 weight;  // value times cosine over pdf: what a path's throughput is multiplied by
    float pdf;      // of `in`, 1/sr
    uint flags;     // BSDF_* of the lobe that was sampled
} BsdfSample;

/// A sample from `in` of which no light comes.
static inline BsdfSample no_sample(float3 in) {
    BsdfSample sample;
    sample.in = in;
    sample.weight = f3(0.0f, 0.0f, 0.0f);
    sample.pdf = 0.0f;
    sample.flags = 0u;
    return sample;
}

#endif
