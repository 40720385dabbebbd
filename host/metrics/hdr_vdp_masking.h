// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HDR_VDP_MASKING_H
#define WEFT_METRICS_HDR_VDP_MASKING_H

#include <algorithm>
#include <cmath>

namespace weft {

/// Factor by which a signal of `amplitude` just noticeable differences raises the threshold in its
/// own channel: Daly's learning curve at slope 1. At least 1.
[[nodiscard]] inline double threshold_elevation(double amplitude) {
    constexpr double offset = 6.0;  // threshold of a broadband mask, Daly's W
    const double square = offset * amplitude * (offset * amplitude);
    return std::sqrt(std::sqrt(1.0 + square * square));
}

/// Minus the logarithm of the probability that a difference of `difference` just noticeable
/// differences goes unseen in one channel, where the two images raise the threshold by the two
/// elevations. Over the channels these sum up.
[[nodiscard]] inline double detection_exponent(double difference, double elevation_of_test,
                                               double elevation_of_reference) {
    const double elevation = std::max(1.0, std::min(elevation_of_test, elevation_of_reference));
    const double ratio = std::abs(difference) / elevation;
    return ratio * ratio * ratio * std::sqrt(ratio);
}

}  // namespace weft

#endif
