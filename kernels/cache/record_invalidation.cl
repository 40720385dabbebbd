// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the connections of stored irradiance records with VPLs that a change of the scene
// invalidates, and so the packets of records that have to be summed up anew. A connection is
// invalid if its VPL has moved, or if it meets moved geometry at its old or new place. The scene of
// this launch is the moved geometry alone, at both places; where nothing has moved in the box about
// a packet and a VPL, no rays are traced. One work-item per packet of LANES records.
#include "kernels/bvh/moved.h"
#include "kernels/cache/cache_masks.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/light/connection.h"
#include "kernels/media/packet_media.h"

// A packet of records, and the bounds of their places.
typedef struct {
    ReceiverPacket receivers;
    float3 lower, upper;
} BoundedPacket;

static inline BoundedPacket load_packet(const RenderParams* params,
                                        GLOBAL const float* receiver_planes, uint stride,
                                        uint slot) {
    BoundedPacket packet;
    packet.receivers = load_receivers(params, receiver_planes, stride, slot);
    packet.lower = f3(M_INFINITY, M_INFINITY, M_INFINITY);
    packet.upper = -packet.lower;
    LaneVectors places = lanes_of(packet.receivers.position);
    uint valid = mask_bits(packet.receivers.valid);
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        if ((valid >> lane & 1u) == 0u) continue;
        packet.lower = lowest3(packet.lower, lane_vector(&places, lane));
        packet.upper = highest3(packet.upper, lane_vector(&places, lane));
    }
    return packet;
}

/// Lanes whose connection with a VPL is invalid.
static inline uint invalid_lanes(const RecordUpdate* update, Scene moved,
                                 const BoundedPacket* packet, GLOBAL const Vpl* vpl, uint change,
                                 GLOBAL const float4* moved_boxes, uint* rays) {
    if (!(max_component(xyz(vpl->flux)) > 0.0f)) return 0u;
    float3 at = xyz(vpl->position);
    if ((change & VPL_MOVED) == 0u &&
        meets_moved(update->moved_boxes, moved_boxes, lowest3(packet->lower, at),
                    highest3(packet->upper, at)) == 0)
        return 0u;
    WFloat3 d = from_vpl(&packet->receivers, vpl);
    WMask useful;
    connection(&packet->receivers, vpl, as_bits(vpl->normal.w), d, &useful);
    if ((change & VPL_MOVED) != 0u || !mask_any(useful)) return mask_bits(useful);
    *rays += mask_count(useful);
    return mask_bits(useful & trace_any_packet(moved, at, d, useful));
}

/// 1 where anything has moved within the reach of any record of the packet.
static inline int any_near_moved(const RecordUpdate* update, const BoundedPacket* packet,
                                 GLOBAL const float* records, GLOBAL const float4* moved_boxes,
                                 uint stride, uint slot) {
    LaneVectors places = lanes_of(packet->receivers.position);
    uint valid = mask_bits(packet->receivers.valid);
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        float reach = GUARD_REACH * records[RECORD_MOST * stride + slot + lane];
        if ((valid >> lane & 1u) != 0u &&
            is_near_moved(update->moved_boxes, moved_boxes, lane_vector(&places, lane), reach) != 0)
            return 1;
    }
    return 0;
}

WEFT_KERNEL(record_invalidation)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint number = range.first + WORK_ITEM(range);
    uint slot = number * (uint)LANES;
    SCENE_MAKE(moved);
    BoundedPacket packet = load_packet(&params, receiver_planes, slots, slot);
    uint state = CACHE_KEEP;
    uint rays = 0u;
    uint count = mask_any(packet.receivers.valid) ? update.vpls : 0u;
    if (count > 0u && any_near_moved(&update, &packet, records, moved_boxes, slots, slot) != 0)
        state = CACHE_UPDATE;
    uint word = 0u;
    for (uint i = 0u; i < count; ++i) {
        uint change = vpl_changes[i];
        uint bits = invalid_lanes(&update, moved, &packet, vpls + i, change, moved_boxes, &rays);
        if (bits != 0u || change != 0u) state = CACHE_UPDATE;
        if (update.mask_words == 0u) {
            // Without masks, a packet that is updated traces all its connections.
            if (state == CACHE_UPDATE) break;
            continue;
        }
        if (cache_shift(i) == 0u) word = 0u;
        word |= bits << cache_shift(i);
        if (i + 1u == count || cache_shift(i + 1u) == 0u)
            invalid[cache_word(update.mask_words, number, i)] = word;
    }
    states[number] = state;
    count_rays(counters + range.counter, rays);
}
