// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Independent random numbers: xoshiro128++ (Blackman and Vigna 2021), one generator for each sample
// of each pixel, so that any sample can be drawn anywhere and in any order.
#ifndef WEFT_KERNELS_CORE_RANDOM_H
#define WEFT_KERNELS_CORE_RANDOM_H

#include "kernels/core/sampling.h"

typedef struct {
    uint a, b, c, d;
} Random;

/// The generator of one sample of a pixel.
static inline Random make_random(uint seed, uint pixel, uint sample) {
    Random random;
    random.a = hash_pair(seed, sample);
    random.b = hash_pair(random.a ^ 0x3C6EF372u, pixel);
    random.c = hash_pair(random.b ^ 0xA54FF53Au, sample);
    random.d = hash_pair(random.c ^ 0x510E527Fu, pixel) | 1u;  // the state must not be 0
    return random;
}

static inline uint rotate_left(uint x, uint count) {
    return (x << count) | (x >> (32u - count));
}

/// The next number, uniform in [0, 1).
static inline float next_random(Random* random) {
    uint result = rotate_left(random->a + random->d, 7u) + random->a;
    uint shifted = random->b << 9;
    random->c ^= random->a;
    random->d ^= random->b;
    random->b ^= random->c;
    random->a ^= random->d;
    random->c ^= shifted;
    random->d = rotate_left(random->d, 11u);
    return (float)(result >> 8) * 5.9604645e-8f;
}

#endif
