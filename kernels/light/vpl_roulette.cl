// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Decides which VPLs of their set PACKET_BLOCK neighbouring receivers trace: Russian roulette (Arvo
// and Kirk 1990). VPLs that would bring none of them more than `level`, `roulette` times the mean
// over the set's VPLs, are traced by chance and then count for more. The receivers of a block
// decide together, so that packets are full or left out: a ray costs half as much in a full packet
// as in a sparse one. A VPL's random number is the same for all blocks, so that the error has no
// noise: it is smooth but for steps of the size of one small contribution.
//
// A byte for each VPL, four a word, is the probability with which it survived in steps of 1 / 255,
// or 0 where it is not traced. One work-item for each block, whatever the width of packets.
#include "kernels/adaptive/sample_sets.h"
#include "kernels/core/kernel.h"
#include "kernels/light/vpl_importance.h"
#include "kernels/light/vpl_survival.h"

// Importances that are kept between the two passes; those of longer lists are found again.
#define KEPT 256u

WEFT_KERNEL(vpl_roulette)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint block = range.first + WORK_ITEM(range);
    uint slot = block * PACKET_BLOCK;
    ReceiverPacket packets[BLOCK_PACKETS];
    for (uint k = 0u; k < BLOCK_PACKETS; ++k)
        packets[k] = load_receivers(&params, receiver_planes, slots, slot + k * LANES);
    GLOBAL const Vpl* vpl =
        vpls + list.first + receiver_set(&params, block_set, slot) * list.stride;
    float kept[KEPT];
    float sum = 0.0f;
    for (uint i = 0u; i < list.length; ++i) {
        float importance = vpl_importance(packets, vpl + i, scale);
        if (i < KEPT) kept[i] = importance;
        sum += importance;
    }
    float level = sum * (roulette / (float)list.length);
    GLOBAL uint* to = survival + block * SURVIVAL_WORDS(list.length);
    uint word = 0u;
    for (uint i = 0u; i < list.length; ++i) {
        float importance = i < KEPT ? kept[i] : vpl_importance(packets, vpl + i, scale);
        word |= survival_byte(importance, level, vpl[i].flux.w) << (8u * (i % 4u));
        if (i % 4u == 3u || i + 1u == list.length) {
            to[i / 4u] = word;
            word = 0u;
        }
    }
}
