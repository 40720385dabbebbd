// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/halton.h"

#include <cmath>

#define NATIVE_KERNELS "kernels/core/sampling.h"
#include "shared/native_functions.h"

namespace weft {

double radical_inverse(std::uint32_t base, std::uint32_t index) {
    double value = 0.0;
    double digit = 1.0 / base;
    for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
    return value;
}

double shift_of(std::uint32_t seed, std::uint32_t axis) {
    std::uint64_t x = (std::uint64_t{seed} << 1 | axis) + 0x9e3779b97f4a7c15ULL;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ x >> 27) * 0x94d049bb133111ebULL;
    return static_cast<double>((x ^ x >> 31) >> 11) * 0x1.0p-53;
}

std::uint32_t seed_of_sample(std::uint32_t seed, std::uint32_t sample) {
    // Each step is a permutation, so that two samples of one seed never share theirs.
    return native::hash_bits(sample + native::hash_bits(seed ^ 0x6a09e667U));
}

double shifted_halton(std::uint32_t base, std::uint32_t index, double shift) {
    const double x = radical_inverse(base, index) + shift;
    return x - std::floor(x);
}

}  // namespace weft
