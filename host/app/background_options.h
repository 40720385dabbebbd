// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_BACKGROUND_OPTIONS_H
#define WEFT_APP_BACKGROUND_OPTIONS_H

#include <string_view>

#include "image/background.h"

namespace weft {

/// A background: `transparent`, `white`, `black`, `#rrggbb` or `#rgb` in sRGB, or `R,G,B`, linear
/// numbers from 0 to 1000000. Throws Error (exit code 1) that names the option.
[[nodiscard]] Background parse_background(std::string_view option, std::string_view text);

}  // namespace weft

#endif
