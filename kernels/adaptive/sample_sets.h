// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells which sample sets a receiver gathers: interleaved sampling.
#ifndef WEFT_KERNELS_ADAPTIVE_SAMPLE_SETS_H
#define WEFT_KERNELS_ADAPTIVE_SAMPLE_SETS_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// The set of the receivers in the block of `slot`; sets change places from sample to sample.
static inline uint receiver_set(const RenderParams* params, GLOBAL const uint* block_set,
                                uint slot) {
    const SamplingParams* sampling = &params->sampling;
    return (block_set[slot / PACKET_BLOCK] + sampling->set_rotation) % sampling->gather_sets;
}

/// How many sets a receiver gathers, from receiver_set on: all where the plan does not interleave.
static inline uint receiver_sets(const RenderParams* params) {
    return params->sampling.gather_sets == 1u ? params->sampling.sets : 1u;
}

#endif
