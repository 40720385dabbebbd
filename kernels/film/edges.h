// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Masks of edge pixels: two words a tile of TILE_EDGE x TILE_EDGE pixels, as in TileRecord.
#ifndef WEFT_KERNELS_FILM_EDGES_H
#define WEFT_KERNELS_FILM_EDGES_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"

static inline uint tile_columns(const RenderParams* params) {
    return (params->camera.width + TILE_EDGE - 1u) / TILE_EDGE;
}

/// 1 where the masks have the pixel's bit.
static inline int is_edge_pixel(const RenderParams* params, GLOBAL const uint* edge_masks,
                                uint pixel) {
    uint x = pixel % params->camera.width;
    uint y = pixel / params->camera.width;
    uint tile = y / TILE_EDGE * tile_columns(params) + x / TILE_EDGE;
    uint bit = y % TILE_EDGE * TILE_EDGE + x % TILE_EDGE;
    return (int)(edge_masks[2u * tile + bit / 32u] >> (bit % 32u) & 1u);
}

#endif
