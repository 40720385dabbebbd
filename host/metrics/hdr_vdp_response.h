// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HDR_VDP_RESPONSE_H
#define WEFT_METRICS_HDR_VDP_RESPONSE_H

#include <vector>

namespace weft {

inline constexpr double darkest_luminance = 1e-4;         ///< cd/m^2, lower end of the response
inline constexpr double brightest_luminance = 2.11177e7;  ///< cd/m^2, upper end of the response

/// Response of the retina in just noticeable differences at a peak sensitivity of 1 % contrast,
/// as a function of luminance: 0 at darkest_luminance, clamped outside the two ends. A monotone
/// piecewise cubic over the logarithm of luminance, within 0.013 of the table of HDR-VDP 1.7.
class RetinaResponse {
  public:
    RetinaResponse();

    /// `luminance` in cd/m^2; anything but NaN.
    [[nodiscard]] double operator()(double luminance) const;

  private:
    std::vector<double> slopes_;  ///< d response / d log10 luminance at the knots
};

}  // namespace weft

#endif
