// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance from a set's samples on area lights, in packets: as vpl_gather makes it of VPLs, with
// a ray to every sample, but right close to a lamp too (near_lamp.h).
#include "counters.h"
#include "near_lamp.h"
#include "packet_media.h"

/// Adds a lamp's samples from `first` on to `light`; returns the number of rays.
static inline uint add_lamp(Scene scene, const Params* params, const Media* media,
                            const ReceiverPacket* packet, const PacketInside* inside, WFloat scale,
                            GLOBAL const Vpl* first, uint number, WideLight* light) {
    uint rays = 0u;
    for (uint i = 0u; i < params->samples_per_light; ++i) {
        GLOBAL const Vpl* vpl = first + i;
        float4 flux = vpl->flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        WFloat3 d = from_vpl(packet, vpl);
        WMask useful;
        WFloat g = connection(packet, vpl, VPL_SURFACE, d, &useful);
        if (!mask_any(useful)) continue;
        rays += mask_count(useful);
        WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
        add_connection(params, media, packet, inside, xyz(vpl->position), flux, g * scale, d,
                       number + i, useful & mask_not(blocked), light);
    }
    return rays;
}

WEFT_KERNEL(area_lights)
(PARAMS, SCENE_ARGS, MEDIA_ARGS, LAMP_ARGS, GLOBAL const float* receiver_planes,
 GLOBAL const uint* block_set, GLOBAL const Vpl* samples, GLOBAL float* irradiance,
 GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint slot = (params.first + GLOBAL_ID) * (uint)LANES;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    LAMP_MAKE(lamps);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slot);
    PacketInside inside = load_inside(&params, &through, receiver_planes, packet.position, slot);
    uint set = (block_set[slot / PACKET_BLOCK] + params.set_rotation) % params.gather_sets;
    uint sets = mask_any(packet.valid) ? params.list_length / params.samples_per_set : 0u;
    WideLight light = no_light();
    uint rays = 0u;
    for (uint s = set; s < set + sets; ++s) {
        for (uint l = 0u; l < params.sampled_lights; ++l) {
            uint number = s * params.samples_per_set + l * params.samples_per_light;
            GLOBAL const Vpl* first = samples + number;
            WFloat scale = near_lamp_scale(&params, &lamps, l, &packet, samples, s);
            rays += add_lamp(scene, &params, &through, &packet, &inside, scale, first,
                             number - set * params.samples_per_set, &light);
        }
    }
    store_light(&params, &light, params.gather_scale, slot, irradiance);
    count_rays(counters + params.counter, rays);
}
