// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Second look at area lights, at the edges of their shadows (shadow_edges.cl): what
// shadow_probes.cl took for each light, all of its samples or none, is put right. Where the first
// looks of a window speak of one place, they tell how much of the light is seen; elsewhere rays go
// to the samples that the pixel did not look at, unless the light means too little there to be
// seen.
//
// One work-item for the pixels of one set in a square of shadow_cell pixels. Those that share a
// light's edge are packed together, so that packets are full however few they are.
#include "brightness.h"
#include "counters.h"
#include "listed_receivers.h"
#include "near_lamp.h"
#include "packet_media.h"
#include "shadow_words.h"

#define CELL_PIXELS ((uint)(LANES * LANES))

// What all packets of a work-item share.
typedef struct {
    Media media;
    Lamps lamps;
    GLOBAL const float* receiver_planes;
    GLOBAL const Vpl* samples;
    GLOBAL const float* slopes;
    GLOBAL const float4* gb_albedo;
    GLOBAL float* irradiance;
    uint set;
} SecondLook;

// A pixel with edges of shadows: which of 32 lights they are of, are in doubt and were seen first;
// and what its window tells of how much of them is seen.
typedef struct {
    uint pixel, slot;
    uint first_look;  // number of a light's sample
    uint edges, doubtful, seen;
    ShadowCounts counts;
} EdgePixel;

// Those of a cell.
typedef struct {
    EdgePixel pixels[LANES * LANES];
    uint count;
    uint some;  // lights of which any has an edge
} EdgeCell;

// Some of them in a packet.
typedef struct {
    ReceiverList list;
    uint place[LANES];  // in the cell
} EdgePacket;

// A light's number, and its place in words.
typedef struct {
    uint number, bit;
} ShadowLight;

/// Every second bit of a number below 256.
static inline uint even_bits(uint code) {
    uint bits = code & 0x55u;
    bits = (bits | bits >> 1) & 0x33u;
    return (bits | bits >> 2) & 0x0Fu;
}

/// Finds the pixels of a set (by place, not rotated) in a cell that have an edge of any light of a
/// word, along a Morton curve.
static inline void find_edge_pixels(const Params* params, uint cell, uint set, uint rotated,
                                    uint word, GLOBAL const uint* pixel_slot,
                                    GLOBAL const uint* pixel_shadows,
                                    GLOBAL const uint* shadow_edges,
                                    GLOBAL const ShadowCounts* shadow_counts, EdgeCell* found) {
    uint edge = shadow_cell((uint)LANES, params->interleave);
    uint columns = (params->width + edge - 1u) / edge;
    uint column = cell % columns * (uint)LANES;
    uint row = cell / columns * (uint)LANES;
    uint plane = params->width * params->height;
    GLOBAL const uint* planes = shadow_edges + SHADOW_PLANES * word * plane;
    found->count = 0u;
    found->some = 0u;
    for (uint i = 0u; i < CELL_PIXELS; ++i) {
        uint u = column + even_bits(i);
        uint v = row + even_bits(i >> 1);
        uint x = u * params->interleave + set % params->interleave;
        uint y = v * params->interleave + set / params->interleave;
        if (x >= params->width || y >= params->height) continue;
        uint pixel = y * params->width + x;
        uint edges = planes[SHADOW_EDGE * plane + pixel];
        if (edges == 0u) continue;
        EdgePixel* at = found->pixels + found->count++;
        at->pixel = pixel;
        at->slot = pixel_slot[pixel];
        at->first_look = shadow_look(params, u, v, rotated);
        at->edges = edges;
        at->doubtful = planes[SHADOW_DOUBT * plane + pixel];
        at->seen = pixel_shadows[seen_plane(params, word) + shadow_place(params, x, y)];
        if (params->shadow_trust != 0u) at->counts = shadow_counts[word * plane + pixel];
        found->some |= edges;
    }
}

/// How much of a light the pixels of a window saw, of those that looked at it.
static inline float seen_share(const EdgePixel* pixel, uint bit) {
    uint lit = 0u;
    uint dark = 0u;
    for (uint k = 0u; k < SHADOW_DIGITS; ++k) {
        lit |= (pixel->counts.lit[k] >> bit & 1u) << k;
        dark |= (pixel->counts.dark[k] >> bit & 1u) << k;
    }
    return (float)lit / (float)(lit + dark);
}

/// The lanes whose first look saw the light.
static inline WMask seen_lanes(const EdgeCell* cell, uint bit, const EdgePacket* packet) {
    uint lanes = 0u;
    for (uint lane = 0u; lane < packet->list.count; ++lane)
        lanes |= (cell->pixels[packet->place[lane]].seen >> bit & 1u) << lane;
    return mask_of(lanes);
}

/// Luminance by all samples of a light from `first` on, were nothing between.
static inline WFloat light_luminance(const Params* params, const ReceiverPacket* packet,
                                     WFloat scale, GLOBAL const Vpl* first) {
    WFloat zero = WIDE(0.0f);
    WFloat sum = zero;
    for (GLOBAL const Vpl* vpl = first; vpl < first + params->samples_per_light; ++vpl) {
        WMask useful;
        WFloat g = connection(packet, vpl, VPL_SURFACE, from_vpl(packet, vpl), &useful);
        sum = sum + SELECT(useful, g * scale * luminance(xyz(vpl->flux)), zero);
    }
    return sum;
}

/// The lanes to which a light of luminance `light` means so much that a sample which has not been
/// looked at could show: by what one look in a window changes, in just noticeable differences.
static inline WMask visible_lanes(const Params* params, const SecondLook* look, WFloat light,
                                  const EdgeCell* cell, const EdgePacket* packet) {
    float of_light[LANES];
    wide_store(light, of_light, 0);
    uint lanes = 0u;
    for (uint lane = 0u; lane < packet->list.count; ++lane) {
        const EdgePixel* at = cell->pixels + packet->place[lane];
        float reflectance = luminance(xyz(look->gb_albedo[at->pixel])) * 0.318309886f;
        GLOBAL const float* red = look->irradiance + at->slot;
        float3 e = f3(red[0], red[params->slots], red[2u * params->slots]);
        // The sum stands for one pixel of a window of gather_scale; half way through a penumbra
        // half of what all of them give is there at least.
        float change = reflectance * of_light[lane];
        float there = m_max(reflectance * luminance(e), 0.5f * params->gather_scale * change);
        int unseen = change * brightness_slope(look->slopes, there) < params->shadow_step ? 1 : 0;
        lanes |= (unseen != 0 ? 0u : 1u) << lane;
    }
    return mask_of(lanes);
}

/// Share of the light that lanes see by the first looks of their windows.
static inline WFloat window_shares(const EdgeCell* cell, uint bit, const EdgePacket* packet) {
    float shares[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        shares[lane] =
            lane < packet->list.count ? seen_share(cell->pixels + packet->place[lane], bit) : 0.0f;
    return wide_load(shares, 0);
}

/// Numbers of the samples that lanes looked at first.
static inline WFloat first_looks(const EdgeCell* cell, const EdgePacket* packet) {
    float looks[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        looks[lane] =
            lane < packet->list.count ? (float)cell->pixels[packet->place[lane]].first_look : 0.0f;
    return wide_load(looks, 0);
}

/// Adds `light` times `scale` to the irradiance of listed slots, of which none gets below 0.
static inline void add_to_listed(const Params* params, const WideLight* light, float scale,
                                 const ReceiverList* list, GLOBAL float* irradiance) {
    float added[3][LANES];
    wide_store(light->red * scale, added[0], 0);
    wide_store(light->green * scale, added[1], 0);
    wide_store(light->blue * scale, added[2], 0);
    for (uint channel = 0u; channel < 3u; ++channel) {
        GLOBAL float* plane = irradiance + channel * params->slots;
        for (uint lane = 0u; lane < list->count; ++lane) {
            uint slot = list->slot[lane];
            plane[slot] = m_max(0.0f, plane[slot] + added[channel][lane]);
        }
    }
}

/// Puts a light right in the pixels of a packet; returns the number of rays.
static inline uint look_again(Scene scene, const Params* params, const SecondLook* look,
                              ShadowLight shadow, int doubtful, const EdgeCell* cell,
                              const EdgePacket* edges) {
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    ReceiverPacket packet = listed_receivers(params, look->receiver_planes, &edges->list);
    PacketInside inside =
        listed_inside(params, &look->media, look->receiver_planes, packet.position, &edges->list);
    GLOBAL const Vpl* first = look->samples + look->set * params->samples_per_set +
                              shadow.number * params->samples_per_light;
    WFloat scale =
        near_lamp_scale(params, &look->lamps, shadow.number, &packet, look->samples, look->set);
    WMask traced = mask_none_set;
    WFloat looks = zero;
    if (doubtful != 0) {
        traced = visible_lanes(params, look, light_luminance(params, &packet, scale, first), cell,
                               edges);
        looks = first_looks(cell, edges);
    }
    WFloat before = SELECT(seen_lanes(cell, shadow.bit, edges), one, zero);
    WFloat share = doubtful != 0 ? before : window_shares(cell, shadow.bit, edges);
    WideLight light = no_light();
    uint rays = 0u;
    for (uint i = 0u; i < params->samples_per_light; ++i) {
        GLOBAL const Vpl* vpl = first + i;
        float4 flux = vpl->flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        WFloat3 d = from_vpl(&packet, vpl);
        WMask useful;
        WFloat g = connection(&packet, vpl, VPL_SURFACE, d, &useful);
        WMask known = looks == WIDE((float)i);
        WMask unsure = useful & traced & mask_not(known);
        WMask blocked = mask_none_set;
        if (mask_any(unsure)) {
            rays += mask_count(unsure);
            blocked = trace_any_packet(scene, xyz(vpl->position), d, unsure);
        }
        WFloat found = SELECT(blocked, zero, one);
        found = SELECT(known, before, found);
        WFloat change = SELECT(traced, found, share) - before;
        add_connection(params, &look->media, &packet, &inside, xyz(vpl->position), flux,
                       g * scale * change, d, i, useful & mask_not(change == zero), &light);
    }
    add_to_listed(params, &light, params->gather_scale, &edges->list, look->irradiance);
    return rays;
}

/// Puts a light right in those pixels of a cell that have an edge of it and are in doubt, or are
/// not; returns the number of rays.
static inline uint look_at_edges(Scene scene, const Params* params, const SecondLook* look,
                                 ShadowLight shadow, int doubtful, const EdgeCell* cell) {
    EdgePacket packet;
    packet.list.count = 0u;
    uint rays = 0u;
    for (uint i = 0u; i < cell->count; ++i) {
        const EdgePixel* at = cell->pixels + i;
        uint wanted = doubtful != 0 ? at->doubtful : at->edges & ~at->doubtful;
        if ((wanted >> shadow.bit & 1u) != 0u) {
            packet.place[packet.list.count] = i;
            packet.list.slot[packet.list.count++] = at->slot;
        }
        int full = packet.list.count == (uint)LANES ? 1 : 0;
        int last = i + 1u == cell->count && packet.list.count > 0u ? 1 : 0;
        if (full == 0 && last == 0) continue;
        rays += look_again(scene, params, look, shadow, doubtful, cell, &packet);
        packet.list.count = 0u;
    }
    return rays;
}

WEFT_KERNEL(soft_shadows)
(PARAMS, SCENE_ARGS, MEDIA_ARGS, LAMP_ARGS, GLOBAL const float* receiver_planes,
 GLOBAL const uint* pixel_slot, GLOBAL const Vpl* samples, GLOBAL const uint* pixel_shadows,
 GLOBAL const uint* shadow_edges, GLOBAL const ShadowCounts* shadow_counts,
 GLOBAL const float* slopes, GLOBAL const float4* gb_albedo, GLOBAL float* irradiance,
 GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint item = params.first + GLOBAL_ID;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    LAMP_MAKE(lamps);
    uint sets = params.interleave * params.interleave;
    SecondLook look;
    look.media = through;
    look.lamps = lamps;
    look.receiver_planes = receiver_planes;
    look.samples = samples;
    look.slopes = slopes;
    look.gb_albedo = gb_albedo;
    look.irradiance = irradiance;
    look.set = (item % sets + params.set_rotation) % params.gather_sets;
    uint rays = 0u;
    for (uint word = 0u; word < shadow_words(params.sampled_lights); ++word) {
        EdgeCell cell;
        find_edge_pixels(&params, item / sets, item % sets, look.set, word, pixel_slot,
                         pixel_shadows, shadow_edges, shadow_counts, &cell);
        for (uint left = cell.some; left != 0u; left &= left - 1u) {
            ShadowLight shadow;
            shadow.bit = lowest_bit(left);
            shadow.number = word * SHADOW_WORD_LIGHTS + shadow.bit;
            rays += look_at_edges(scene, &params, &look, shadow, 1, &cell);
            rays += look_at_edges(scene, &params, &look, shadow, 0, &cell);
        }
    }
    count_rays(counters + params.counter, rays);
}
