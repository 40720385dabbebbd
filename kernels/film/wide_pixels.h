// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// LANES pixels that follow one another in a row of the image, worked on at once.
#ifndef WEFT_KERNELS_FILM_WIDE_PIXELS_H
#define WEFT_KERNELS_FILM_WIDE_PIXELS_H

#include "kernels/core/vector.h"
#include "kernels/film/edges.h"

// A work-item's pixels: LANES, or what is left of the row.
typedef struct {
    uint x, y;
    uint first;  // index of the leftmost
    uint count;
} PixelRun;

static inline PixelRun pixel_run(const RenderParams* params, uint item) {
    uint runs = (params->camera.width + LANES - 1u) / LANES;
    PixelRun run;
    run.y = item / runs;
    run.x = (item - run.y * runs) * LANES;
    run.first = run.y * params->camera.width + run.x;
    run.count = params->camera.width - run.x < LANES ? params->camera.width - run.x : LANES;
    return run;
}

/// The bits of the run's pixels in masks of tiles (edges.h), the leftmost in bit 0.
static inline uint run_bits(const RenderParams* params, GLOBAL const uint* masks,
                            const PixelRun* run) {
    uint columns = tile_columns(params);
    uint row = run->y % TILE_EDGE;
    uint shift = row * TILE_EDGE % 32u;
    uint first = 2u * (run->y / TILE_EDGE * columns) + row * TILE_EDGE / 32u;
    uint tile = run->x / TILE_EDGE;
    // A run either covers whole tiles or keeps to one.
    uint bits = (masks[first + 2u * tile] >> shift & 0xFFu) >> run->x % TILE_EDGE;
    for (uint i = 1u; i < LANES / TILE_EDGE; ++i)
        if (tile + i < columns)
            bits |= (masks[first + 2u * (tile + i)] >> shift & 0xFFu) << i * TILE_EDGE;
    return bits & 0xFFFFFFFFu >> (32u - run->count);
}

/// The first three components of LANES vectors.
static inline WFloat3 load_vectors(GLOBAL const float4* vectors) {
    float x[LANES], y[LANES], z[LANES];
    for (uint lane = 0u; lane < LANES; ++lane) {
        float4 v = vectors[lane];
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
    WFloat3 wide;
    wide.x = wide_load(x, 0);
    wide.y = wide_load(y, 0);
    wide.z = wide_load(z, 0);
    return wide;
}

/// Their fourth component.
static inline WFloat load_fourth(GLOBAL const float4* vectors) {
    float w[LANES];
    for (uint lane = 0u; lane < LANES; ++lane) w[lane] = vectors[lane].w;
    return wide_load(w, 0);
}

#endif
