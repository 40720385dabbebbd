// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Gathers irradiance from a set's samples on area lights, in packets: as vpl_gather.cl does from
// VPLs, with a ray to every sample, but accurate close to area lights too (analytic_area_light.h).
// One work-item for LANES receivers of a set.
#include "kernels/adaptive/sample_sets.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/analytic_area_light.h"
#include "kernels/media/packet_media.h"

/// Adds an area light's samples from `first` on to `light`; returns the number of rays.
static inline uint add_area_light(Scene scene, const RenderParams* params, const Media* media,
                                  const ReceiverPacket* packet,
                                  const PacketEnclosingMedia* enclosing_media, WFloat scale,
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
        add_connection(params, media, packet, enclosing_media, xyz(vpl->position), flux, g * scale,
                       d, number + i, useful & mask_not(blocked), light);
    }
    return rays;
}

WEFT_KERNEL(area_lights)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = (range.first + WORK_ITEM(range)) * (uint)LANES;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    AREA_LIGHTS_MAKE(area_lights);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slots, slot);
    PacketEnclosingMedia enclosing_media =
        load_enclosing_media(&params, &through, receiver_planes, slots, packet.position, slot);
    uint set = receiver_set(&params, block_set, slot);
    uint sets = mask_any(packet.valid) ? receiver_sets(&params) : 0u;
    WideLight light = no_light();
    uint rays = 0u;
    for (uint s = set; s < set + sets; ++s) {
        for (uint l = 0u; l < params.scene.area_lights; ++l) {
            uint number = s * params.sampling.lights.per_set + l * params.sampling.lights.per_light;
            GLOBAL const Vpl* first = samples + number;
            WFloat scale = analytic_scale(&params, &area_lights, l, &packet, samples, s);
            rays += add_area_light(scene, &params, &through, &packet, &enclosing_media, scale,
                                   first, number - set * params.sampling.lights.per_set, &light);
        }
    }
    store_light(&light, params.sampling.gather_scale, slots, slot, irradiance);
    count_rays(counters + range.counter, rays);
}
