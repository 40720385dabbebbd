// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_QUALITY_H
#define WEFT_PLAN_QUALITY_H

#include "plan/frame_plan.h"

namespace weft {

/// Trade-off between the quality and the time of an image. `preview` is the standard setting.
enum class Quality : std::uint8_t { draft, preview, high };

/// The settings of a quality: which errors of undersampling are accepted, and how many VPLs and
/// points on lights a pixel's set has.
[[nodiscard]] SamplingSettings sampling_of(Quality quality);

}  // namespace weft

#endif
