// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Undersampled irradiance: only pixels whose coordinates are multiples of a stride, the lattice
// points, have samples. Strides are 1, 2 and 4; they and the 3 x 3 interleaving have no common
// divisor, so every 3 x 3 lattice points hold all nine sample sets. A pixel's irradiance is
// interpolated linearly between the means of 3 x 3 lattice points, which makes four taps per row
// and column.
#ifndef WEFT_KERNELS_ADAPTIVE_LATTICE_H
#define WEFT_KERNELS_ADAPTIVE_LATTICE_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"

#define LATTICE_TAPS 4u

// Taps along one axis: lattice points `first`, `first` + 1 ...
typedef struct {
    int first;
    float weight[LATTICE_TAPS];  // their sum is 1
} LatticeTaps;

/// Lattice points along an axis of `size` pixels.
static inline int lattice_size(int size, int stride) {
    return (size - 1) / stride + 1;
}

/// Taps of the pixel at coordinate `at` of `size`. Beyond the outermost mean of 3 x 3 points that
/// mean is continued, so that no tap lies outside the image if it is at least 3 lattice points
/// wide.
static inline LatticeTaps lattice_taps(int at, int stride, int size) {
    LatticeTaps taps;
    int count = lattice_size(size, stride);
    float place = (float)at / (float)stride;
    if (count >= 3) place = m_clamp(place, 1.0f, (float)(count - 2));
    int cell = (int)place;
    float f = place - (float)cell;
    taps.first = cell - 1;
    taps.weight[0] = (1.0f - f) * 0.333333333f;
    taps.weight[1] = 0.333333333f;
    taps.weight[2] = 0.333333333f;
    taps.weight[3] = f * 0.333333333f;
    return taps;
}

/// Weights of lattice_taps along an edge of a tile inside the image: a row of 8 weights, one for
/// each pixel, for each of the lattice points -1, 0, 1 ... counted from the tile's first pixel.
#define TILE_POINTS_4 5u
#define TILE_POINTS_2 7u
CONSTANT_TABLE float tile_weights_4[TILE_POINTS_4 * TILE_EDGE] = {
    0.333333333f, 0.25f,         0.166666667f, 0.0833333333f, 0.0f,         0.0f,
    0.0f,         0.0f,          0.333333333f, 0.333333333f,  0.333333333f, 0.333333333f,
    0.333333333f, 0.25f,         0.166666667f, 0.0833333333f, 0.333333333f, 0.333333333f,
    0.333333333f, 0.333333333f,  0.333333333f, 0.333333333f,  0.333333333f, 0.333333333f,
    0.0f,         0.0833333333f, 0.166666667f, 0.25f,         0.333333333f, 0.333333333f,
    0.333333333f, 0.333333333f,  0.0f,         0.0f,          0.0f,         0.0f,
    0.0f,         0.0833333333f, 0.166666667f, 0.25f};
CONSTANT_TABLE float tile_weights_2[TILE_POINTS_2 * TILE_EDGE] = {
    0.333333333f, 0.166666667f, 0.0f,         0.0f,         0.0f,         0.0f,
    0.0f,         0.0f,         0.333333333f, 0.333333333f, 0.333333333f, 0.166666667f,
    0.0f,         0.0f,         0.0f,         0.0f,         0.333333333f, 0.333333333f,
    0.333333333f, 0.333333333f, 0.333333333f, 0.166666667f, 0.0f,         0.0f,
    0.0f,         0.166666667f, 0.333333333f, 0.333333333f, 0.333333333f, 0.333333333f,
    0.333333333f, 0.166666667f, 0.0f,         0.0f,         0.0f,         0.166666667f,
    0.333333333f, 0.333333333f, 0.333333333f, 0.333333333f, 0.0f,         0.0f,
    0.0f,         0.0f,         0.0f,         0.166666667f, 0.333333333f, 0.333333333f,
    0.0f,         0.0f,         0.0f,         0.0f,         0.0f,         0.0f,
    0.0f,         0.166666667f};

/// 1 where all taps of a tile lie inside the image, so that the weights of the tables hold.
static inline int tile_is_inside(const RenderParams* params, int left, int top) {
    return left >= 4 && top >= 4 && left + 16 <= (int)params->camera.width &&
                   top + 16 <= (int)params->camera.height
               ? 1
               : 0;
}

#endif
