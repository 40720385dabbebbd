// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_NEIGHBOUR_CLAMPING_H
#define WEFT_CACHE_NEIGHBOUR_CLAMPING_H

#include <span>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

/// Radii of irradiance records after neighbour clamping (Krivanek et al. 2006): what lies within
/// R_k of record k lies within R_k + |x_i - x_k| of record i, so no radius is larger than that,
/// whatever its own rays have met:
///   R'_i = min over all k of R_k + slope |x_i - x_k|.
/// By the triangle inequality this clamps nothing a second time, and the order of records makes no
/// difference: it is the largest function below R that changes by `slope` per length at most.
/// `places`: xyz and the radius, finite and not negative; `slope`: ratio of radii to the distances
/// that rays have met, not negative. Quick where records that follow one another are near each
/// other.
[[nodiscard]] std::vector<float> neighbour_clamped(std::span<const shared::float4> places,
                                                   double slope);

}  // namespace weft

#endif
