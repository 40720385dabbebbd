// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Where shadows end, from what pixels saw of lights with one ray each (shadow_words.h): an edge of
// a light's shadow is at every pixel that looked at it and in whose window, 6 x 6 pixels, not all
// saw the same. Only there are further rays worth their time (soft_shadows.cl). One work-item for
// LANES pixels of a row and 32 lights.
#include "kernels/adaptive/shadow_words.h"
#include "kernels/core/kernel.h"

/// The lights that any pixel of the windows saw, and any did not; `seen` and `hidden` are the words
/// of the windows' own pixels.
static inline WWords disputed(GLOBAL const uint* seen, GLOBAL const uint* hidden, int pitch) {
    int before = (int)SHADOW_BEFORE;
    int edge = (int)SHADOW_WINDOW;
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
    WWords looked = load_words(seen, 0) | load_words(hidden, 0);
    uint edges[LANES];
    store_words(disputed(seen, hidden, (int)shadow_pitch(params.camera.width)) & looked, edges, 0);
    uint count = params.camera.width - x < (uint)LANES ? params.camera.width - x : (uint)LANES;
    GLOBAL uint* to = shadow_edges + (word * params.camera.height + y) * params.camera.width + x;
    for (uint lane = 0u; lane < count; ++lane) to[lane] = edges[lane];
}
