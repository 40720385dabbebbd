// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_WORK_ORDER_H
#define WEFT_PLAN_WORK_ORDER_H

#include <span>

#include "plan/work_list.h"
#include "shared/shared_types.h"

namespace weft {

/// Puts a sparse list in the order in which packets trace it fastest: sample set by sample set, and
/// within a set by the place of the pixels' surfaces along a Morton curve, so that the rays of a
/// packet end close to each other; pixels of one cell keep their order. In a full list neighbouring
/// pixels are close, in a sparse one they are often of different surfaces. `positions`: by pixel,
/// kernel units within +-extent.
[[nodiscard]] WorkList ordered_by_place(const WorkList& list,
                                        std::span<const shared::float4> positions, float extent);

/// Puts two zero bits before every bit of a number of up to ten bits: one axis of a Morton code.
[[nodiscard]] std::uint32_t spread_bits(std::uint32_t x);

/// Place on a Morton curve of 128 cells along each axis of the cube of +-extent.
[[nodiscard]] std::uint32_t morton_code(const shared::float4& position, float extent);

}  // namespace weft

#endif
