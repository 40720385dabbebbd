// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Probes area lights: computes irradiance from a set's points on them as area_lights.cl does, but
// traces a shadow ray to one point of each light only, whose result stands for the others. Which
// point that is changes from pixel to pixel, so that the probes of a footprint cover the whole
// light. Where a point is behind a pixel's surface, or faces away, the next is probed. One
// work-item for LANES pixels of a set.
//
// `pixel_shadows` stores which lights the probes of each pixel found visible, and which hidden
// (visibility_mask.h).
#include "kernels/adaptive/sample_sets.h"
#include "kernels/adaptive/visibility_mask.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/analytic_area_light.h"
#include "kernels/media/packet_media.h"

/// Adds the light of a light's samples from `first` on, to all lanes but those of `blocked`.
static inline void add_light(const RenderParams* params, const Media* media,
                             const ReceiverPacket* packet,
                             const PacketEnclosingMedia* enclosing_media, WFloat scale,
                             GLOBAL const Vpl* first, WMask blocked, WideLight* light) {
    GLOBAL const Vpl* end = first + params->sampling.lights.per_light;
    for (GLOBAL const Vpl* vpl = first; vpl < end; ++vpl) {
        float4 flux = vpl->flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        WFloat3 d = from_vpl(packet, vpl);
        WMask useful;
        WFloat g = connection(packet, vpl, VPL_SURFACE, d, &useful);
        add_connection(params, media, packet, enclosing_media, xyz(vpl->position), flux, g * scale,
                       d, (uint)(vpl - first), useful & mask_not(blocked), light);
    }
}

/// Probes a light: traces a ray from every lane to one of its `count` samples, the first from
/// number `start` on that could light the lane. Returns the lanes that have such a sample;
/// `blocked` receives those that are hidden from it.
static inline WMask probe_light(Scene scene, const ReceiverPacket* packet, GLOBAL const Vpl* first,
                                uint count, uint start, WMask* blocked, uint* rays) {
    WMask traced = mask_none_set;
    *blocked = mask_none_set;
    for (uint i = 0u; i < count && mask_any(packet->valid & mask_not(traced)); ++i) {
        GLOBAL const Vpl* vpl = first + (start + i) % count;
        WFloat3 d = from_vpl(packet, vpl);
        WMask useful;
        connection(packet, vpl, VPL_SURFACE, d, &useful);
        useful = useful & mask_not(traced);
        if (!mask_any(useful)) continue;
        *rays += mask_count(useful);
        *blocked = *blocked | (useful & trace_any_packet(scene, xyz(vpl->position), d, useful));
        traced = traced | useful;
    }
    return traced;
}

/// Number of the sample of every light that a packet's probes begin with: one for all its pixels.
static inline uint probed_sample_of_packet(const RenderParams* params,
                                           GLOBAL const uint* slot_pixel, uint slot, uint set) {
    uint pixel = INVALID_INDEX;
    for (uint lane = 0u; lane < (uint)LANES && pixel == INVALID_INDEX; ++lane)
        pixel = slot_pixel[slot + lane];
    uint column = pixel % params->camera.width / params->sampling.interleave;
    uint row = pixel / params->camera.width / params->sampling.interleave;
    return probed_sample(params, column, row, set);
}

/// Stores the visibility masks of a packet's pixels for the `lights` lights of a word. `seen` and
/// `hidden` have the lanes of each light, a bit each.
static inline void store_shadows(const RenderParams* params, GLOBAL const uint* slot_pixel,
                                 uint slot, uint word, uint lights, const uint* seen,
                                 const uint* hidden, GLOBAL uint* pixel_shadows) {
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        uint pixel = slot_pixel[slot + lane];
        if (pixel == INVALID_INDEX) continue;
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
    AREA_LIGHTS_MAKE(area_lights);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slots, slot);
    PacketEnclosingMedia enclosing_media =
        load_enclosing_media(&params, &through, receiver_planes, slots, packet.position, slot);
    uint set = receiver_set(&params, block_set, slot);
    GLOBAL const Vpl* of_set = samples + set * params.sampling.lights.per_set;
    WideLight light = no_light();
    uint rays = 0u;
    uint probed = probed_sample_of_packet(&params, slot_pixel, slot, set);
    for (uint word = 0u; word < visibility_mask_words(params.scene.area_lights); ++word) {
        uint seen[VISIBILITY_MASK_LIGHTS];
        uint hidden[VISIBILITY_MASK_LIGHTS];
        uint first_light = word * VISIBILITY_MASK_LIGHTS;
        uint count = params.scene.area_lights - first_light;
        if (count > VISIBILITY_MASK_LIGHTS) count = VISIBILITY_MASK_LIGHTS;
        for (uint bit = 0u; bit < count; ++bit) {
            seen[bit] = hidden[bit] = 0u;
            if (!mask_any(packet.valid)) continue;
            uint l = first_light + bit;
            GLOBAL const Vpl* first = of_set + l * params.sampling.lights.per_light;
            WMask blocked;
            WMask traced = probe_light(scene, &packet, first, params.sampling.lights.per_light,
                                       probed, &blocked, &rays);
            seen[bit] = mask_bits(traced & mask_not(blocked));
            hidden[bit] = mask_bits(blocked);
            if (seen[bit] == 0u) continue;
            WFloat scale = analytic_scale(&params, &area_lights, l, &packet, samples, set);
            add_light(&params, &through, &packet, &enclosing_media, scale, first, blocked, &light);
        }
        store_shadows(&params, slot_pixel, slot, word, count, seen, hidden, pixel_shadows);
    }
    store_light(&light, params.sampling.gather_scale, slots, slot, irradiance);
    count_rays(counters + range.counter, rays);
}
