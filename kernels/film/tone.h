// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Tone curves: from linear colours of a scene to linear colours that a display can show. Kernels
// and the host (host/image/tone.cpp) use the same functions.
#ifndef WEFT_KERNELS_FILM_TONE_H
#define WEFT_KERNELS_FILM_TONE_H

#include "kernels/core/maths.h"
#include "kernels/core/vector.h"
#include "kernels/film/tone_curves.h"

// Every curve is flat long before; its square is still a float.
#define TONE_LARGEST 1048576.0f
// Logarithms to base 2 between which AgX tells light apart: 10 stops below middle grey, 0.18, and
// 6.5 above it.
#define AGX_LOWEST (-12.47393f)
#define AGX_HIGHEST 4.026069f
#define M_LOG2_E 1.44269504f

/// A channel as the curves take it: NaN and what is negative are 0.
static inline float tone_input(float x) {
    return x > 0.0f ? m_min(x, TONE_LARGEST) : 0.0f;
}

/// The product with the matrix of these rows.
static inline float3 tone_matrix(float3 x, float3 red, float3 green, float3 blue) {
    return f3(dot3(red, x), dot3(green, x), dot3(blue, x));
}

/// K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2015): a fit of the reference rendering and
/// output transforms of ACES for sRGB displays, by channel. 1 from 7.24 on.
static inline float filmic_curve(float x) {
    return m_min(1.0f, x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f));
}

/// B. Wrensch's fit ("Minimal AgX Implementation", 2023) of the contrast curve of T. Sobotka's AgX,
/// from the share of the range of logarithms to a value for a display of gamma 2.2. It is slightly
/// below 0 at 0, where colours are cut off.
static inline float agx_contrast(float x) {
    float x2 = x * x;
    float x4 = x2 * x2;
    return 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 +
           0.1191f * x - 0.00232f;
}

static inline float agx_channel(float x) {
    float stops = m_clamp(m_log(x) * M_LOG2_E, AGX_LOWEST, AGX_HIGHEST);
    return agx_contrast((stops - AGX_LOWEST) / (AGX_HIGHEST - AGX_LOWEST));
}

static inline float agx_linear(float value) {
    return m_pow(m_max(value, 0.0f), 2.2f);
}

/// AgX as Blender 4 has it, without a look ("base"), in the form of Google's Filament: in Rec.2020,
/// with colours moved towards grey before the curve and back by less after it, so that bright
/// saturated light turns white as it does on film. The matrices to Rec.2020 and back are those of
/// ITU-R BT.2407, with as many digits as keep grey grey.
static inline float3 agx_toned(float3 x) {
    float3 wide =
        tone_matrix(x, f3(0.6274039f, 0.3292830f, 0.0433131f),
                    f3(0.0690973f, 0.9195404f, 0.0113623f), f3(0.0163914f, 0.0880133f, 0.8955953f));
    float3 inset = tone_matrix(wide, f3(0.856627153f, 0.0951212405f, 0.0482516061f),
                               f3(0.137318973f, 0.761241991f, 0.101439036f),
                               f3(0.11189821f, 0.0767994186f, 0.811302368f));
    float3 curved = f3(agx_channel(inset.x), agx_channel(inset.y), agx_channel(inset.z));
    float3 outset = tone_matrix(curved, f3(1.12710058f, -0.110606643f, -0.0164939387f),
                                f3(-0.141329763f, 1.15782370f, -0.0164939387f),
                                f3(-0.141329763f, -0.110606643f, 1.25193641f));
    float3 linear = f3(agx_linear(outset.x), agx_linear(outset.y), agx_linear(outset.z));
    float3 shown = tone_matrix(linear, f3(1.6604910f, -0.5876411f, -0.0728499f),
                               f3(-0.1245505f, 1.1328999f, -0.0083494f),
                               f3(-0.0181508f, -0.1005789f, 1.1187297f));
    return f3(m_clamp(shown.x, 0.0f, 1.0f), m_clamp(shown.y, 0.0f, 1.0f),
              m_clamp(shown.z, 0.0f, 1.0f));
}

/// An exposed colour under a curve (TONE_*); within [0, 1] but for TONE_NONE, which leaves it as it
/// is.
static inline float3 toned(uint curve, float3 colour) {
    if (curve == TONE_NONE) return colour;
    float3 x = f3(tone_input(colour.x), tone_input(colour.y), tone_input(colour.z));
    if (curve == TONE_AGX) return agx_toned(x);
    return f3(filmic_curve(x.x), filmic_curve(x.y), filmic_curve(x.z));
}

#endif
