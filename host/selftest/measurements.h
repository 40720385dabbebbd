// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_MEASUREMENTS_H
#define WEFT_SELFTEST_MEASUREMENTS_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "selftest/rendering.h"
#include "selftest/statistics.h"

// Measurements that several cases take of images.
namespace weft::selftest {

/// Number of seeds where a value is estimated from the scatter of whole images.
inline constexpr std::size_t image_seeds = 12;

/// The mean of `measure(seed)` over image_seeds seeds, with its standard error.
[[nodiscard]] Estimate over_seeds(const std::function<double(std::uint32_t seed)>& measure);

/// The estimate of `factor` times the quantity that `estimate` estimates.
[[nodiscard]] Estimate scaled(const Estimate& estimate, double factor);

/// The value that is farthest from `expected`, which all of them should be; the first that is not
/// finite, if there is any.
[[nodiscard]] double farthest_from(double expected, const std::vector<double>& values);

/// Irradiance of all pixels by a light layer, without the albedo.
[[nodiscard]] std::vector<double> irradiances(const Rendering& rendering, std::string_view layer,
                                              std::uint32_t channel = 0);

/// Mean over the image of the irradiance by a light layer.
[[nodiscard]] double mean_irradiance(const Rendering& rendering, std::string_view layer);

/// Number of values of a rendering that are Inf, NaN or negative, or that were guarded.
[[nodiscard]] double bad_values(const Rendering& rendering);

}  // namespace weft::selftest

#endif
