// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_SCALING_SCALING_LAWS_H
#define WEFT_BENCH_SCALING_SCALING_LAWS_H

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

namespace weft::bench {

/// How a time is expected to grow with x.
enum class LawKind : std::uint8_t {
    constant,     ///< not at all
    line,         ///< offset + slope x
    logarithmic,  ///< offset + slope log10 x
    amdahl,       ///< single (serial + (1 - serial) / x)
};

/// An expected law; its parameters are fitted to what is measured.
struct Law {
    LawKind kind = LawKind::line;
    double flat_from = std::numeric_limits<double>::infinity();  ///< x beyond it counts as this
};

/// The law fitted to y at these x, both above 0, as JSON: what it says in `text`, its `parameters`,
/// `expected` values at x, the root mean square of their relative errors (`relative_rms`), and the
/// `exponent` of the power law that fits y best, which knows nothing of the law. Null where there
/// is nothing to fit: less than two different x, or a y of 0.
[[nodiscard]] nlohmann::json law_json(const Law& law, std::span<const double> x,
                                      std::span<const double> y);

}  // namespace weft::bench

#endif
