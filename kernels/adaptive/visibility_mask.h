// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The visibility of area lights, as probes found it (shadow_probes.cl), one bit per pixel and
// light. For every 32 lights there is a plane of words for the lights that are visible, and one for
// those that are hidden; a light that a pixel could not probe is in neither. Planes have a margin
// about the image (SHADOW_MARGIN), in which all bits are 0.
#ifndef WEFT_KERNELS_ADAPTIVE_VISIBILITY_MASK_H
#define WEFT_KERNELS_ADAPTIVE_VISIBILITY_MASK_H

#include "kernels/adaptive/shadow_layout.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// Number of the sample of every light of its `set` that a pixel's probe begins with, by the column
/// and row of its square of interleaved pixels. It differs between the four nearest pixels of a
/// set, so that a footprint probes most of the samples that its pixels share.
static inline uint probed_sample(const RenderParams* params, uint column, uint row, uint set) {
    return (set + column % 2u + row % 2u * 2u) % params->sampling.lights.per_light;
}

/// Index of a pixel in a plane.
static inline uint shadow_place(const RenderParams* params, uint x, uint y) {
    return (y + SHADOW_MARGIN) * shadow_pitch(params->camera.width) + x + SHADOW_MARGIN;
}

/// First word of the plane of visible lights, for the 32 lights from 32 `word` on.
static inline uint seen_plane(const RenderParams* params, uint word) {
    return 2u * word * shadow_plane(params->camera.width, params->camera.height);
}

/// First word of the plane of hidden lights, likewise.
static inline uint hidden_plane(const RenderParams* params, uint word) {
    return (2u * word + 1u) * shadow_plane(params->camera.width, params->camera.height);
}

#endif
