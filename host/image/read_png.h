// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_READ_PNG_H
#define WEFT_IMAGE_READ_PNG_H

#include <cstddef>
#include <span>
#include <string>

#include "image/image.h"

namespace weft {

/// Decodes a PNG of any kind with 8 or 16 bits into one beauty layer RGB, from sRGB to linear
/// values in [0, 1]. Transparency is dropped, and sRGB assumed whatever the file says of its gamma.
/// Throws Error (exit code 2) that names `place` for anything damaged or too large.
[[nodiscard]] Image decode_png(std::span<const std::byte> bytes, const std::string& place);

}  // namespace weft

#endif
