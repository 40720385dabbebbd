// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_QUALITY_H
#define WEFT_PLAN_QUALITY_H

#include "plan/frame_plan.h"

namespace weft {

/// How much time a picture is worth. `preview` is the standard setting.
enum class Quality : std::uint8_t { draft, preview, high };

/// The settings that stand for a quality: errors of undersampling that may be seen, and how many
/// VPLs and points on lights a pixel's set has.
[[nodiscard]] SamplingSettings sampling_of(Quality quality);

}  // namespace weft

#endif
