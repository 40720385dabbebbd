// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance from a set's samples on area lights, in packets: as vpl_gather makes it of VPLs, with
// a ray to every sample, but right close to a lamp too (near_lamp.h).
#include "kernels/adaptive/sample_sets.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/near_lamp.h"
#include "kernels/media/packet_media.h"

/// Adds a lamp's samples from `first` on to `light`; returns the number of rays.
static inline uint add_lamp(Scene scene, const RenderParams* params, const Media* media,
                            const ReceiverPacket* packet, const PacketInside* inside, WFloat scale,
                            GLOBAL const Vpl* first, uint number, WideLight* light) {
    uint rays = 0u;
    for (uint i = 0u; i < params->sampling.lights.per_light; ++i) {
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
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = (range.first + WORK_ITEM(range)) * (uint)LANES;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    LAMP_MAKE(lamps);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slots, slot);
    PacketInside inside =
        load_inside(&params, &through, receiver_planes, slots, packet.position, slot);
    uint set = receiver_set(&params, block_set, slot);
    uint sets = mask_any(packet.valid) ? receiver_sets(&params) : 0u;
    WideLight light = no_light();
    uint rays = 0u;
    for (uint s = set; s < set + sets; ++s) {
        for (uint l = 0u; l < params.scene.area_lights; ++l) {
            uint number = s * params.sampling.lights.per_set + l * params.sampling.lights.per_light;
            GLOBAL const Vpl* first = samples + number;
            WFloat scale = near_lamp_scale(&params, &lamps, l, &packet, samples, s);
            rays += add_lamp(scene, &params, &through, &packet, &inside, scale, first,
                             number - set * params.sampling.lights.per_set, &light);
        }
    }
    store_light(&light, params.sampling.gather_scale, slots, slot, irradiance);
    count_rays(counters + range.counter, rays);
}
