// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes irradiance records from all VPLs of a frame: irradiance, gradients, radius and
// clearance. Records of the temporal record cache (FEATURE_TEMPORAL) store which VPLs they see:
// only their invalid connections are traced again (record_invalidation.cl), and then all VPLs are
// summed up anew, as for a new record. One work-item per packet of LANES records.
#include "kernels/bvh/moved.h"
#include "kernels/cache/cache_masks.h"
#include "kernels/cache/clearance.h"
#include "kernels/cache/record_change.h"
#include "kernels/cache/record_place.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/film/gbuffer.h"

static inline void store_vector(WFloat3 v, uint plane, uint stride, uint slot,
                                GLOBAL float* records) {
    wide_store(v.x, records, plane * stride + slot);
    wide_store(v.y, records, (plane + 1u) * stride + slot);
    wide_store(v.z, records, (plane + 2u) * stride + slot);
}

static inline void store_record(const WideLight* light, const WideChange* change, uint stride,
                                uint slot, GLOBAL float* records) {
    store_vector(wide_vector(light->red, light->green, light->blue), RECORD_LIGHT, stride, slot,
                 records);
    store_vector(change->move_red, RECORD_MOVE, stride, slot, records);
    store_vector(change->move_green, RECORD_MOVE + 3u, stride, slot, records);
    store_vector(change->move_blue, RECORD_MOVE + 6u, stride, slot, records);
    store_vector(change->turn_red, RECORD_TURN, stride, slot, records);
    store_vector(change->turn_green, RECORD_TURN + 3u, stride, slot, records);
    store_vector(change->turn_blue, RECORD_TURN + 6u, stride, slot, records);
}

// LANES records that are being computed.
typedef struct {
    ReceiverPacket packet;
    PacketEnclosingMedia enclosing_media;
    WFloat3 tangent, bitangent;
    WFloat level;  // see roulette_level
    WideLight light;
    WideChange change;
} RecordPacket;

static inline void begin_records(const RenderParams* params, const Media* media,
                                 GLOBAL const float* receiver_planes, uint stride, uint slot,
                                 RecordPacket* records) {
    records->packet = load_receivers(params, receiver_planes, stride, slot);
    records->enclosing_media = load_enclosing_media(params, media, receiver_planes, stride,
                                                    records->packet.position, slot);
    LaneVectors normals = lanes_of(records->packet.shading);
    LaneVectors tangents;
    LaneVectors bitangents;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        float3 t;
        float3 b;
        make_basis(lane_vector(&normals, lane), &t, &b);
        set_lane(&tangents, lane, t);
        set_lane(&bitangents, lane, b);
    }
    records->tangent = wide_of(&tangents);
    records->bitangent = wide_of(&bitangents);
    records->level = WIDE(0.0f);
    records->light = no_light();
    records->change = no_change();
}

/// Adds VPL number `number`. Lanes of `to_trace` trace a ray to it; for the others `seen` tells
/// whether they see it, and afterwards for all. Returns the number of rays.
static inline uint add_vpl(const RenderParams* params, float roulette, Scene scene,
                           const Media* media, GLOBAL const Vpl* vpl, uint number, uint to_trace,
                           uint* seen, RecordPacket* records) {
    float3 flux = xyz(vpl->flux);
    float bright = luminance(flux);
    if (!(max_component(flux) > 0.0f)) return 0u;
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    WFloat3 d = from_vpl(&records->packet, vpl);
    uint kind = as_bits(vpl->normal.w);
    WMask useful;
    WFloat g = connection(&records->packet, vpl, kind, d, &useful);
    WFloat times = one;
    if (roulette > 0.0f) {
        // As in vpl_gather.cl; derivatives grow by the same share.
        WFloat least = records->level / bright;
        useful = useful & (g >= least * vpl->flux.w);
        times = SELECT(g < least, least / g, times);
    }
    if (!mask_any(useful)) return 0u;
    WMask traced = useful & mask_of(to_trace);
    uint rays = mask_count(traced);
    if (mask_any(traced)) {
        uint blocked = mask_bits(trace_any_packet(scene, xyz(vpl->position), d, traced));
        *seen = (*seen & ~to_trace) | (to_trace & ~blocked);
    }
    // Lanes that the VPL cannot light may be anywhere, even at the VPL.
    d = wide_vector(SELECT(useful, d.x, one), SELECT(useful, d.y, zero), SELECT(useful, d.z, zero));
    g = SELECT(useful, g, zero);
    WFloat gain = SELECT(useful, g * times * bright, zero);
    WideChange* change = &records->change;
    change->all = change->all + gain;
    useful = useful & mask_of(*seen & ALL_LANES);
    if (!mask_any(useful)) return rays;
    gain = SELECT(useful, gain, zero);
    change->seen = change->seen + gain;
    // The light of a geometry term of 1, then times the lanes' own.
    WideLight part = no_light();
    add_connection(params, media, &records->packet, &records->enclosing_media, xyz(vpl->position),
                   vpl->flux, SELECT(useful, times, zero), d, number, useful, &part);
    records->light.red = records->light.red + part.red * g;
    records->light.green = records->light.green + part.green * g;
    records->light.blue = records->light.blue + part.blue * g;
    WMask free = useful & (g < WIDE(vpl->position.w));
    if (kind != VPL_SURFACE) free = mask_of(0u);
    add_bend(wide_dot(d, d), SELECT(free, zero, gain), change);
    if (!mask_any(free)) return rays;
    part.red = SELECT(free, part.red, zero);
    part.green = SELECT(free, part.green, zero);
    part.blue = SELECT(free, part.blue, zero);
    add_change(&records->packet, xyz(vpl->normal), d, records->tangent, records->bitangent, &part,
               change);
    return rays;
}

/// Bounds radii by pixel sizes and clearance. Traces the clearance of new records, and of those
/// near moved geometry; returns the number of rays.
static inline uint finish_records(const RenderParams* params, uint moved_count, Scene scene,
                                  const RecordPacket* packet, GLOBAL const uint* slot_pixel,
                                  GLOBAL const float4* gb_position, GLOBAL const float4* gb_normal,
                                  GLOBAL const float4* moved_boxes, int fresh, uint stride,
                                  uint slot, GLOBAL float* records) {
    LaneVectors normals = lanes_of(packet->packet.shading);
    LaneVectors facets = lanes_of(packet->packet.normal);
    LaneVectors places = lanes_of(packet->packet.position);
    uint valid = mask_bits(packet->packet.valid);
    uint rays = 0u;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        if ((valid >> lane & 1u) == 0u) continue;
        GLOBAL float* record = records + slot + lane;
        if (fresh != 0)
            store_place(params, gb_position, gb_normal, slot_pixel[slot + lane], stride, record);
        float least = record[RECORD_LEAST * stride];
        float most = record[RECORD_MOST * stride];
        float radius = m_clamp(record[RECORD_RADIUS * stride], least, most);
        // A stored record may get a larger radius in a later frame.
        float reach = GUARD_REACH * (HAS(params, FEATURE_TEMPORAL) ? most : radius);
        float3 origin = lane_vector(&places, lane);
        GLOBAL float* clearances = record + RECORD_CLEARANCE * stride;
        if (fresh != 0 || is_near_moved(moved_count, moved_boxes, origin, reach) != 0) {
            rays += PROBES;
            store_clearances(scene, origin, lane_vector(&normals, lane), lane_vector(&facets, lane),
                             reach, stride, clearances);
        }
        float nearest = least_clearance(stride, clearances);
        if (nearest < reach) radius = m_min(radius, NEAR_SHARE * nearest);
        record[RECORD_RADIUS * stride] = m_max(radius, least);
    }
    return rays;
}

WEFT_KERNEL(cache_records)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint number = range.first + WORK_ITEM(range);
    uint slot = number * (uint)LANES;
    uint state = HAS(&params, FEATURE_TEMPORAL) ? states[number] : CACHE_FRESH;
    if (state == CACHE_KEEP) return;
    int fresh = state == CACHE_FRESH ? 1 : 0;
    int keeps = HAS(&params, FEATURE_TEMPORAL) && update.mask_words > 0u ? 1 : 0;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    RecordPacket made;
    begin_records(&params, &through, receiver_planes, slots, slot, &made);
    uint count = mask_any(made.packet.valid) ? update.vpls : 0u;
    if (update.roulette > 0.0f && count > 0u)
        made.level = roulette_level(update.roulette, &made.packet, vpls, count);
    uint rays = 0u;
    uint word = 0u;
    for (uint i = 0u; i < count; ++i) {
        uint to_trace = ALL_LANES;
        uint sees = 0u;
        if (keeps != 0) {
            if (cache_shift(i) == 0u) word = 0u;
            if (fresh == 0) {
                to_trace = lanes_of_word(invalid[cache_word(update.mask_words, number, i)], i);
                sees = lanes_of_word(seen[cache_word(update.mask_words, number, i)], i);
            }
        }
        rays +=
            add_vpl(&params, update.roulette, scene, &through, vpls + i, i, to_trace, &sees, &made);
        if (keeps != 0) {
            word |= (sees & ALL_LANES) << cache_shift(i);
            if (i + 1u == count || cache_shift(i + 1u) == 0u)
                seen[cache_word(update.mask_words, number, i)] = word;
        }
    }
    store_record(&made.light, &made.change, slots, slot, records);
    WFloat bright = wide_luminance(made.light.red, made.light.green, made.light.blue);
    wide_store(error_radius(&params, &made.change, made.tangent, made.bitangent, bright), records,
               RECORD_RADIUS * slots + slot);
    rays += finish_records(&params, update.moved_boxes, scene, &made, slot_pixel, gb_position,
                           gb_normal, moved_boxes, fresh, slots, slot, records);
    count_rays(counters + range.counter, rays);
}
