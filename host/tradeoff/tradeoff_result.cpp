// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_result.h"

#include <array>

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

}  // namespace

const char* to_string(ErrorMeasure measure) {
    return names.at(static_cast<std::size_t>(measure)).key;
}

const char* label(ErrorMeasure measure) {
    return names.at(static_cast<std::size_t>(measure)).label;
}

}  // namespace weft
