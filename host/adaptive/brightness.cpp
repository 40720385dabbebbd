// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/brightness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "metrics/hdr_vdp_response.h"
#include "shared/shared_types.h"

namespace weft {
namespace {

constexpr unsigned dropped_bits = SLOPE_DROPPED_BITS;
constexpr std::uint32_t entries = SLOPE_ENTRIES;

}  // namespace

BrightnessSlope::BrightnessSlope(double luminance_scale) : slopes_(entries) {
    const RetinaResponse response;
    for (std::uint32_t i = 0; i < entries; ++i) {
        const auto low = static_cast<double>(std::bit_cast<float>(i << dropped_bits));
        const double high = i + 1 < entries
                                ? static_cast<double>(std::bit_cast<float>((i + 1) << dropped_bits))
                                : 2.0 * low;
        const double from =
            std::clamp(low * luminance_scale, darkest_luminance, 0.5 * brightest_luminance);
        const double to = std::max(high * luminance_scale, from * 1.001);
        slopes_[i] =
            static_cast<float>((response(to) - response(from)) / (to - from) * luminance_scale);
    }
}

float BrightnessSlope::operator()(float radiance) const {
    if (!(radiance > 0.0F)) return slopes_.front();
    return slopes_[std::min(std::bit_cast<std::uint32_t>(radiance) >> dropped_bits, entries - 1)];
}

}  // namespace weft
