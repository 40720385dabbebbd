// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Area lights in groups, light l of n belonging to group l g / n of g, and what is kept of how
// pixels see them: words of a picture with a margin of SHADOW_REACH pixels, in which nothing is
// seen or hidden.
#ifndef WEFT_SHADOW_GROUPS_H
#define WEFT_SHADOW_GROUPS_H

#include "port.h"
#include "types.h"

/// First light of a group; that of the group after the last is the number of lights.
static inline uint shadow_group_light(const Params* params, uint group) {
    uint lights = params->sampled_lights;
    return (group * lights + params->shadow_groups - 1u) / params->shadow_groups;
}

/// Number of the sample of every light that a packet's pixels look at first. It differs between the
/// four nearest pixels of a set, so that those of a window look at most of what all of them share;
/// a packet holds pixels that look at the same.
static inline uint shadow_start(const Params* params, GLOBAL const uint* slot_pixel, uint slot,
                                uint set) {
    uint pixel = NO_TRIANGLE;
    for (uint lane = 0u; lane < (uint)LANES && pixel == NO_TRIANGLE; ++lane)
        pixel = slot_pixel[slot + lane];
    uint column = pixel % params->width / params->interleave;
    uint row = pixel / params->width / params->interleave;
    return (set + column % 2u + row % 2u * 2u) % params->samples_per_light;
}

/// Place of a pixel's word.
static inline uint shadow_place(const Params* params, uint pixel) {
    return (pixel / params->width + SHADOW_REACH) * shadow_pitch(params->width) +
           pixel % params->width + SHADOW_REACH;
}

#endif
