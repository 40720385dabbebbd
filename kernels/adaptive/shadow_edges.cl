// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the edges of area lights' shadows from the visibility that probes found
// (visibility_mask.h): the edge of a light's shadow is at every pixel that has probed the light and
// in whose footprint, 6 x 6 pixels, the probes disagree. Only there does soft_shadows.cl trace
// further rays. One work-item for LANES pixels of a row and 32 lights.
#include "kernels/adaptive/visibility_mask.h"
#include "kernels/core/kernel.h"

/// The lights on which the probes of each lane's footprint disagree, a bit each. `seen` and
/// `hidden` are the masks of the lanes' own pixels.
static inline WWords disputed(GLOBAL const uint* seen, GLOBAL const uint* hidden, int pitch) {
    int before = (int)SHADOW_BEFORE;
    int edge = (int)SHADOW_FOOTPRINT;
    WWords lit = mask_none_set;
    WWords dark = mask_none_set;
    for (int j = -before; j < edge - before; ++j) {
        for (int i = -before; i < edge - before; ++i) {
            lit = lit | load_words(seen + j * pitch + i, 0);
            dark = dark | load_words(hidden + j * pitch + i, 0);
        }
    }
    return lit & dark;
}

WEFT_KERNEL(shadow_edges)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    uint runs = (params.camera.width + (uint)LANES - 1u) / (uint)LANES;
    uint word = item / (runs * params.camera.height);
    uint x = item % runs * (uint)LANES;
    uint y = item / runs % params.camera.height;
    uint place = shadow_place(&params, x, y);
    GLOBAL const uint* seen = pixel_shadows + seen_plane(&params, word) + place;
    GLOBAL const uint* hidden = pixel_shadows + hidden_plane(&params, word) + place;
    WWords probed = load_words(seen, 0) | load_words(hidden, 0);
    uint edges[LANES];
    store_words(disputed(seen, hidden, (int)shadow_pitch(params.camera.width)) & probed, edges, 0);
    uint count = params.camera.width - x < (uint)LANES ? params.camera.width - x : (uint)LANES;
    GLOBAL uint* to = shadow_edges + (word * params.camera.height + y) * params.camera.width + x;
    for (uint lane = 0u; lane < count; ++lane) to[lane] = edges[lane];
}
