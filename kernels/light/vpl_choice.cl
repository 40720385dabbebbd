// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Gathers irradiance from few of many VPLs, without bias: PACKET_BLOCK neighbouring receivers
// choose together by what each VPL would bring them if nothing lay between (resampling, Talbot,
// Cline and Egbert 2005; of the rows of a matrix of lights, Hasan, Pellacini and Bala 2007). Rays
// are traced to the chosen VPLs alone, which count by 1 over the expected number of their choices.
//
// They choose from the list of their region (vpl_shortlist.cl). The importance of a VPL is the
// largest luminance that it would bring to one of the receivers, so that no choice brings a
// receiver more than the sum of importances over the number of choices. Choices are made
// systematically: at equal steps through the importances laid end to end, from a random place in
// the first step on. One work-item for PACKET_BLOCK receivers, whatever the width of packets, so
// that the choices do not depend on it.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/core/random.h"
#include "kernels/light/vpl_importance.h"
#include "kernels/media/packet_media.h"

// Keeps the random numbers of choices apart from those of paths through the same receivers.
#define CHOICE_SEED 0x9B05688Cu

/// Stores the importances of the VPLs and returns their sum. Luminance is in units of 1 / `scale`.
static inline float find_importances(const ReceiverPacket* packets, GLOBAL const Vpl* vpls,
                                     uint count, float scale, float* importances) {
    float sum = 0.0f;
    for (uint i = 0u; i < count; ++i) {
        importances[i] = vpl_importance(packets, vpls + i, scale);
        sum += importances[i];
    }
    return sum;
}

/// Makes all importances that are above 0 the same, and returns their sum.
static inline float make_equal(float* importances, uint count) {
    float sum = 0.0f;
    for (uint i = 0u; i < count; ++i) {
        importances[i] = importances[i] > 0.0f ? 1.0f : 0.0f;
        sum += importances[i];
    }
    return sum;
}

WEFT_KERNEL(vpl_choice)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = (range.first + WORK_ITEM(range)) * PACKET_BLOCK;
    SCENE_MAKE(scene);
    ReceiverPacket packets[BLOCK_PACKETS];
    WideLight light[BLOCK_PACKETS];
    int any = 0;
    for (uint k = 0u; k < BLOCK_PACKETS; ++k) {
        packets[k] = load_receivers(&params, receiver_planes, slots, slot + k * LANES);
        light[k] = no_light();
        if (mask_any(packets[k].valid)) any = 1;
    }
    float importances[MAX_CHOICE_VPLS];
    uint count = any != 0 ? list_length : 0u;
    GLOBAL const Vpl* list = shortlists + slot / region_slots * list_length;
    float sum = find_importances(packets, list, count, scale, importances);
    if (!(sum < RAY_INFINITY)) sum = make_equal(importances, count);
    Random random = make_random(params.sampling.seed ^ CHOICE_SEED, slot, params.sampling.sample);
    float step = sum / (float)choices;
    float place = next_random(&random);
    float passed = 0.0f;
    uint drawn = 0u;
    uint rays = 0u;
    for (uint i = 0u; i < count; ++i) {
        passed += importances[i];
        uint before = drawn;
        while (drawn < choices && ((float)drawn + place) * step < passed) ++drawn;
        if (drawn == before) continue;
        GLOBAL const Vpl* vpl = list + i;
        float weight = (float)(drawn - before) * (step / importances[i]);
        for (uint k = 0u; k < BLOCK_PACKETS; ++k) {
            WFloat3 d = from_vpl(packets + k, vpl);
            WMask useful;
            WFloat g = connection(packets + k, vpl, as_bits(vpl->normal.w), d, &useful);
            if (!mask_any(useful)) continue;
            rays += mask_count(useful);
            WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
            WFloat carried = SELECT(useful & mask_not(blocked), g * weight, WIDE(0.0f));
            light[k].red = light[k].red + carried * vpl->flux.x;
            light[k].green = light[k].green + carried * vpl->flux.y;
            light[k].blue = light[k].blue + carried * vpl->flux.z;
        }
    }
    for (uint k = 0u; k < BLOCK_PACKETS; ++k)
        store_light(light + k, 1.0f, slots, slot + k * LANES, irradiance);
    count_rays(counters + range.counter, rays);
}
