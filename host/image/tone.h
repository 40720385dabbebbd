// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_TONE_H
#define WEFT_IMAGE_TONE_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

#include "kernels/film/tone_curves.h"

namespace weft {

/// How exposed linear colours become those of a display; kernels/film/tone.h defines the curves.
enum class ToneCurve : std::uint32_t {
    none = TONE_NONE,      ///< as they are, cut off at 1
    filmic = TONE_FILMIC,  ///< Narkowicz's fit of ACES, by channel
    agx = TONE_AGX,        ///< AgX as in Blender 4, without a look
};

// Names on the command line and in files, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> tone_names = {"none", "filmic", "agx"};

[[nodiscard]] std::string_view to_string(ToneCurve curve);

/// A linear Rec.709 colour under the curve: linear, within [0, 1] but for ToneCurve::none, which
/// returns it as it is. NaN and negative values count as 0.
[[nodiscard]] glm::vec3 toned(ToneCurve curve, const glm::vec3& colour);

}  // namespace weft

#endif
