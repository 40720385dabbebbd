// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Gathers irradiance from a set's VPLs, in packets: LANES receivers of one set connect to one VPL
// at a time. Serves indirect VPLs, points on area lights and punctual lights alike; `list` says
// which part of the buffer belongs to a set. One work-item for LANES receivers.
//
// `by_chance` tells which VPLs are traced: with 0 all, with 1 those that have survived the roulette
// of their block (vpl_roulette.cl). Else it has the bits of a float, the share of the mean
// contribution below which each receiver decides by itself. That is for sequences, where the
// receivers of a block change from image to image. A VPL's random number is the same for all
// receivers, so that the error of roulette has no noise: it is smooth but for steps of the size of
// one small contribution.
//
// With `adds` the light is added to the irradiance that is there, without it, it takes its place.
#include "kernels/adaptive/sample_sets.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/connection.h"
#include "kernels/light/vpl_survival.h"
#include "kernels/media/packet_media.h"

WEFT_KERNEL(vpl_gather)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = (range.first + WORK_ITEM(range)) * (uint)LANES;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slots, slot);
    PacketEnclosingMedia enclosing_media =
        load_enclosing_media(&params, &through, receiver_planes, slots, packet.position, slot);
    uint set = receiver_set(&params, block_set, slot);
    GLOBAL const Vpl* vpl = vpls + list.first + set * list.stride;
    WideLight light = no_light();
    uint rays = 0u;
    uint count = mask_any(packet.valid) ? list.length : 0u;
    GLOBAL const uint* survivors = survival;
    int by_block = by_chance == 1u ? 1 : 0;
    float roulette = by_block != 0 ? 0.0f : from_bits(by_chance);
    WFloat level = WIDE(0.0f);
    if (roulette > 0.0f && count > 0u) level = roulette_level(roulette, &packet, vpl, count);
    if (by_block != 0) survivors += slot / PACKET_BLOCK * SURVIVAL_WORDS(list.length);
    for (uint i = 0u; i < count; ++i, ++vpl) {
        float weight = by_block != 0 ? survival_weight(survivors, i) : 1.0f;
        if (weight <= 0.0f) continue;
        float4 flux = vpl->flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        WFloat3 d = from_vpl(&packet, vpl);
        WMask useful;
        WFloat g = connection(&packet, vpl, as_bits(vpl->normal.w), d, &useful);
        if (roulette > 0.0f) {
            // A contribution below the level survives in proportion to it, and is the level then.
            WFloat least = level / luminance(xyz(flux));
            useful = useful & (g >= least * flux.w);
            g = VMAX(g, least);
        }
        if (!mask_any(useful)) continue;
        rays += mask_count(useful);
        WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
        add_connection(&params, &through, &packet, &enclosing_media, xyz(vpl->position), flux,
                       g * weight, d, i, useful & mask_not(blocked), &light);
    }
    if (adds != 0u)
        add_stored_light(&light, params.sampling.gather_scale, slots, slot, irradiance);
    else
        store_light(&light, params.sampling.gather_scale, slots, slot, irradiance);
    count_rays(counters + range.counter, rays);
}
