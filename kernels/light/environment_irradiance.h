// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The irradiance of surfaces that see all of an image of the environment on their side, by their
// normal: a map over the octahedron that the host has made
// (host/scene/environment_irradiance.h).
#ifndef WEFT_KERNELS_LIGHT_ENVIRONMENT_IRRADIANCE_H
#define WEFT_KERNELS_LIGHT_ENVIRONMENT_IRRADIANCE_H

#include "kernels/core/maths.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"

// Ratios that are greater come from values that have left the range of floats.
#define GREATEST_RATIO 1e30f

/// The place in [0, 1]^2, as x and y, of a unit vector on the octahedron that is unfolded about the
/// axis y (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
/// Vectors").
static inline float3 octahedral_place(float3 v) {
    float scale = 1.0f / (absolute(v.x) + absolute(v.y) + absolute(v.z));
    float x = v.x * scale;
    float z = v.z * scale;
    if (v.y < 0.0f) {
        float folded = (1.0f - absolute(z)) * (x < 0.0f ? -1.0f : 1.0f);
        z = (1.0f - absolute(x)) * (z < 0.0f ? -1.0f : 1.0f);
        x = folded;
    }
    return f3(0.5f * x + 0.5f, 0.5f * z + 0.5f, 0.0f);
}

/// Irradiance, for a factor of 1 on the image, of a surface with that unit normal.
static inline float3 open_irradiance(GLOBAL const EnvironmentRecord* record,
                                     GLOBAL const float* map, float3 normal) {
    float3 place =
        octahedral_place(f3(dot3(normal, xyz(record->x_axis)), dot3(normal, xyz(record->y_axis)),
                            dot3(normal, xyz(record->z_axis))));
    float edge = (float)(IRRADIANCE_NODES - 1);
    float x = m_clamp(place.x * edge, 0.0f, edge);
    float y = m_clamp(place.y * edge, 0.0f, edge);
    uint column = (uint)m_min(x, edge - 1.0f);
    uint row = (uint)m_min(y, edge - 1.0f);
    float s = x - (float)column;
    float t = y - (float)row;
    GLOBAL const float* upper = map + 3u * (row * IRRADIANCE_NODES + column);
    GLOBAL const float* lower = upper + 3u * IRRADIANCE_NODES;
    float3 a = f3(upper[0], upper[1], upper[2]) * (1.0f - s) + f3(upper[3], upper[4], upper[5]) * s;
    float3 b = f3(lower[0], lower[1], lower[2]) * (1.0f - s) + f3(lower[3], lower[4], lower[5]) * s;
    return a * (1.0f - t) + b * t;
}

/// `expected` over `sampled`: 0 where nothing was sampled, and 1 where light is so bright that
/// neither has a finite value.
static inline float sampling_correction1(float expected, float sampled) {
    if (!(sampled > 0.0f)) return 0.0f;
    float ratio = expected / sampled;
    return ratio < GREATEST_RATIO ? ratio : 1.0f;
}

/// The same by channel.
static inline float3 sampling_correction(float3 expected, float3 sampled) {
    return f3(sampling_correction1(expected.x, sampled.x),
              sampling_correction1(expected.y, sampled.y),
              sampling_correction1(expected.z, sampled.z));
}

#endif
