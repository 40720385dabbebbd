// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_QUALITY_H
#define WEFT_PLAN_QUALITY_H

#include <array>
#include <cstdint>
#include <string_view>

#include "plan/frame_plan.h"

namespace weft {

/// Trade-off between the quality and the time of an image. `preview` is the standard setting.
enum class Quality : std::uint8_t { draft, preview, high };

// Names on the command line and in files, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> quality_names = {"draft", "preview", "high"};

[[nodiscard]] std::string_view to_string(Quality quality);

/// The settings of a quality: which errors of undersampling are accepted, and how many VPLs and
/// points on lights a pixel's set has.
[[nodiscard]] SamplingSettings sampling_of(Quality quality);

/// The settings of a single image by adaptive sampling: those of its quality, but that later
/// samples tolerate less, and beyond `draft` the residual brings the light that the bound takes
/// away, so that the bound may be lower. Scenes with media, of whose light it knows nothing, have a
/// higher bound instead.
[[nodiscard]] SamplingSettings sampling_of_image(Quality quality, bool media);

/// The settings of the reference estimator: few choices among VPLs of eight bounces, no filter, and
/// the residual by path tracing.
[[nodiscard]] SamplingSettings sampling_of_reference();

/// Samples of a single image by adaptive sampling for which no end is given: as many as it takes
/// until the eye finds neither the sample sets nor stairs at edges, but for `draft`; fewer in
/// scenes with media, whose samples take about twice as long.
[[nodiscard]] std::uint32_t samples_of(Quality quality, bool media);

}  // namespace weft

#endif
