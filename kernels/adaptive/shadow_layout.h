// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory layout of the visibility of area lights, as probes found it, for host and kernels.
#ifndef WEFT_KERNELS_ADAPTIVE_SHADOW_LAYOUT_H
#define WEFT_KERNELS_ADAPTIVE_SHADOW_LAYOUT_H

// Area lights of one word of a visibility mask (visibility_mask.h), a bit each.
#define VISIBILITY_MASK_LIGHTS 32u
// A footprint of 6 x 6 pixels. If all its probes agree, the light is taken to be fully visible or
// fully hidden. SHADOW_BEFORE of its columns and rows come before the pixel's own. With 3 x 3
// interleaving and four samples per light and set, a footprint probes each of a light's samples
// once.
#define SHADOW_FOOTPRINT 6u
#define SHADOW_BEFORE 2u
// Pixels about the image that have no probes: as far as footprints reach beyond it.
#define SHADOW_MARGIN (SHADOW_FOOTPRINT - 1u - SHADOW_BEFORE)
// Rows of visibility masks are padded to whole runs of so many pixels, a multiple of any LANES.
#define SHADOW_RUN 16u

/// Words of a pixel's visibility mask for that many lights.
static inline uint visibility_mask_words(uint lights) {
    return (lights + VISIBILITY_MASK_LIGHTS - 1u) / VISIBILITY_MASK_LIGHTS;
}

/// Words of a row of a plane: whole runs, and a margin on both sides.
static inline uint shadow_pitch(uint width) {
    return (width + SHADOW_RUN - 1u) / SHADOW_RUN * SHADOW_RUN + 2u * SHADOW_MARGIN;
}

/// Words of a plane, which has one word for each pixel of the image and of its margin.
static inline uint shadow_plane(uint width, uint height) {
    return shadow_pitch(width) * (height + 2u * SHADOW_MARGIN);
}

/// Edge of a cell in pixels: a square from which one work-item of soft_shadows.cl takes the pixels
/// of a set. They are as many as pack well where packets are wide.
static inline uint shadow_cell(uint lanes, uint interleave) {
    return lanes * interleave;
}

#endif
