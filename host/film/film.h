// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FILM_FILM_H
#define WEFT_FILM_FILM_H

#include <cstdint>
#include <span>

#include "image/image.h"

namespace weft {

/// Planes of the film of frames with these features.
[[nodiscard]] std::size_t film_planes(std::uint32_t features);

/// Means of the film's compensated sums (`high` + `low`, FILM_* planes) over `samples` frames, as
/// layers. Beauty, followed by its alpha, is emission + direct + indirect, and what is in the
/// planes that `features` (FEATURE_*) bring: reflection, refraction, glossy, media. A single sample
/// leaves nothing to compensate: `low` is not read then, and may be empty.
[[nodiscard]] Image resolve_film(std::span<const float> high, std::span<const float> low,
                                 std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                                 std::uint32_t features);

}  // namespace weft

#endif
