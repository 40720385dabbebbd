// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Single receivers: what kernels that trace one ray at a time read, and where they add light.
#ifndef WEFT_KERNELS_CORE_RECEIVER_VALUES_H
#define WEFT_KERNELS_CORE_RECEIVER_VALUES_H

#include "kernels/core/receivers.h"
#include "kernels/core/vector.h"

/// A vector of the receiver of `slot`, whose x is in plane `first`.
static inline float3 receiver_vector(GLOBAL const float* planes, uint first, uint stride,
                                     uint slot) {
    return f3(planes[first * stride + slot], planes[(first + 1u) * stride + slot],
              planes[(first + 2u) * stride + slot]);
}

/// Adds to the irradiance of `slot`, three planes of `stride` floats.
static inline void add_irradiance(GLOBAL float* irradiance, uint stride, uint slot, float3 e) {
    irradiance[slot] += e.x;
    irradiance[stride + slot] += e.y;
    irradiance[2u * stride + slot] += e.z;
}

#endif
