// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_SAMPLE_NOISE_H
#define WEFT_REFINE_SAMPLE_NOISE_H

#include <cstdint>

#include "refine/exact_halves.h"
#include "refine/surface_runs.h"

namespace weft {

/// The variance of the mean of all samples in each pixel, summed over the channels, by how far the
/// halves are apart there; or in the 5 x 5 pixels around it, across edges as well, if that is more:
/// few samples that fall on the same side of an edge are equal by chance.
[[nodiscard]] Plane sample_variance(const ExactHalves& halves);

/// The share of the variance of a pixel's noise that is left in what the starlet transform makes of
/// it on a scale, from 0 on, where the pixel has these runs. Up to twice as much as it is.
[[nodiscard]] float noise_left(Run row, Run column, std::uint32_t scale);

/// What the mean product of two halves of noise is by chance in the neighbourhood of a pixel with
/// these runs, as a share of the noise's power: the standard error of n independent products, 1 /
/// sqrt(n), and 1 / n more, since few products do not say how large it is either. Nor do few
/// `samples` of a pixel, of which rare ones may be bright: it counts twice for 2, and once for
/// many.
[[nodiscard]] float chance_agreement(Run row, Run column, std::uint32_t scale,
                                     std::uint64_t samples);

}  // namespace weft

#endif
