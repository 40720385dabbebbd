// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What pixels saw of area lights with one ray each (shadow_probes.cl), a bit a light: for every 32
// lights a plane of words of the lights that were seen, and one of those that were hidden. Planes
// have a margin about the picture (SHADOW_MARGIN), in which nothing is seen or hidden.
#ifndef WEFT_KERNELS_ADAPTIVE_SHADOW_WORDS_H
#define WEFT_KERNELS_ADAPTIVE_SHADOW_WORDS_H

#include "kernels/adaptive/shadow_layout.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// Number of the sample of every light of its `set` that a pixel looks at first, by the column and
/// row of its square of interleaved pixels. It differs between the four nearest pixels of a set, so
/// that those of a window look at most of what all of them share.
static inline uint shadow_look(const RenderParams* params, uint column, uint row, uint set) {
    return (set + column % 2u + row % 2u * 2u) % params->sampling.lights.per_light;
}

/// Place of a pixel in a plane.
static inline uint shadow_place(const RenderParams* params, uint x, uint y) {
    return (y + SHADOW_MARGIN) * shadow_pitch(params->camera.width) + x + SHADOW_MARGIN;
}

/// Where the words of the lights that were seen begin, of 32 lights from 32 `word` on.
static inline uint seen_plane(const RenderParams* params, uint word) {
    return 2u * word * shadow_plane(params->camera.width, params->camera.height);
}

/// Where the words of the lights that were hidden begin.
static inline uint hidden_plane(const RenderParams* params, uint word) {
    return (2u * word + 1u) * shadow_plane(params->camera.width, params->camera.height);
}

#endif
