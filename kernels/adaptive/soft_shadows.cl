// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Second look at area lights, at the edges of their shadows (shadow_edges.cl): what
// shadow_probes.cl took for each light, all of its samples or none, is put right by rays to the
// samples that the pixel did not look at, unless the light means too little there to be seen.
//
// One work-item for the pixels of one set in a square of shadow_cell pixels. Those that share a
// light's edge are packed together, and anew for each of its samples, so that packets are full
// however few pixels there are: a packet costs nearly as much with one lane as with all.
#include "kernels/adaptive/brightness.h"
#include "kernels/adaptive/edge_cells.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/near_lamp.h"
#include "kernels/media/packet_media.h"

// What all packets of a work-item share.
typedef struct {
    Media media;
    Lamps lamps;
    GLOBAL const float* receiver_planes;
    GLOBAL const Vpl* samples;
    GLOBAL const float* slopes;
    GLOBAL float* irradiance;
    uint slots;  // stride of the planes of receivers and irradiance
    float shadow_step;
    uint set;
} SecondLook;

// A light: its number, its place in words, and its first sample in the set.
typedef struct {
    uint number, bit;
    GLOBAL const Vpl* first;
} ShadowLight;

// Pixels of a cell that look at a light again, and near_lamp_scale of them.
typedef struct {
    EdgeList edges;
    float scale[LANES * LANES];  // by place in the cell
} LightEdges;

/// Luminance by all samples of a light from `first` on, were nothing between.
static inline WFloat light_luminance(const RenderParams* params, const ReceiverPacket* packet,
                                     WFloat scale, GLOBAL const Vpl* first) {
    WFloat zero = WIDE(0.0f);
    WFloat sum = zero;
    for (GLOBAL const Vpl* vpl = first; vpl < first + params->sampling.lights.per_light; ++vpl) {
        WMask useful;
        WFloat g = connection(packet, vpl, VPL_SURFACE, from_vpl(packet, vpl), &useful);
        sum = sum + SELECT(useful, g * scale * luminance(xyz(vpl->flux)), zero);
    }
    return sum;
}

/// 1 where a light of luminance `light` means so much to a pixel that a sample which has not been
/// looked at could show: by what one look in a window changes, in just noticeable differences.
static inline int may_show(const RenderParams* params, const SecondLook* look,
                           const EdgePixel* pixel, float light) {
    // The sum stands for one pixel of a window of gather_scale; half way through a penumbra half of
    // what all of them give is there at least.
    float change = pixel->reflectance * light;
    float there = m_max(pixel->radiance, 0.5f * params->sampling.gather_scale * change);
    return change * brightness_slope(look->slopes, there) < look->shadow_step ? 0 : 1;
}

/// The pixels at the edges of a light's shadow, but those to which it means too little.
static inline void find_visible(const RenderParams* params, const SecondLook* look,
                                const ShadowLight* shadow, const EdgeCell* cell,
                                LightEdges* found) {
    EdgeList* edges = &found->edges;
    list_edges(cell, shadow->bit, edges);
    for (uint place = 0u; place < CELL_PIXELS; ++place) found->scale[place] = 0.0f;
    uint kept = 0u;
    for (uint next = 0u; next < edges->count;) {
        EdgePacket some = next_packet(cell, edges, ANY_LOOK, &next);
        ReceiverPacket packet = packet_receivers(params, cell, &some);
        WFloat scale = near_lamp_scale(params, &look->lamps, shadow->number, &packet, look->samples,
                                       look->set);
        float light[LANES];
        float scales[LANES];
        wide_store(light_luminance(params, &packet, scale, shadow->first), light, 0);
        wide_store(scale, scales, 0);
        for (uint lane = 0u; lane < some.list.count; ++lane) {
            uint place = some.place[lane];
            if (may_show(params, look, cell->pixels + place, light[lane]) == 0) continue;
            found->scale[place] = scales[lane];
            edges->place[kept++] = place;
        }
    }
    edges->count = kept;
}

/// Factors of the lanes of a packet.
static inline WFloat packet_scale(const LightEdges* from, const EdgePacket* packet) {
    float scales[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        scales[lane] = lane < packet->list.count ? from->scale[packet->place[lane]] : 0.0f;
    return wide_load(scales, 0);
}

/// Adds `light` times `scale` to the irradiance of listed slots, of which none gets below 0.
static inline void add_to_listed(const WideLight* light, float scale, const ReceiverList* list,
                                 uint stride, GLOBAL float* irradiance) {
    float added[3][LANES];
    wide_store(light->red * scale, added[0], 0);
    wide_store(light->green * scale, added[1], 0);
    wide_store(light->blue * scale, added[2], 0);
    for (uint channel = 0u; channel < 3u; ++channel) {
        GLOBAL float* plane = irradiance + channel * stride;
        for (uint lane = 0u; lane < list->count; ++lane) {
            uint slot = list->slot[lane];
            plane[slot] = m_max(0.0f, plane[slot] + added[channel][lane]);
        }
    }
}

/// Looks at sample `i` of a light from pixels that have not, and puts right what their first look
/// took for it; returns the number of rays.
static inline uint look_at_sample(Scene scene, const RenderParams* params, const SecondLook* look,
                                  const ShadowLight* shadow, uint i, const EdgeCell* cell,
                                  const LightEdges* from, const EdgePacket* edges) {
    GLOBAL const Vpl* vpl = shadow->first + i;
    ReceiverPacket packet = packet_receivers(params, cell, edges);
    WFloat3 d = from_vpl(&packet, vpl);
    WMask useful;
    WFloat g = connection(&packet, vpl, VPL_SURFACE, d, &useful);
    if (!mask_any(useful)) return 0u;
    WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
    WMask before = seen_lanes(cell, shadow->bit, edges);
    WMask changed = useful & ((before & blocked) | mask_not(before | blocked));
    if (mask_any(changed)) {
        WFloat one = WIDE(1.0f);
        WFloat change = SELECT(before, -one, one) * packet_scale(from, edges);
        PacketInside inside = listed_inside(params, &look->media, look->receiver_planes,
                                            look->slots, packet.position, &edges->list);
        WideLight light = no_light();
        add_connection(params, &look->media, &packet, &inside, xyz(vpl->position), vpl->flux,
                       g * change, d, i, changed, &light);
        add_to_listed(&light, params->sampling.gather_scale, &edges->list, look->slots,
                      look->irradiance);
    }
    return mask_count(useful);
}

/// Sends rays to a light from the pixels of a cell at the edges of its shadow; returns their
/// number.
static inline uint look_again(Scene scene, const RenderParams* params, const SecondLook* look,
                              const ShadowLight* shadow, const EdgeCell* cell) {
    LightEdges visible;
    find_visible(params, look, shadow, cell, &visible);
    uint rays = 0u;
    for (uint i = 0u; i < params->sampling.lights.per_light; ++i) {
        float4 flux = shadow->first[i].flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        for (uint next = 0u; next < visible.edges.count;) {
            EdgePacket packet = next_packet(cell, &visible.edges, i, &next);
            if (packet.list.count > 0u)
                rays += look_at_sample(scene, params, look, shadow, i, cell, &visible, &packet);
        }
    }
    return rays;
}

WEFT_KERNEL(soft_shadows)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    LAMP_MAKE(lamps);
    uint sets = params.sampling.interleave * params.sampling.interleave;
    uint set = (item % sets + params.sampling.set_rotation) % params.sampling.gather_sets;
    SecondLook look = {through,    lamps, receiver_planes, samples, slopes,
                       irradiance, slots, shadow_step,     set};
    ShadowPlanes planes = {receiver_planes, pixel_slot, pixel_shadows, shadow_edges,
                           gb_albedo,       irradiance, slots};
    uint rays = 0u;
    for (uint word = 0u; word < shadow_words(params.scene.area_lights); ++word) {
        EdgeCell cell;
        find_edge_pixels(&params, item / sets, item % sets, set, word, &planes, &cell);
        for (uint left = cell.some; left != 0u; left &= left - 1u) {
            ShadowLight shadow;
            shadow.bit = lowest_bit(left);
            shadow.number = word * SHADOW_WORD_LIGHTS + shadow.bit;
            shadow.first = samples + set * params.sampling.lights.per_set +
                           shadow.number * params.sampling.lights.per_light;
            rays += look_again(scene, &params, &look, &shadow, &cell);
        }
    }
    count_rays(counters + range.counter, rays);
}
