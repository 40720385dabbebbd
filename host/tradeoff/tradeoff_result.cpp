// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_result.h"

#include <array>
#include <limits>

namespace weft {
namespace {

struct Names {
    const char* key;
    const char* label;
};

// In the order of the enumeration.
constexpr std::array<Names, error_measures> names = {{
    {"hdrflip", "HDR-FLIP"},
    {"vdp75", "HDR-VDP 75 %"},
    {"vdp95", "HDR-VDP 95 %"},
    {"vdp75_display", "HDR-VDP 75 % (display)"},
    {"vdp95_display", "HDR-VDP 95 % (display)"},
    {"relmse", "relMSE"},
    {"bias", "bias"},
}};

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Interval error_of(const TradeoffPoint& point, ErrorMeasure measure) {
    const auto index = static_cast<std::size_t>(measure);
    return index < point.errors.size() ? point.errors[index] : Interval{none, none, none};
}

double error_of(std::span<const double> errors, ErrorMeasure measure) {
    const auto index = static_cast<std::size_t>(measure);
    return index < errors.size() ? errors[index] : none;
}

const char* to_string(ErrorMeasure measure) {
    return names.at(static_cast<std::size_t>(measure)).key;
}

const char* label(ErrorMeasure measure) {
    return names.at(static_cast<std::size_t>(measure)).label;
}

}  // namespace weft
