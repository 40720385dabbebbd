// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_ISOLATED_ERRORS_H
#define WEFT_REFINE_ISOLATED_ERRORS_H

#include "refine/exact_halves.h"
#include "refine/surface_runs.h"

namespace weft {

/// Corrects single pixels by themselves: where both halves of the difference to a preview agree on
/// an error far greater than those around it and than their noise. What is more than around it is
/// taken out of `difference`, so that it is not spread over its neighbourhood. The share of it that
/// is known is added to `image`, which is the preview, where it corrects a bright speck of that, or
/// is greater than anything that one half has alone nearby: else it may be chance. `variance` as of
/// sample_variance.
void correct_isolated(ExactHalves& difference, const Plane& variance, const SurfaceRuns& runs,
                      ColourPlanes& image);

}  // namespace weft

#endif
