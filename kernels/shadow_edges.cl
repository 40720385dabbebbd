// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Where shadows end, from what pixels saw of lights with one ray each (shadow_words.h): an edge of
// a light's shadow is at every pixel that looked at it and in whose window, 6 x 6 pixels, not all
// saw the same. There the window's looks together tell how much of the light is seen, since they
// are looks at all of its samples, but where they do not speak of one place:
//  - pixels that are one period apart look at the same sample; where many of them disagree the
//    shadow begins or ends within few pixels;
//  - a pixel disagrees with both that lie a period off on a line, or with one where the other is
//    beyond the picture, which a shadow that begins or ends cannot cause: one narrower than that
//    can;
//  - a whole row or column is dark and another one lit: bars whose distance is the period;
//  - pixels did not look, since they show other surfaces or none.
// There the light is in doubt; without shadow_trust it is at all edges. One work-item for LANES
// pixels of a row and 32 lights.
#include "shadow_words.h"

// What is known of LANES windows, by light: whether a shadow is narrow, whether all pixels of any
// column saw it or did not; the binary digits of how many pixels saw it, did not, and do not speak
// of one place.
typedef struct {
    WWords narrow;
    WWords lit_line, dark_line;
    WWords lit[SHADOW_DIGITS], dark[SHADOW_DIGITS], astray[SHADOW_DIGITS];
} ShadowWindows;

// Rows of the windows of which all pixels saw a light, or did not.
typedef struct {
    WWords seen[SHADOW_WINDOW], hidden[SHADOW_WINDOW];
} RowLines;

/// The words of pixels about those of the work-item.
typedef struct {
    GLOBAL const uint* seen;
    GLOBAL const uint* hidden;
} ShadowWords;

static inline ShadowWords words_off(ShadowWords words, int offset) {
    words.seen += offset;
    words.hidden += offset;
    return words;
}

/// Adds one to the numbers whose bits are set in `one`.
static inline void count_words(WWords one, WWords* digits) {
    for (uint k = 0u; k < SHADOW_DIGITS; ++k) {
        WWords carry = digits[k] & one;
        digits[k] = digits[k] ^ one;
        one = carry;
    }
}

// Whether what lies a period off to each side is beyond the picture; all bits of a lane or none.
typedef struct {
    WWords left, right, above, below;
} Beyond;

/// Of the pixels from (x, y) on, of which some may be beyond the picture themselves.
static inline Beyond beyond_picture(const Params* params, int x, int y) {
    int period = (int)shadow_period(params->interleave);
    Beyond beyond;
    beyond.left = beyond.right = mask_none_set;
    beyond.above = y < period ? ~mask_none_set : mask_none_set;
    beyond.below = y + period >= (int)params->height ? ~mask_none_set : mask_none_set;
    if (x >= period && x + LANES + period <= (int)params->width) return beyond;
    uint left[LANES];
    uint right[LANES];
    for (int lane = 0; lane < LANES; ++lane) {
        left[lane] = x + lane < period ? 0xFFFFFFFFu : 0u;
        right[lane] = x + lane + period >= (int)params->width ? 0xFFFFFFFFu : 0u;
    }
    beyond.left = load_words(left, 0);
    beyond.right = load_words(right, 0);
    return beyond;
}

/// The lights that two pixels looked at and saw differently.
static inline WWords disagreement(WWords seen, WWords known, ShadowWords other) {
    WWords s = load_words(other.seen, 0);
    WWords h = load_words(other.hidden, 0);
    return known & (s | h) & (seen ^ s);
}

/// The lights of which pixels find something else than both sides, as far as these are inside.
static inline WWords stands_alone(WWords a, WWords beyond_a, WWords b, WWords beyond_b) {
    return (a & (b | beyond_b)) | (b & beyond_a);
}

/// Adds the column of windows whose pixels, from (x, y) on, are at `words`.
static inline void add_column(const Params* params, int x, int y, ShadowWords words, int first,
                              ShadowWindows* windows, RowLines* rows) {
    int period = (int)shadow_period(params->interleave);
    int pitch = (int)shadow_pitch(params->width, params->interleave);
    WWords all_seen = ~mask_none_set;
    WWords all_hidden = ~mask_none_set;
    for (int j = 0; j < (int)SHADOW_WINDOW; ++j, words = words_off(words, pitch)) {
        WWords s = load_words(words.seen, 0);
        WWords h = load_words(words.hidden, 0);
        WWords left = disagreement(s, s | h, words_off(words, -period));
        WWords right = disagreement(s, s | h, words_off(words, period));
        WWords above = disagreement(s, s | h, words_off(words, -period * pitch));
        WWords below = disagreement(s, s | h, words_off(words, period * pitch));
        Beyond beyond = beyond_picture(params, x, y + j);
        all_seen = all_seen & s;
        all_hidden = all_hidden & h;
        rows->seen[j] = first != 0 ? s : rows->seen[j] & s;
        rows->hidden[j] = first != 0 ? h : rows->hidden[j] & h;
        windows->narrow = windows->narrow | stands_alone(left, beyond.left, right, beyond.right) |
                          stands_alone(above, beyond.above, below, beyond.below);
        count_words(s, windows->lit);
        count_words(h, windows->dark);
        count_words(left | right | above | below | ~(s | h), windows->astray);
    }
    windows->lit_line = windows->lit_line | all_seen;
    windows->dark_line = windows->dark_line | all_hidden;
}

/// The lights that any pixel of the windows about `own` saw and any did not.
static inline WWords disputed(ShadowWords own, int pitch) {
    int before = (int)SHADOW_BEFORE;
    int edge = (int)SHADOW_WINDOW;
    WWords seen = mask_none_set;
    WWords hidden = mask_none_set;
    for (int j = -before; j < edge - before; ++j) {
        for (int i = -before; i < edge - before; ++i) {
            ShadowWords words = words_off(own, j * pitch + i);
            seen = seen | load_words(words.seen, 0);
            hidden = hidden | load_words(words.hidden, 0);
        }
    }
    return seen & hidden;
}

/// Of which nothing is known yet.
static inline ShadowWindows no_windows(void) {
    ShadowWindows windows;
    windows.narrow = mask_none_set;
    windows.lit_line = windows.dark_line = mask_none_set;
    for (uint k = 0u; k < SHADOW_DIGITS; ++k)
        windows.lit[k] = windows.dark[k] = windows.astray[k] = mask_none_set;
    return windows;
}

/// The lights of which the windows leave in doubt how much is seen.
static inline WWords doubts(const ShadowWindows* windows, const RowLines* rows) {
    WWords lit_row = mask_none_set;
    WWords dark_row = mask_none_set;
    for (uint j = 0u; j < SHADOW_WINDOW; ++j) {
        lit_row = lit_row | rows->seen[j];
        dark_row = dark_row | rows->hidden[j];
    }
    WWords bars = (windows->lit_line & windows->dark_line) | (lit_row & dark_row);
    // More than half of 36.
    const WWords* n = windows->astray;
    WWords most = n[5] | (n[4] & (n[3] | n[2] | (n[1] & n[0])));
    return windows->narrow | bars | most;
}

/// Writes a plane's words of the first `count` lanes.
static inline void store_some(WWords words, uint count, GLOBAL uint* plane) {
    uint lanes[LANES];
    store_words(words, lanes, 0);
    for (uint lane = 0u; lane < count; ++lane) plane[lane] = lanes[lane];
}

/// Writes what the windows of lanes with edges tell.
static inline void store_counts(const ShadowWindows* windows, WWords edges,
                                GLOBAL ShadowCounts* counts) {
    uint lanes = mask_bits(edges != mask_none_set);
    uint lit[SHADOW_DIGITS][LANES];
    uint dark[SHADOW_DIGITS][LANES];
    for (uint k = 0u; k < SHADOW_DIGITS; ++k) {
        store_words(windows->lit[k], lit[k], 0);
        store_words(windows->dark[k], dark[k], 0);
    }
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        if ((lanes >> lane & 1u) == 0u) continue;
        for (uint k = 0u; k < SHADOW_DIGITS; ++k) {
            counts[lane].lit[k] = lit[k][lane];
            counts[lane].dark[k] = dark[k][lane];
        }
    }
}

WEFT_KERNEL(shadow_edges)
(PARAMS, GLOBAL const uint* pixel_shadows, GLOBAL uint* shadow_edges,
 GLOBAL ShadowCounts* shadow_counts) {
    if (GLOBAL_ID >= params.count) return;
    uint item = params.first + GLOBAL_ID;
    uint runs = (params.width + (uint)LANES - 1u) / (uint)LANES;
    uint word = item / (runs * params.height);
    uint x = item % runs * (uint)LANES;
    uint y = item / runs % params.height;
    int pitch = (int)shadow_pitch(params.width, params.interleave);
    uint place = shadow_place(&params, x, y);
    ShadowWords own;
    own.seen = pixel_shadows + seen_plane(&params, word) + place;
    own.hidden = pixel_shadows + hidden_plane(&params, word) + place;
    uint count = params.width - x < (uint)LANES ? params.width - x : (uint)LANES;
    uint pixels = params.width * params.height;
    GLOBAL uint* planes = shadow_edges + SHADOW_PLANES * word * pixels + y * params.width + x;
    WWords looked = load_words(own.seen, 0) | load_words(own.hidden, 0);
    // Pixels beyond the picture's end have not looked at anything.
    WWords edges = disputed(own, pitch) & looked;
    store_some(edges, count, planes + SHADOW_EDGE * pixels);
    // Windows that are not trusted need not be looked into.
    if (params.shadow_trust == 0u || !mask_any(edges != mask_none_set)) {
        store_some(edges, count, planes + SHADOW_DOUBT * pixels);
        return;
    }
    ShadowWindows windows = no_windows();
    RowLines rows;
    int before = (int)SHADOW_BEFORE;
    for (int i = -before; i < (int)SHADOW_WINDOW - before; ++i)
        add_column(&params, (int)x + i, (int)y - before, words_off(own, i - before * pitch),
                   i == -before ? 1 : 0, &windows, &rows);
    WWords doubtful = edges & doubts(&windows, &rows);
    store_some(doubtful, count, planes + SHADOW_DOUBT * pixels);
    store_counts(&windows, edges, shadow_counts + word * pixels + y * params.width + x);
}
