// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Second look at area lights, for the blocks of receivers that `shadow_blocks` names: rays to all
// points of a group's lights where `shadow_edges` says that a pixel is close to the end of its
// shadow, and where that could be seen. The irradiance takes the place of that which
// shadow_probes.cl made.
#include "brightness.h"
#include "counters.h"
#include "near_lamp.h"
#include "packet_media.h"
#include "shadow_groups.h"

/// What is known of a packet's pixels.
typedef struct {
    uint shadows[LANES];
    uint edges[LANES];
    float reflectance[LANES];  // of luminance, over pi
    float radiance[LANES];     // luminance, after the first look
} PacketPixels;

static inline void load_pixels(const Params* params, GLOBAL const uint* slot_pixel, uint slot,
                               GLOBAL const uint* pixel_shadows, GLOBAL const uint* shadow_edges,
                               GLOBAL const float4* gb_albedo, GLOBAL const float* irradiance,
                               PacketPixels* pixels) {
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        uint pixel = slot_pixel[slot + lane];
        int valid = pixel != NO_TRIANGLE ? 1 : 0;
        pixels->shadows[lane] = valid != 0 ? pixel_shadows[shadow_place(params, pixel)] : 0u;
        pixels->edges[lane] = valid != 0 ? shadow_edges[pixel] : 0u;
        float reflectance = valid != 0 ? luminance(xyz(gb_albedo[pixel])) * 0.318309886f : 0.0f;
        pixels->reflectance[lane] = reflectance;
        uint at = slot + lane;
        float3 e =
            f3(irradiance[at], irradiance[params->slots + at], irradiance[2u * params->slots + at]);
        pixels->radiance[lane] = reflectance * luminance(e);
    }
}

/// The lanes whose words have that bit.
static inline WMask lanes_with(const uint* words, uint bit) {
    uint lanes = 0u;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) lanes |= (words[lane] >> bit & 1u) << lane;
    return mask_of(lanes);
}

/// Luminance by all samples of a group of lights, were nothing between.
static inline WFloat group_luminance(const Params* params, const Lamps* lamps,
                                     const ReceiverPacket* packet, GLOBAL const Vpl* samples,
                                     uint set, uint group) {
    WFloat zero = WIDE(0.0f);
    WFloat sum = zero;
    uint count = params->samples_per_light;
    uint end = shadow_group_light(params, group + 1u);
    for (uint l = shadow_group_light(params, group); l < end; ++l) {
        GLOBAL const Vpl* first = samples + set * params->samples_per_set + l * count;
        WFloat scale = near_lamp_scale(params, lamps, l, packet, samples, set);
        for (GLOBAL const Vpl* vpl = first; vpl < first + count; ++vpl) {
            WMask useful;
            WFloat g = connection(packet, vpl, VPL_SURFACE, from_vpl(packet, vpl), &useful);
            sum = sum + SELECT(useful, g * scale * luminance(xyz(vpl->flux)), zero);
        }
    }
    return sum;
}

/// The lanes to which a group of lights of luminance `light` means so much that a sample which has
/// not been looked at could show: by what one look in a window changes, in just noticeable
/// differences.
static inline WMask visible_lanes(const Params* params, WFloat light, const PacketPixels* pixels,
                                  GLOBAL const float* slopes) {
    float group[LANES];
    wide_store(light, group, 0);
    uint lanes = 0u;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        // The sum stands for one pixel of a window of gather_scale; half way through a penumbra
        // half of what all of them give is there at least.
        float change = pixels->reflectance[lane] * group[lane];
        float there = m_max(pixels->radiance[lane], 0.5f * params->gather_scale * change);
        int unseen = change * brightness_slope(slopes, there) < params->shadow_step ? 1 : 0;
        lanes |= (unseen != 0 ? 0u : 1u) << lane;
    }
    return mask_of(lanes);
}

// What a packet knows of one group of lights.
typedef struct {
    WMask edge;    // lanes that look at every sample
    WMask hidden;  // lanes whose first look saw none
    uint known;    // number of the sample of a light that was looked at before; no sample's: none
} GroupShadow;

/// Adds the samples of light `number` in a set; returns the number of rays.
static inline uint add_light(Scene scene, const Params* params, const Media* media,
                             const Lamps* lamps, const ReceiverPacket* packet,
                             const PacketInside* inside, const GroupShadow* shadow, uint number,
                             GLOBAL const Vpl* samples, uint set, WideLight* light) {
    uint rays = 0u;
    WFloat scale = near_lamp_scale(params, lamps, number, packet, samples, set);
    GLOBAL const Vpl* first =
        samples + set * params->samples_per_set + number * params->samples_per_light;
    for (uint i = 0u; i < params->samples_per_light; ++i) {
        GLOBAL const Vpl* vpl = first + i;
        float4 flux = vpl->flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        WFloat3 d = from_vpl(packet, vpl);
        WMask useful;
        WFloat g = connection(packet, vpl, VPL_SURFACE, d, &useful);
        WMask blocked = shadow->hidden;
        WMask unsure = useful & shadow->edge;
        if (i != shadow->known && mask_any(unsure)) {
            rays += mask_count(unsure);
            WMask found = trace_any_packet(scene, xyz(vpl->position), d, unsure);
            blocked = (shadow->hidden & mask_not(shadow->edge)) | (found & shadow->edge);
        }
        add_connection(params, media, packet, inside, xyz(vpl->position), flux, g * scale, d, i,
                       useful & mask_not(blocked), light);
    }
    return rays;
}

WEFT_KERNEL(soft_shadows)
(PARAMS, SCENE_ARGS, MEDIA_ARGS, LAMP_ARGS, GLOBAL const float* receiver_planes,
 GLOBAL const uint* block_set, GLOBAL const uint* slot_pixel, GLOBAL const uint* shadow_blocks,
 GLOBAL const Vpl* samples, GLOBAL const uint* pixel_shadows, GLOBAL const uint* shadow_edges,
 GLOBAL const float* slopes, GLOBAL const float4* gb_albedo, GLOBAL float* irradiance,
 GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint item = (params.first + GLOBAL_ID) * (uint)LANES;
    uint block = shadow_blocks[item / PACKET_BLOCK];
    uint slot = block * PACKET_BLOCK + item % PACKET_BLOCK;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    LAMP_MAKE(lamps);
    ReceiverPacket packet = load_receivers(&params, receiver_planes, slot);
    PacketInside inside = load_inside(&params, &through, receiver_planes, packet.position, slot);
    PacketPixels pixels;
    load_pixels(&params, slot_pixel, slot, pixel_shadows, shadow_edges, gb_albedo, irradiance,
                &pixels);
    uint set = (block_set[block] + params.set_rotation) % params.gather_sets;
    uint count = params.samples_per_light;
    uint start = shadow_start(&params, slot_pixel, slot, set);
    WideLight light = no_light();
    uint rays = 0u;
    for (uint group = 0u; group < params.shadow_groups; ++group) {
        uint l = shadow_group_light(&params, group);
        uint end = shadow_group_light(&params, group + 1u);
        GroupShadow shadow;
        shadow.hidden = lanes_with(pixels.shadows, group + SHADOW_HIDDEN);
        shadow.edge = lanes_with(pixels.edges, group);
        if (mask_any(shadow.edge))
            shadow.edge = shadow.edge & visible_lanes(&params,
                                                      group_luminance(&params, &lamps, &packet,
                                                                      samples, set, group),
                                                      &pixels, slopes);
        // What the first look found; of several lights it does not say which one was hidden.
        shadow.known = l + 1u == end ? start : count;
        for (; l < end; ++l)
            rays += add_light(scene, &params, &through, &lamps, &packet, &inside, &shadow, l,
                              samples, set, &light);
    }
    store_light(&params, &light, params.gather_scale, slot, irradiance);
    count_rays(counters + params.counter, rays);
}
