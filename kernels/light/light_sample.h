// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Structs that the functions of all kinds of light take and return.
#ifndef WEFT_KERNELS_LIGHT_LIGHT_SAMPLE_H
#define WEFT_KERNELS_LIGHT_LIGHT_SAMPLE_H

#include "kernels/bvh/triangle.h"
#include "kernels/core/sampling.h"

// Random numbers in [0, 1) for the start of a light path.
typedef struct {
    float u, v;  // of a point on the light, or on the disk that distant light comes through
    float s, t;  // of a direction
    float rest;  // what the choice of the light has left over
} EmissionNumbers;

// The first segment of a light path.
typedef struct {
    float3 origin, direction;
    float3 flux;  // W
} EmittedRay;

// A point of a surface that is lit; both normals are on the same side.
typedef struct {
    float3 position;
    float3 normal;   // geometric
    float3 shading;  // interpolated
    int any_side;    // 1 where light from below counts as well, and cosines do not
} LitPoint;

// A point on a light with the side it shines to.
typedef struct {
    float3 position, normal;
    float3 radiance;  // of area lights and environments
    float area;       // of area lights: 1 over the pdf per area with which it is chosen
    uint entry;       // of area lights: its EmissiveTriangle, and there:
    float u, v;       // barycentric coordinates, as those of hits
} LightPoint;

// A point on a light, and the pdf with which it was chosen: per area of area lights, 1/sr of
// environments.
typedef struct {
    LightRecord light;
    LightPoint point;
    float pdf;
} ChosenPoint;

// Light that one sample of a light sends to a surface, were nothing in between.
typedef struct {
    float3 power;  // its irradiance there is power in.z / pdf, or power * share where pdf is 0
    float share;   // 0 where nothing comes
    float pdf;     // of `in`, 1/sr; 0 where no scattered ray can meet the light
    float3 in;     // where it comes from: light_direction_at
    float3 origin, towards;  // shadow ray
    int distant;             // 1: that goes on to infinity
} LightSample;

// Light that a chosen point of a light sends to a place in a medium, were nothing in between.
typedef struct {
    float3 irradiance;  // over the pdf of the choice by next-event estimation
    float3 direction;   // from there, unit
    float3 target;      // where shadow rays end
    float distance;     // RAY_INFINITY for distant lights
    float pdf;          // of its direction, 1/sr; 0 where no scattered ray can meet the light
} PlaceLight;

/// 1 where light from `direction` (any length) falls on the outside of both normals.
static inline int faces(const LitPoint* lit, float3 direction) {
    if (lit->any_side != 0) return 1;
    return dot3(direction, lit->normal) > 0.0f && dot3(direction, lit->shading) > 0.0f ? 1 : 0;
}

/// Unit direction of `towards`, which is `length` long, in the frame of the shading normal. Without
/// FEATURE_LOBES nothing asks for x and y, which are 0.
static inline float3 light_direction_at(const RenderParams* params, const LitPoint* lit,
                                        float3 towards, float length) {
    if (lit->any_side != 0) return f3(0.0f, 0.0f, 1.0f);
    if (HAS(params, FEATURE_LOBES)) return local_direction(towards, lit->shading) / length;
    return f3(0.0f, 0.0f, dot3(towards, lit->shading) / length);
}

static inline LightSample no_light_sample(void) {
    LightSample sample;
    sample.power = f3(0.0f, 0.0f, 0.0f);
    sample.share = 0.0f;
    sample.pdf = 0.0f;
    sample.in = sample.power;
    sample.origin = sample.power;
    sample.towards = sample.power;
    sample.distant = 0;
    return sample;
}

#endif
