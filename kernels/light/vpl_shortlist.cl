// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes a short list of VPLs for each region of the work list, from which the blocks of receivers
// in the region choose (vpl_choice.cl). Light paths are cheap, and many of them make the light of a
// whole image even; but weighing the VPLs of all of them for every block is not cheap. VPLs are
// chosen without bias, as there, by what they would bring if nothing lay between, here to
// PACKET_BLOCK receivers that are spread evenly over the region. Since these stand for many others,
// a part of the probability goes by flux alone. A VPL on a list has its flux over the expected
// number of its choices.
//
// One work-item per region of `region_slots` receivers, which makes a list of `list_length` VPLs;
// those that it has no use for are dark.
#include "kernels/core/kernel.h"
#include "kernels/core/random.h"
#include "kernels/light/vpl_importance.h"

// Keeps the random numbers of lists apart from those of other choices.
#define SHORTLIST_SEED 0x1F83D9ABu

// Share of the probability that goes by flux alone.
#define BY_FLUX 0.2f

/// LANES receivers, `step` slots apart from `slot` on.
static inline ReceiverPacket spread_receivers(const RenderParams* params,
                                              GLOBAL const float* planes, uint stride, uint slot,
                                              uint step) {
    float values[RECEIVER_PLANES_SMOOTH][LANES];
    uint count =
        HAS(params, FEATURE_SMOOTH_NORMALS) ? RECEIVER_PLANES_SMOOTH : RECEIVER_PLANES_FLAT;
    for (uint plane = 0u; plane < count; ++plane)
        for (uint lane = 0u; lane < LANES; ++lane)
            values[plane][lane] = planes[plane * stride + slot + lane * step];
    ReceiverPacket packet;
    packet.position.x = wide_load(values[RECEIVER_X], 0);
    packet.position.y = wide_load(values[RECEIVER_Y], 0);
    packet.position.z = wide_load(values[RECEIVER_Z], 0);
    packet.shading.x = wide_load(values[RECEIVER_SHADING_X], 0);
    packet.shading.y = wide_load(values[RECEIVER_SHADING_Y], 0);
    packet.shading.z = wide_load(values[RECEIVER_SHADING_Z], 0);
    packet.normal = packet.shading;
    if (HAS(params, FEATURE_SMOOTH_NORMALS)) {
        packet.normal.x = wide_load(values[RECEIVER_NORMAL_X], 0);
        packet.normal.y = wide_load(values[RECEIVER_NORMAL_Y], 0);
        packet.normal.z = wide_load(values[RECEIVER_NORMAL_Z], 0);
    }
    packet.valid = wide_load(values[RECEIVER_VALID], 0) > WIDE(0.0f);
    return packet;
}

/// `part` / `whole`, or 0 where there is nothing or too much to divide.
static inline float share_of(float part, float whole) {
    return whole > 0.0f && whole < RAY_INFINITY ? part / whole : 0.0f;
}

WEFT_KERNEL(vpl_shortlist)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint region = range.first + WORK_ITEM(range);
    uint first = region * region_slots;
    uint step = (slots - first < region_slots ? slots - first : region_slots) / PACKET_BLOCK;
    Random random =
        make_random(params.sampling.seed ^ SHORTLIST_SEED, region, params.sampling.sample);
    first += (uint)(next_random(&random) * (float)step);
    ReceiverPacket packets[BLOCK_PACKETS];
    for (uint k = 0u; k < BLOCK_PACKETS; ++k)
        packets[k] =
            spread_receivers(&params, receiver_planes, slots, first + k * LANES * step, step);
    float flux_sum = 0.0f;
    float importance_sum = 0.0f;
    for (uint i = 0u; i < vpl_count; ++i) {
        flux_sum += vpl_weight(vpls + i, scale);
        importance_sum += vpl_importance(packets, vpls + i, scale);
    }
    // Where the receivers tell nothing, all goes by flux.
    float by_flux = importance_sum > 0.0f && importance_sum < RAY_INFINITY ? BY_FLUX : 1.0f;
    GLOBAL Vpl* list = shortlists + region * list_length;
    float place = next_random(&random);
    float passed = 0.0f;
    uint drawn = 0u;
    uint length = 0u;
    for (uint i = 0u; i < vpl_count && drawn < list_length; ++i) {
        float probability =
            by_flux * share_of(vpl_weight(vpls + i, scale), flux_sum) +
            (1.0f - by_flux) * share_of(vpl_importance(packets, vpls + i, scale), importance_sum);
        passed += probability * (float)list_length;
        uint before = drawn;
        while (drawn < list_length && (float)drawn + place < passed) ++drawn;
        if (drawn == before) continue;
        float weight = (float)(drawn - before) / (probability * (float)list_length);
        Vpl vpl = vpls[i];
        vpl.flux = f4(vpl.flux.x * weight, vpl.flux.y * weight, vpl.flux.z * weight, vpl.flux.w);
        list[length++] = vpl;
    }
    for (; length < list_length; ++length) list[length].flux = f4(0.0f, 0.0f, 0.0f, 1.0f);
}
