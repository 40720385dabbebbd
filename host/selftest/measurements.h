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

// What cases make of pictures.
namespace weft::selftest {

/// Seeds of what is estimated from the scatter of whole pictures.
inline constexpr std::size_t picture_seeds = 12;

/// The mean of `measure(seed)` over picture_seeds seeds, with its standard error.
[[nodiscard]] Estimate over_seeds(const std::function<double(std::uint32_t seed)>& measure);

/// An estimate of `factor` times what `estimate` is one of.
[[nodiscard]] Estimate scaled(const Estimate& estimate, double factor);

/// Of several values the one that is farthest from what all of them should be; the first that is
/// not finite, if there is any.
[[nodiscard]] double farthest_from(double expected, const std::vector<double>& values);

/// Irradiance of all pixels by a light layer, albedo taken out.
[[nodiscard]] std::vector<double> irradiances(const Rendering& rendering, std::string_view layer,
                                              std::uint32_t channel = 0);

/// Mean over the picture of the irradiance by a light layer.
[[nodiscard]] double mean_irradiance(const Rendering& rendering, std::string_view layer);

/// Values of a rendering that are Inf, NaN or negative, and those that were guarded.
[[nodiscard]] double bad_values(const Rendering& rendering);

}  // namespace weft::selftest

#endif
