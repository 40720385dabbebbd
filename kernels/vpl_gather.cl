// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance from a set's VPLs, in packets: LANES pixels of one set connect to one VPL at a time.
// Serves indirect VPLs, points on area lights and punctual lights alike; the launch says which
// stretch of the buffer belongs to a set.
#include "counters.h"
#include "receivers.h"
#include "trace.h"

// The lanes' receivers.
typedef struct {
    WFloat3 position, shading, normal;
    WMask valid;
} ReceiverPacket;

static inline ReceiverPacket load_receivers(const Params* params, GLOBAL const float* planes,
                                            uint slot) {
    ReceiverPacket packet;
    uint stride = params->slots;
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

/// Falloff of spot lights per lane; see spot_falloff.
static inline WFloat wide_spot(WFloat cosine, float cos_inner, float cos_outer) {
    float width = m_max(0.001f, cos_inner - cos_outer);
    WFloat x = (cosine - cos_outer) * (1.0f / width);
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    x = VMAX(x, zero);
    x = VMIN(x, one);
    return x * x;
}

/// Geometry term of the connection for every lane, 0 where it carries nothing. `d` leads from the
/// VPL to the receivers.
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
    if (kind == VPL_SPOT) {
        g = g * wide_spot(emitter / distance, vpl->cone.x, vpl->cone.y);
        *useful = *useful & (g > zero);
    }
    return g;
}

WEFT_KERNEL(vpl_gather)
(PARAMS, SCENE_ARGS, GLOBAL const float* receiver_planes, GLOBAL const uint* block_set,
 GLOBAL const Vpl* vpls, GLOBAL float* irradiance, GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint slot = (params.first + GLOBAL_ID) * (uint)LANES;
    SCENE_MAKE(scene);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slot);
    uint set = (block_set[slot / PACKET_BLOCK] + params.set_rotation) % params.gather_sets;
    GLOBAL const Vpl* vpl = vpls + params.list_first + set * params.list_stride;
    WFloat zero = WIDE(0.0f);
    WFloat red = zero;
    WFloat green = zero;
    WFloat blue = zero;
    uint rays = 0u;
    uint count = mask_any(packet.valid) ? params.list_length : 0u;
    for (uint i = 0u; i < count; ++i, ++vpl) {
        float4 flux = vpl->flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        WFloat3 d;
        d.x = packet.position.x - vpl->position.x;
        d.y = packet.position.y - vpl->position.y;
        d.z = packet.position.z - vpl->position.z;
        WMask useful;
        WFloat g = connection(&packet, vpl, as_bits(vpl->normal.w), d, &useful);
        if (!mask_any(useful)) continue;
        rays += mask_count(useful);
        WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
        g = SELECT(useful & mask_not(blocked), g, zero);
        red = red + g * flux.x;
        green = green + g * flux.y;
        blue = blue + g * flux.z;
    }
    wide_store(red * params.gather_scale, irradiance, slot);
    wide_store(green * params.gather_scale, irradiance, params.slots + slot);
    wide_store(blue * params.gather_scale, irradiance, 2u * params.slots + slot);
    count_rays(counters + params.counter, rays);
}
