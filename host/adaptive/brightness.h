// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_BRIGHTNESS_H
#define WEFT_ADAPTIVE_BRIGHTNESS_H

#include <span>
#include <vector>

namespace weft {

/// How visible small changes of luminance are: the slope of the retina's response (HDR-VDP, see
/// metrics/hdr_vdp_response.h), from a table that is quick to read.
class BrightnessSlope {
  public:
    /// `luminance_scale`: cd/m^2 on the display of radiance 1, above 0.
    explicit BrightnessSlope(double luminance_scale);

    /// Just noticeable differences per unit of radiance, at a luminance of `radiance`. Negative
    /// values and NaN count as 0.
    [[nodiscard]] float operator()(float radiance) const;

    /// SLOPE_ENTRIES slopes, for the kernels' brightness_slope.
    [[nodiscard]] std::span<const float> table() const { return slopes_; }

  private:
    std::vector<float> slopes_;  ///< by the leading bits of a float
};

}  // namespace weft

#endif
