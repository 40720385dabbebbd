// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// How what pixels saw of area lights lies in memory, for host and kernels.
#ifndef WEFT_SHADOW_LAYOUT_H
#define WEFT_SHADOW_LAYOUT_H

// Area lights of one word of what pixels saw (shadow_words.h), a bit each.
#define SHADOW_WORD_LIGHTS 32u
// Edge of a pixel's window, within which all must have seen the same of a light, and how many of
// its columns and rows come before the pixel's own. With 3 x 3 interleaving a window holds one look
// at every sample of four a light and set.
#define SHADOW_WINDOW 6u
#define SHADOW_BEFORE 2u
// Pixels that rows of what pixels saw are whole numbers of, a multiple of any LANES.
#define SHADOW_RUN 16u
// Planes of shadow_edges.cl, of words of 32 lights: whether a pixel is at an edge of a light's
// shadow, and whether its window leaves that light in doubt.
#define SHADOW_EDGE 0u
#define SHADOW_DOUBT 1u
#define SHADOW_PLANES 2u
// Binary digits of how many of a window's pixels saw a light.
#define SHADOW_DIGITS 6u

// What the windows of pixels tell of 32 lights: by digit, how many of them saw it, and did not.
typedef struct {
    uint lit[SHADOW_DIGITS], dark[SHADOW_DIGITS];
} ShadowCounts;

/// Words of a pixel for that many lights.
static inline uint shadow_words(uint lights) {
    return (lights + SHADOW_WORD_LIGHTS - 1u) / SHADOW_WORD_LIGHTS;
}

/// Pixels of a row or column after which first looks at lights repeat (shadow_look).
static inline uint shadow_period(uint interleave) {
    return 2u * interleave;
}

/// Pixels about the picture in which nothing is seen.
static inline uint shadow_margin(uint interleave) {
    return SHADOW_WINDOW - 1u - SHADOW_BEFORE + shadow_period(interleave);
}

/// Words of a row of what pixels saw: a margin to both sides, and whole runs.
static inline uint shadow_pitch(uint width, uint interleave) {
    return (width + SHADOW_RUN - 1u) / SHADOW_RUN * SHADOW_RUN + 2u * shadow_margin(interleave);
}

/// Words of a picture of what pixels saw.
static inline uint shadow_plane(uint width, uint height, uint interleave) {
    return shadow_pitch(width, interleave) * (height + 2u * shadow_margin(interleave));
}

/// Edge of the square of pixels of which one work-item of soft_shadows.cl takes those of a set: as
/// many as pack well where packets are wide.
static inline uint shadow_cell(uint lanes, uint interleave) {
    return lanes * interleave;
}

#endif
