// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// How what pixels saw of area lights lies in memory, for host and kernels.
#ifndef WEFT_KERNELS_ADAPTIVE_SHADOW_LAYOUT_H
#define WEFT_KERNELS_ADAPTIVE_SHADOW_LAYOUT_H

// Area lights of one word of what pixels saw (shadow_words.h), a bit each.
#define SHADOW_WORD_LIGHTS 32u
// Edge of a pixel's window, within which all must have seen the same of a light, and how many of
// its columns and rows come before the pixel's own. With 3 x 3 interleaving a window holds one look
// at every sample of four a light and set.
#define SHADOW_WINDOW 6u
#define SHADOW_BEFORE 2u
// Pixels about the picture in which nothing is seen: as far as windows reach beyond it.
#define SHADOW_MARGIN (SHADOW_WINDOW - 1u - SHADOW_BEFORE)
// Pixels that rows of what pixels saw are whole numbers of, a multiple of any LANES.
#define SHADOW_RUN 16u

/// Words of a pixel for that many lights.
static inline uint shadow_words(uint lights) {
    return (lights + SHADOW_WORD_LIGHTS - 1u) / SHADOW_WORD_LIGHTS;
}

/// Words of a row of what pixels saw: a margin to both sides, and whole runs.
static inline uint shadow_pitch(uint width) {
    return (width + SHADOW_RUN - 1u) / SHADOW_RUN * SHADOW_RUN + 2u * SHADOW_MARGIN;
}

/// Words of a picture of what pixels saw.
static inline uint shadow_plane(uint width, uint height) {
    return shadow_pitch(width) * (height + 2u * SHADOW_MARGIN);
}

/// Edge of the square of pixels of which one work-item of soft_shadows.cl takes those of a set: as
/// many as pack well where packets are wide.
static inline uint shadow_cell(uint lanes, uint interleave) {
    return lanes * interleave;
}

#endif
