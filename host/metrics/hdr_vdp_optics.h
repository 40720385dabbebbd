// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HDR_VDP_OPTICS_H
#define WEFT_METRICS_HDR_VDP_OPTICS_H

#include "metrics/hdr_vdp_grid.h"

namespace weft {

/// Diameter of the pupil in mm of an eye adapted to `luminance` (cd/m^2, above 0).
[[nodiscard]] double pupil_diameter(double luminance);

/// Optical transfer function of the eye (Deeley et al. 1991) at `frequency` in cycles per degree,
/// not normalised: 1 towards frequency 0.
[[nodiscard]] double optical_transfer(double frequency, double pupil);

/// The optics as a filter, 1 at frequency 0. `legacy_grid` takes the slightly too small
/// frequencies of HDR-VDP 1.7: a step of 0.5 / (n / 2 + 1) cycles per pixel for n pixels.
[[nodiscard]] Filter optics_filter(const FrequencyGrid& grid, double pixels_per_degree,
                                   double pupil, bool legacy_grid);

}  // namespace weft

#endif
