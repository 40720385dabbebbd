// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds what the VPLs that light paths have left bring to points that the camera sees, by which few
// of many are chosen (host/pipeline/vpl_selection.h): `points` pixels of each set, a multiple of
// PACKET_BLOCK. A contribution is the luminance of the irradiance at the point, in units of
// 1 / `scale`, with the VPL's bound. One work-item for each VPL.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/film/seen_receiver.h"
#include "kernels/light/vpl_importance.h"

/// The surfaces that LANES pixels show.
static inline ReceiverPacket receivers_of(const RenderParams* params, GLOBAL const uint* ids,
                                          GLOBAL const float4* positions,
                                          GLOBAL const float4* normals,
                                          GLOBAL const float4* shadings,
                                          GLOBAL const float4* albedo, GLOBAL const uint* pixels) {
    float values[10][LANES];
    for (uint lane = 0u; lane < LANES; ++lane) {
        SeenReceiver seen =
            seen_receiver(params, ids, positions, normals, shadings, albedo, pixels[lane]);
        values[0][lane] = seen.position.x;
        values[1][lane] = seen.position.y;
        values[2][lane] = seen.position.z;
        values[3][lane] = seen.shading.x;
        values[4][lane] = seen.shading.y;
        values[5][lane] = seen.shading.z;
        values[6][lane] = seen.normal.x;
        values[7][lane] = seen.normal.y;
        values[8][lane] = seen.normal.z;
        values[9][lane] = seen.valid;
    }
    ReceiverPacket packet;
    packet.position.x = wide_load(values[0], 0);
    packet.position.y = wide_load(values[1], 0);
    packet.position.z = wide_load(values[2], 0);
    packet.shading.x = wide_load(values[3], 0);
    packet.shading.y = wide_load(values[4], 0);
    packet.shading.z = wide_load(values[5], 0);
    packet.normal.x = wide_load(values[6], 0);
    packet.normal.y = wide_load(values[7], 0);
    packet.normal.z = wide_load(values[8], 0);
    packet.valid = wide_load(values[9], 0) > WIDE(0.0f);
    return packet;
}

WEFT_KERNEL(vpl_contribution)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GLOBAL const Vpl* vpl = vpls + item;
    GLOBAL const uint* pixels = view_points + item / params.sampling.walked_per_set * points;
    GLOBAL float* to = contributions + item * points;
    float weight = vpl_weight(vpl, scale);
    uint rays = 0u;
    for (uint first = 0u; first < points; first += (uint)LANES) {
        WFloat light = WIDE(0.0f);
        if (weight > 0.0f) {
            ReceiverPacket packet = receivers_of(&params, gb_ids, gb_position, gb_normal,
                                                 gb_shading, gb_albedo, pixels + first);
            WFloat3 d = from_vpl(&packet, vpl);
            WMask useful;
            WFloat g = connection(&packet, vpl, as_bits(vpl->normal.w), d, &useful);
            if (mask_any(useful)) {
                rays += mask_count(useful);
                WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
                light = SELECT(useful & mask_not(blocked), g * weight, WIDE(0.0f));
            }
        }
        wide_store(light, to, first);
    }
    count_rays(counters + range.counter, rays);
}
