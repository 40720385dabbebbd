// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_AGREEMENT_H
#define WEFT_BENCH_PATH_AGREEMENT_H

#include <cstddef>
#include <cstdint>

#include "bench/path/image_noise.h"

namespace weft::bench {

/// Edge of the blocks of pixels whose means are compared.
inline constexpr std::uint32_t agreement_block = 8;

/// How far the mean images of two candidates are from each other.
struct Agreement {
    double worst_z = 0.0;     ///< the largest |z| of the blocks
    double difference = 0.0;  ///< of the whole image's mean to that of the first, relative
    double error = 0.0;       ///< its standard error
};

/// Blocks of an image.
[[nodiscard]] std::size_t block_count(std::uint32_t width, std::uint32_t height);

/// Compares independent images, planes of red, green and blue. A block's value is its mean over
/// pixels and channels. Its variance is taken from those of its pixels, whose noise is independent.
[[nodiscard]] Agreement compare_means(const Images& first, const Images& second,
                                      std::uint32_t width, std::uint32_t height);

/// The |z| that the largest of `count` normal deviates exceeds with a probability of 1 % at most
/// (Bonferroni).
[[nodiscard]] double z_limit(std::size_t count);

}  // namespace weft::bench

#endif
