// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Exact sums over samples. A sample is rounded once to a fixed-point number, and fixed-point sums
// do not depend on order: an image made in parts is the image made at once, bit for bit.
//
// A sum is a two's complement integer of several words, the least significant first. All sums of a
// pixel follow one another, FILM_PIXEL_WORDS words: many samples of a pixel are added one after the
// other, and words a whole image apart would not stay in a processor's cache together.
#ifndef WEFT_KERNELS_FILM_FILM_SUMS_H
#define WEFT_KERNELS_FILM_FILM_SUMS_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// Adds `value` * 2^`shift`, rounded to an integer, to the sum of `count` words at `words`. `value`
/// is finite. What exceeds the sum's range wraps around: the host chooses `shift` with room.
static inline void add_to_sum(GLOBAL uint* words, uint count, float value, int shift) {
    uint bits = as_bits(value);
    uint exponent = (bits >> 23) & 255u;
    uint mantissa = bits & 0x007FFFFFu;
    if (exponent == 0u)
        exponent = 1u;
    else
        mantissa |= 0x00800000u;
    int position = (int)exponent - 150 + shift;
    if (position < 0) {
        if (position < -24) return;
        uint drop = (uint)-position;
        mantissa = (mantissa + (1u << (drop - 1u))) >> drop;
        position = 0;
    }
    if (mantissa == 0u) return;
    uint first = (uint)position >> 5;
    uint offset = (uint)position & 31u;
    uint low = mantissa << offset;
    uint high = offset > 8u ? mantissa >> (32u - offset) : 0u;
    uint negative = bits >> 31;
    uint carry = negative;
    for (uint k = 0u; k < count; ++k) {
        uint word = k == first ? low : (k == first + 1u ? high : 0u);
        // Minus x is its complement plus 1; below `first` that 1 only ripples through.
        if (negative != 0u) word = ~word;
        uint before = words[k];
        uint sum = before + word;
        uint total = sum + carry;
        carry = (sum < before ? 1u : 0u) | (total < sum ? 1u : 0u);
        words[k] = total;
    }
}

#endif
