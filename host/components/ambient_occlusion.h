// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_COMPONENTS_AMBIENT_OCCLUSION_H
#define WEFT_COMPONENTS_AMBIENT_OCCLUSION_H

#include <cstdint>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

/// Distance beyond which nothing occludes, as a share of the radius of the scene's bounding sphere.
inline constexpr double occlusion_reach = 0.25;
/// Number of directions of one sample set.
inline constexpr std::uint32_t occlusion_directions_per_set = 16;

/// The directions of all sample sets of a frame, set by set: unit vectors about +z with pdf
/// cos / pi; w is `reach`, for ambient_occlusion.cl. Points of the Halton sequence in bases 2 and
/// 3, shifted by the seed modulo 1 (Cranley and Patterson 1976), so that every direction alone has
/// that pdf over all seeds.
[[nodiscard]] std::vector<shared::float4> occlusion_directions(std::uint32_t sets,
                                                               std::uint32_t frame,
                                                               std::uint32_t seed, double reach);

}  // namespace weft

#endif
