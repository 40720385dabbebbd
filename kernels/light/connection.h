// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Connections of LANES receivers with one virtual light: their geometry terms.
#ifndef WEFT_KERNELS_LIGHT_CONNECTION_H
#define WEFT_KERNELS_LIGHT_CONNECTION_H

#include "kernels/bsdf/lambert.h"
#include "kernels/bvh/trace.h"
#include "kernels/core/receivers.h"
#include "kernels/core/wide_maths.h"

// The lanes' receivers.
typedef struct {
    WFloat3 position, shading, normal;
    WMask valid;
} ReceiverPacket;

static inline ReceiverPacket load_receivers(const RenderParams* params, GLOBAL const float* planes,
                                            uint stride, uint slot) {
    ReceiverPacket packet;
    packet.position.x = wide_load(planes, RECEIVER_X * stride + slot);
    packet.position.y = wide_load(planes, RECEIVER_Y * stride + slot);
    packet.position.z = wide_load(planes, RECEIVER_Z * stride + slot);
    packet.shading.x = wide_load(planes, RECEIVER_SHADING_X * stride + slot);
    packet.shading.y = wide_load(planes, RECEIVER_SHADING_Y * stride + slot);
    packet.shading.z = wide_load(planes, RECEIVER_SHADING_Z * stride + slot);
    packet.normal = packet.shading;
    if (HAS(params, FEATURE_SMOOTH_NORMALS)) {
        packet.normal.x = wide_load(planes, RECEIVER_NORMAL_X * stride + slot);
        packet.normal.y = wide_load(planes, RECEIVER_NORMAL_Y * stride + slot);
        packet.normal.z = wide_load(planes, RECEIVER_NORMAL_Z * stride + slot);
    }
    packet.valid = wide_load(planes, RECEIVER_VALID * stride + slot) > WIDE(0.0f);
    return packet;
}

static inline WFloat wide_dot(WFloat3 a, WFloat3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline WFloat wide_dot_scalar(WFloat3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// linear_falloff per lane, along `way` from the light, whose part along its axis is `along`.
static inline WFloat wide_linear_spot(WFloat3 way, float3 axis, WFloat along, float outer,
                                      float width) {
    WFloat x = way.y * axis.z - way.z * axis.y;
    WFloat y = way.z * axis.x - way.x * axis.z;
    WFloat z = way.x * axis.y - way.y * axis.x;
    WFloat across = wide_square_root(x * x + y * y + z * z);
    WFloat share = (WIDE(outer) - wide_upper_angle(across, along)) * (1.0f / width);
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    share = VMAX(share, zero);
    return VMIN(share, one);
}

/// spot_falloff per lane.
static inline WFloat wide_cosine_spot(WFloat cosine, float cos_inner, float cos_outer) {
    float width = m_max(0.001f, cos_inner - cos_outer);
    WFloat x = (cosine - cos_outer) * (1.0f / width);
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    x = VMAX(x, zero);
    x = VMIN(x, one);
    return x * x;
}

/// Falloff of a spot light per lane, along `way` from the light, whose part along its axis is
/// `along` and whose cosine to it is `cosine`.
static inline WFloat wide_spot(GLOBAL const Vpl* vpl, WFloat3 way, WFloat along, WFloat cosine) {
    if (vpl->cone.z > 0.0f)
        return wide_linear_spot(way, xyz(vpl->normal), along, vpl->cone.x, vpl->cone.z);
    return wide_cosine_spot(cosine, vpl->cone.x, vpl->cone.y);
}

/// phase_function per lane, of the cosine between the directions of travel.
static inline WFloat wide_phase(WFloat g, WFloat cosine) {
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    WFloat size = VMAX(g, -g);
    WFloat ahead = SELECT(g < zero, -cosine, cosine);
    WFloat turned = one - ahead;
    turned = VMAX(turned, zero);
    WFloat rest = one - size;
    WFloat square = rest * rest + size * turned * 2.0f;
    return (rest * (one + size)) / (square * wide_square_root(square) * 12.5663706f);
}

/// From the VPL to every receiver.
static inline WFloat3 from_vpl(const ReceiverPacket* packet, GLOBAL const Vpl* vpl) {
    WFloat3 d;
    d.x = packet->position.x - vpl->position.x;
    d.y = packet->position.y - vpl->position.y;
    d.z = packet->position.z - vpl->position.z;
    return d;
}

/// Geometry term of the connection for every lane, with the VPL's bound. It holds in the lanes of
/// `useful`; the others cannot be lit. `d` leads from the VPL to the receivers.
static inline WFloat connection(const ReceiverPacket* packet, GLOBAL const Vpl* vpl, uint kind,
                                WFloat3 d, WMask* useful) {
    WFloat zero = WIDE(0.0f);
    WFloat square = wide_dot(d, d);
    WFloat receiver = -wide_dot(d, packet->shading);
    WFloat geometric = -wide_dot(d, packet->normal);
    WFloat emitter = wide_dot_scalar(d, xyz(vpl->normal));
    *useful = packet->valid & (receiver > zero) & (geometric > zero);
    if (kind == VPL_SURFACE) {
        *useful = *useful & (emitter > zero);
        WFloat g = (emitter / square) * (receiver / square);
        WFloat bound = WIDE(vpl->position.w);
        return SELECT(g < bound, g, bound);
    }
    WFloat distance = wide_square_root(square);
    WFloat g = receiver / (square * distance);
    if (kind == VPL_MEDIUM) {
        // Bounded by what a VPL on a surface could bring, whose flux is stored over pi.
        WFloat bound = WIDE(LAMBERT_REFLECTANCE(vpl->position.w));
        g = g * wide_phase(WIDE(vpl->cone.x), emitter / distance);
        return SELECT(g < bound, g, bound);
    }
    if (kind == VPL_SPOT) {
        g = g * wide_spot(vpl, d, emitter, emitter / distance);
        *useful = *useful & (g > zero);
    }
    return g;
}

/// The level below which roulette decides, for every lane: `roulette` times the mean, over a list
/// of VPLs, of the luminance that each adds where nothing lies between.
static inline WFloat roulette_level(float roulette, const ReceiverPacket* packet,
                                    GLOBAL const Vpl* vpl, uint count) {
    WFloat zero = WIDE(0.0f);
    WFloat sum = zero;
    for (uint i = 0u; i < count; ++i, ++vpl) {
        float weight = luminance(xyz(vpl->flux));
        if (!(weight > 0.0f)) continue;
        WMask useful;
        WFloat g = connection(packet, vpl, as_bits(vpl->normal.w), from_vpl(packet, vpl), &useful);
        sum = sum + SELECT(useful, g * weight, zero);
    }
    return sum * (roulette / (float)count);
}

#endif
