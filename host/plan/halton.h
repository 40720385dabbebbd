// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_HALTON_H
#define WEFT_PLAN_HALTON_H

#include <cstdint>

namespace weft {

/// Radical inverse of `index` in a prime base, [0, 1).
[[nodiscard]] double radical_inverse(std::uint32_t base, std::uint32_t index);

/// A shift in [0, 1) for `axis` 0 or 1 of the points of a seed.
[[nodiscard]] double shift_of(std::uint32_t seed, std::uint32_t axis);

/// A coordinate of the Halton sequence shifted modulo 1 (Cranley and Patterson 1976), [0, 1).
[[nodiscard]] double shifted_halton(std::uint32_t base, std::uint32_t index, double shift);

/// A seed for one of many samples that have to be independent; others for other samples.
[[nodiscard]] std::uint32_t seed_of_sample(std::uint32_t seed, std::uint32_t sample);

}  // namespace weft

#endif
