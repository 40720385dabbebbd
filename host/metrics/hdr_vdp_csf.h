// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HDR_VDP_CSF_H
#define WEFT_METRICS_HDR_VDP_CSF_H

#include <array>

#include "metrics/hdr_vdp_grid.h"

namespace weft {

/// Adaptation luminances in cd/m^2 for which the sensitivity is filtered; between them it is
/// interpolated.
inline constexpr std::array<double, 6> adaptation_levels{0.001, 0.01, 0.1, 1.0, 10.0, 100.0};

/// Contrast sensitivity of Daly 1993 for an image of one square degree seen without eccentricity,
/// up to a constant factor. `frequency` in cycles per degree, `angle` its direction in radians,
/// `adaptation` in cd/m^2, `distance` of the eye in metres. 0 at frequency 0.
[[nodiscard]] double contrast_sensitivity(double frequency, double angle, double adaptation,
                                          double distance);

/// The neural part of the contrast sensitivity at `adaptation`, without that of the optics: 0 at
/// frequency 0, at most 1 elsewhere.
[[nodiscard]] Filter neural_filter(const FrequencyGrid& grid, const Filter& optics,
                                   double pixels_per_degree, double adaptation, double distance);

/// The weight of adaptation_levels[level] in the linear interpolation at `adaptation` (cd/m^2,
/// clamped to the levels); the six weights sum to 1.
[[nodiscard]] double adaptation_weight(std::size_t level, double adaptation);

}  // namespace weft

#endif
