// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Masks of irradiance records, a bit for each record and VPL: which VPLs a record sees, and which
// connections are invalid. A packet of records has RecordUpdate::mask_words words, with LANES bits
// for each VPL, the first VPL in the lowest.
#ifndef WEFT_KERNELS_CACHE_CACHE_MASKS_H
#define WEFT_KERNELS_CACHE_CACHE_MASKS_H

#include "kernels/cache/cache.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

#define ALL_LANES ((1u << (uint)LANES) - 1u)
#define CACHE_VPLS_PER_WORD (32u / (uint)LANES)

/// Index of the word that holds the bits of a VPL.
static inline uint cache_word(uint words, uint packet, uint vpl) {
    return packet * words + vpl / CACHE_VPLS_PER_WORD;
}

/// Position of those bits in the word.
static inline uint cache_shift(uint vpl) {
    return vpl % CACHE_VPLS_PER_WORD * (uint)LANES;
}

static inline uint lanes_of_word(uint word, uint vpl) {
    return word >> cache_shift(vpl) & ALL_LANES;
}

#endif
