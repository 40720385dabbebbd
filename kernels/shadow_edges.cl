// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Where shadows end: the groups of lights of which a pixel and those about it, SHADOW_REACH to
// every side, have not all seen the same in shadow_probes.cl. One work-item for SHADOW_RUN pixels
// of a row; `shadow_edges` has a word a pixel, a bit a group.
#include "port.h"
#include "types.h"

WEFT_KERNEL(shadow_edges)
(PARAMS, GLOBAL const uint* pixel_shadows, GLOBAL uint* shadow_edges) {
    if (GLOBAL_ID >= params.count) return;
    uint run = params.first + GLOBAL_ID;
    uint runs = (params.width + SHADOW_RUN - 1u) / SHADOW_RUN;
    uint x = run % runs * SHADOW_RUN;
    uint y = run / runs;
    uint pitch = shadow_pitch(params.width);
    GLOBAL const uint* row = pixel_shadows + y * pitch + x;
    uint columns[SHADOW_RUN + 2u * SHADOW_REACH];
    for (uint i = 0u; i < SHADOW_RUN + 2u * SHADOW_REACH; ++i) columns[i] = row[i];
    for (uint j = 0u; j < 2u * SHADOW_REACH; ++j) {
        row += pitch;
        for (uint i = 0u; i < SHADOW_RUN + 2u * SHADOW_REACH; ++i) columns[i] |= row[i];
    }
    uint count = params.width - x < SHADOW_RUN ? params.width - x : SHADOW_RUN;
    for (uint i = 0u; i < count; ++i) {
        uint all = 0u;
        for (uint j = 0u; j <= 2u * SHADOW_REACH; ++j) all |= columns[i + j];
        shadow_edges[y * params.width + x + i] = all & all >> SHADOW_HIDDEN;
    }
}
