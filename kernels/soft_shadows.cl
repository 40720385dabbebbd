// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance from a set's points on the area lights, as vpl_gather, but with rays only where the
// scheduler wants them. Lights are gathered in up to SHADOW_GROUPS groups; for each block of slots
// `block_shadows` says of every group whether to trace (bit g), or that all of it is known to be
// seen (bit 16 + g) or blocked (neither).
//
// `packet_shadows` tells which lanes of a packet saw a light of the group (low 16 bits) and for
// which one was blocked (high 16 bits), SHADOW_GROUPS words a packet; only traced rays count.
#include "connection.h"
#include "counters.h"
#include "shadow_groups.h"

WEFT_KERNEL(soft_shadows)
(PARAMS, SCENE_ARGS, GLOBAL const float* receiver_planes, GLOBAL const uint* block_set,
 GLOBAL const uint* block_shadows, GLOBAL const Vpl* samples, GLOBAL float* irradiance,
 GLOBAL uint* packet_shadows, GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint number = params.first + GLOBAL_ID;
    uint slot = number * (uint)LANES;
    SCENE_MAKE(scene);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slot);
    uint set = (block_set[slot / PACKET_BLOCK] + params.set_rotation) % params.gather_sets;
    uint states = block_shadows[slot / PACKET_BLOCK];
    GLOBAL const Vpl* first = samples + params.list_first + set * params.list_stride;
    WFloat zero = WIDE(0.0f);
    WFloat red = zero;
    WFloat green = zero;
    WFloat blue = zero;
    uint rays = 0u;
    int anything = mask_any(packet.valid) ? 1 : 0;
    for (uint group = 0u; group < params.shadow_groups; ++group) {
        uint seen = 0u;
        uint hidden = 0u;
        int traces = (states >> group & 1u) != 0u ? 1 : 0;
        int open = (states >> (group + 16u) & 1u) != 0u ? 1 : 0;
        uint end = anything != 0 && (traces != 0 || open != 0)
                       ? shadow_group_start(&params, group + 1u)
                       : 0u;
        for (uint i = shadow_group_start(&params, group); i < end; ++i) {
            GLOBAL const Vpl* vpl = first + i;
            float4 flux = vpl->flux;
            if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
            WFloat3 d;
            d.x = packet.position.x - vpl->position.x;
            d.y = packet.position.y - vpl->position.y;
            d.z = packet.position.z - vpl->position.z;
            WMask useful;
            WFloat g = connection(&packet, vpl, VPL_SURFACE, d, &useful);
            if (!mask_any(useful)) continue;
            if (traces != 0) {
                rays += mask_count(useful);
                WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
                hidden |= mask_bits(useful & blocked);
                useful = useful & mask_not(blocked);
                seen |= mask_bits(useful);
            }
            g = SELECT(useful, g, zero);
            red = red + g * flux.x;
            green = green + g * flux.y;
            blue = blue + g * flux.z;
        }
        packet_shadows[number * SHADOW_GROUPS + group] = seen | hidden << 16;
    }
    wide_store(red * params.gather_scale, irradiance, slot);
    wide_store(green * params.gather_scale, irradiance, params.slots + slot);
    wide_store(blue * params.gather_scale, irradiance, 2u * params.slots + slot);
    count_rays(counters + params.counter, rays);
}
