// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What VPLs may bring to a block of PACKET_BLOCK receivers, by which few of many are chosen
// (vpl_choice.cl, vpl_shortlist.cl) or traced (vpl_roulette.cl). A block is as many packets as hold
// it, so that its choices do not depend on the width of packets.
#ifndef WEFT_KERNELS_LIGHT_VPL_IMPORTANCE_H
#define WEFT_KERNELS_LIGHT_VPL_IMPORTANCE_H

#include "kernels/light/connection.h"

#define BLOCK_PACKETS (PACKET_BLOCK / LANES)

/// Luminance of the VPL's flux times `scale`, which brings the scene's light to about 1.
static inline float vpl_weight(GLOBAL const Vpl* vpl, float scale) {
    return luminance(xyz(vpl->flux) * scale);
}

/// Largest geometry term of the VPL with a receiver of the block, 0 where it lights none.
static inline float largest_connection(const ReceiverPacket* packets, GLOBAL const Vpl* vpl) {
    WFloat most = WIDE(0.0f);
    for (uint k = 0u; k < BLOCK_PACKETS; ++k) {
        WMask useful;
        WFloat g = connection(packets + k, vpl, as_bits(vpl->normal.w), from_vpl(packets + k, vpl),
                              &useful);
        g = SELECT(useful, g, WIDE(0.0f));
        most = VMAX(most, g);
    }
    return wide_highest(most);
}

/// The most that the VPL would bring to a receiver of the block if nothing lay between, as
/// luminance in units of 1 / `scale`.
static inline float vpl_importance(const ReceiverPacket* packets, GLOBAL const Vpl* vpl,
                                   float scale) {
    float weight = vpl_weight(vpl, scale);
    return weight > 0.0f ? largest_connection(packets, vpl) * weight : 0.0f;
}

#endif
