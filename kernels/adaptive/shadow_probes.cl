// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// First look at area lights: irradiance from a set's points on them as vpl_gather makes it, but
// with a ray to one point of each light only, which answers for its others. Which point that is
// changes from pixel to pixel, so that those of a window look at places all over the light. Where
// a point is behind a pixel's surface, or faces away, another is looked at.
//
// `pixel_shadows` tells of every pixel which lights were seen and which were not (shadow_words.h).
#include "kernels/adaptive/sample_sets.h"
#include "kernels/adaptive/shadow_words.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/near_lamp.h"
#include "kernels/media/packet_media.h"

/// Adds a light's samples from `first` on, of which `blocked` lanes see none.
static inline void add_light(const RenderParams* params, const Media* media,
                             const ReceiverPacket* packet, const PacketInside* inside, WFloat scale,
                             GLOBAL const Vpl* first, WMask blocked, WideLight* light) {
    GLOBAL const Vpl* end = first + params->sampling.lights.per_light;
    for (GLOBAL const Vpl* vpl = first; vpl < end; ++vpl) {
        float4 flux = vpl->flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        WFloat3 d = from_vpl(packet, vpl);
        WMask useful;
        WFloat g = connection(packet, vpl, VPL_SURFACE, d, &useful);
        add_connection(params, media, packet, inside, xyz(vpl->position), flux, g * scale, d,
                       (uint)(vpl - first), useful & mask_not(blocked), light);
    }
}

/// Traces a ray from every lane to one of a light's `count` samples, the first from number `start`
/// on that would add something to it; returns the lanes that have one.
static inline WMask look_at_light(Scene scene, const ReceiverPacket* packet,
                                  GLOBAL const Vpl* first, uint count, uint start, WMask* blocked,
                                  uint* rays) {
    WMask looked = mask_none_set;
    *blocked = mask_none_set;
    for (uint i = 0u; i < count && mask_any(packet->valid & mask_not(looked)); ++i) {
        GLOBAL const Vpl* vpl = first + (start + i) % count;
        WFloat3 d = from_vpl(packet, vpl);
        WMask useful;
        connection(packet, vpl, VPL_SURFACE, d, &useful);
        useful = useful & mask_not(looked);
        if (!mask_any(useful)) continue;
        *rays += mask_count(useful);
        *blocked = *blocked | (useful & trace_any_packet(scene, xyz(vpl->position), d, useful));
        looked = looked | useful;
    }
    return looked;
}

/// Number of the sample of every light that a packet's pixels look at first; all of them look at
/// the same.
static inline uint packet_look(const RenderParams* params, GLOBAL const uint* slot_pixel, uint slot,
                               uint set) {
    uint pixel = NO_TRIANGLE;
    for (uint lane = 0u; lane < (uint)LANES && pixel == NO_TRIANGLE; ++lane)
        pixel = slot_pixel[slot + lane];
    uint column = pixel % params->camera.width / params->sampling.interleave;
    uint row = pixel / params->camera.width / params->sampling.interleave;
    return shadow_look(params, column, row, set);
}

/// Writes what the lanes of a packet saw of the `lights` lights of a word where their pixels are.
static inline void store_shadows(const RenderParams* params, GLOBAL const uint* slot_pixel,
                                 uint slot, uint word, uint lights, const uint* seen,
                                 const uint* hidden, GLOBAL uint* pixel_shadows) {
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        uint pixel = slot_pixel[slot + lane];
        if (pixel == NO_TRIANGLE) continue;
        uint seen_bits = 0u;
        uint hidden_bits = 0u;
        for (uint bit = 0u; bit < lights; ++bit) {
            seen_bits |= (seen[bit] >> lane & 1u) << bit;
            hidden_bits |= (hidden[bit] >> lane & 1u) << bit;
        }
        uint place =
            shadow_place(params, pixel % params->camera.width, pixel / params->camera.width);
        pixel_shadows[seen_plane(params, word) + place] = seen_bits;
        pixel_shadows[hidden_plane(params, word) + place] = hidden_bits;
    }
}

WEFT_KERNEL(shadow_probes)
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
    GLOBAL const Vpl* of_set = samples + set * params.sampling.lights.per_set;
    WideLight light = no_light();
    uint rays = 0u;
    uint look = packet_look(&params, slot_pixel, slot, set);
    for (uint word = 0u; word < shadow_words(params.scene.area_lights); ++word) {
        uint seen[SHADOW_WORD_LIGHTS];
        uint hidden[SHADOW_WORD_LIGHTS];
        uint first_light = word * SHADOW_WORD_LIGHTS;
        uint count = params.scene.area_lights - first_light;
        if (count > SHADOW_WORD_LIGHTS) count = SHADOW_WORD_LIGHTS;
        for (uint bit = 0u; bit < count; ++bit) {
            seen[bit] = hidden[bit] = 0u;
            if (!mask_any(packet.valid)) continue;
            uint l = first_light + bit;
            GLOBAL const Vpl* first = of_set + l * params.sampling.lights.per_light;
            WMask blocked;
            WMask looked = look_at_light(scene, &packet, first, params.sampling.lights.per_light,
                                         look, &blocked, &rays);
            seen[bit] = mask_bits(looked & mask_not(blocked));
            hidden[bit] = mask_bits(blocked);
            if (seen[bit] == 0u) continue;
            WFloat scale = near_lamp_scale(&params, &lamps, l, &packet, samples, set);
            add_light(&params, &through, &packet, &inside, scale, first, blocked, &light);
        }
        store_shadows(&params, slot_pixel, slot, word, count, seen, hidden, pixel_shadows);
    }
    store_light(&light, params.sampling.gather_scale, slots, slot, irradiance);
    count_rays(counters + range.counter, rays);
}
