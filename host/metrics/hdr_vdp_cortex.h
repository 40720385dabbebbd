// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HDR_VDP_CORTEX_H
#define WEFT_METRICS_HDR_VDP_CORTEX_H

#include <vector>

#include "metrics/hdr_vdp_grid.h"

namespace weft {

/// The cortex transform: five octave bands of six orientations each and one base band without
/// orientation. Frequencies are in cycles per pixel. The channels sum to the lowest mesa filter.
class CortexTransform {
  public:
    static constexpr unsigned band_count = 6;  ///< the last one is the base band
    static constexpr unsigned orientation_count = 6;

    /// `legacy_fan` shifts negative vertical frequencies by one row in the orientation filters, as
    /// HDR-VDP 1.7 does.
    CortexTransform(const FrequencyGrid& grid, bool legacy_fan);

    /// Number of channels of band 0 ... band_count - 1.
    [[nodiscard]] static constexpr unsigned orientations(unsigned band) {
        return band + 1 < band_count ? orientation_count : 1;
    }

    /// Filter of one channel; orientation 0 is the vertical frequency, each next 30 degrees less.
    [[nodiscard]] Filter channel(unsigned band, unsigned orientation) const;

    /// Low-pass filter that spreads the masking of a band over the phase of its waves.
    [[nodiscard]] Filter phase_spread(unsigned band) const;

  private:
    [[nodiscard]] std::size_t index(std::uint32_t column, std::uint32_t row) const {
        return std::size_t{row} * grid_.columns() + column;
    }

    FrequencyGrid grid_;
    std::vector<double> radius_;  ///< cycles per pixel, per bin of the half plane
    std::vector<double> angle_;   ///< radians, likewise
};

}  // namespace weft

#endif
