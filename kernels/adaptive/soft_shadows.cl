// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Refines the direct light of area lights at the edges of their shadows (shadow_edges.cl).
// shadow_probes.cl has counted all samples of a light or none; rays to the samples that the pixel
// has not probed correct that, unless the light adds too little there for the error to show.
//
// One work-item for the pixels of one set in a cell (edge_cells.h). Those that share a light's edge
// are packed together, and anew for each of its samples, so that packets are full however few
// pixels there are: a packet costs nearly as much with one lane as with all.
#include "kernels/adaptive/brightness.h"
#include "kernels/adaptive/edge_cells.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/analytic_area_light.h"
#include "kernels/media/packet_media.h"

// What all packets of a work-item share.
typedef struct {
    Media media;
    AreaLights area_lights;
    GLOBAL const float* receiver_planes;
    GLOBAL const Vpl* samples;
    GLOBAL const float* slopes;
    GLOBAL float* irradiance;
    uint slots;  // stride of the planes of receivers and irradiance
    float shadow_step;
    uint set;
} ShadowRefinement;

// A light: its number, its bit in visibility masks, and its first sample in the set.
typedef struct {
    uint number, bit;
    GLOBAL const Vpl* first;
} ShadowLight;

// Pixels of a cell that refine a light, and analytic_scale of them.
typedef struct {
    EdgeList edges;
    float scale[LANES * LANES];  // by place in the cell
} LightEdges;

/// Luminance of the irradiance by all samples of a light from `first` on, were none of them hidden.
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

/// 1 where a sample of a light that has not been probed could make a visible difference: where what
/// one probe changes is at least `shadow_step` just noticeable differences. `light` is the
/// luminance of the irradiance that the light's samples in the set would bring, were none of them
/// hidden.
static inline int may_show(const RenderParams* params, const ShadowRefinement* refinement,
                           const EdgePixel* pixel, float light) {
    // `light` counts the set once: one probe changes the mean over the gather_scale pixels of the
    // filter footprint by as much. Half way through its penumbra the light alone brings half of
    // what all sets together would bring unhidden.
    float change = pixel->reflectance * light;
    float there = m_max(pixel->radiance, 0.5f * params->sampling.gather_scale * change);
    return change * brightness_slope(refinement->slopes, there) < refinement->shadow_step ? 0 : 1;
}

/// Finds the pixels at the edge of a light's shadow where an error of its light could show.
static inline void find_visible(const RenderParams* params, const ShadowRefinement* refinement,
                                const ShadowLight* shadow, const EdgeCell* cell,
                                LightEdges* found) {
    EdgeList* edges = &found->edges;
    list_edges(cell, shadow->bit, edges);
    for (uint place = 0u; place < CELL_PIXELS; ++place) found->scale[place] = 0.0f;
    uint kept = 0u;
    for (uint next = 0u; next < edges->count;) {
        EdgePacket some = next_packet(cell, edges, ANY_SAMPLE, &next);
        ReceiverPacket packet = packet_receivers(params, cell, &some);
        WFloat scale = analytic_scale(params, &refinement->area_lights, shadow->number, &packet,
                                      refinement->samples, refinement->set);
        float light[LANES];
        float scales[LANES];
        wide_store(light_luminance(params, &packet, scale, shadow->first), light, 0);
        wide_store(scale, scales, 0);
        for (uint lane = 0u; lane < some.list.count; ++lane) {
            uint place = some.place[lane];
            if (may_show(params, refinement, cell->pixels + place, light[lane]) == 0) continue;
            found->scale[place] = scales[lane];
            edges->place[kept++] = place;
        }
    }
    edges->count = kept;
}

/// analytic_scale of the lanes of a packet; 0 beyond it.
static inline WFloat packet_scale(const LightEdges* from, const EdgePacket* packet) {
    float scales[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        scales[lane] = lane < packet->list.count ? from->scale[packet->place[lane]] : 0.0f;
    return wide_load(scales, 0);
}

/// Adds `light` times `scale` to the irradiance of listed slots. Sums below 0 become 0.
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

/// Traces rays to sample `i` of a light from pixels that have not probed it, and corrects their
/// irradiance where the result differs from that of their probe; returns the number of rays.
static inline uint trace_sample(Scene scene, const RenderParams* params,
                                const ShadowRefinement* refinement, const ShadowLight* shadow,
                                uint i, const EdgeCell* cell, const LightEdges* from,
                                const EdgePacket* edges) {
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
        PacketEnclosingMedia enclosing_media =
            listed_enclosing_media(params, &refinement->media, refinement->receiver_planes,
                                   refinement->slots, packet.position, &edges->list);
        WideLight light = no_light();
        add_connection(params, &refinement->media, &packet, &enclosing_media, xyz(vpl->position),
                       vpl->flux, g * change, d, i, changed, &light);
        add_to_listed(&light, params->sampling.gather_scale, &edges->list, refinement->slots,
                      refinement->irradiance);
    }
    return mask_count(useful);
}

/// Refines a light for the pixels of a cell at the edge of its shadow; returns the number of rays.
static inline uint refine(Scene scene, const RenderParams* params,
                          const ShadowRefinement* refinement, const ShadowLight* shadow,
                          const EdgeCell* cell) {
    LightEdges visible;
    find_visible(params, refinement, shadow, cell, &visible);
    uint rays = 0u;
    for (uint i = 0u; i < params->sampling.lights.per_light; ++i) {
        float4 flux = shadow->first[i].flux;
        if (!(flux.x > 0.0f || flux.y > 0.0f || flux.z > 0.0f)) continue;
        for (uint next = 0u; next < visible.edges.count;) {
            EdgePacket packet = next_packet(cell, &visible.edges, i, &next);
            if (packet.list.count > 0u)
                rays += trace_sample(scene, params, refinement, shadow, i, cell, &visible, &packet);
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
    AREA_LIGHTS_MAKE(area_lights);
    uint sets = params.sampling.interleave * params.sampling.interleave;
    uint set = (item % sets + params.sampling.set_rotation) % params.sampling.gather_sets;
    ShadowRefinement refinement = {through,    area_lights, receiver_planes, samples, slopes,
                                   irradiance, slots,       shadow_step,     set};
    ShadowPlanes planes = {receiver_planes, pixel_slot, pixel_shadows, shadow_edges,
                           gb_albedo,       irradiance, slots};
    uint rays = 0u;
    for (uint word = 0u; word < visibility_mask_words(params.scene.area_lights); ++word) {
        EdgeCell cell;
        find_edge_pixels(&params, item / sets, item % sets, set, word, &planes, &cell);
        for (uint left = cell.some; left != 0u; left &= left - 1u) {
            ShadowLight shadow;
            shadow.bit = lowest_bit(left);
            shadow.number = word * VISIBILITY_MASK_LIGHTS + shadow.bit;
            shadow.first = samples + set * params.sampling.lights.per_set +
                           shadow.number * params.sampling.lights.per_light;
            rays += refine(scene, &params, &refinement, &shadow, &cell);
        }
    }
    count_rays(counters + range.counter, rays);
}
