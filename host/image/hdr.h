// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_HDR_H
#define WEFT_IMAGE_HDR_H

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "image/image.h"

namespace weft {

/// Decodes a Radiance image (`.hdr`, `.pic`) into one beauty layer RGB: flat, old and new run
/// lengths, all eight orientations. A value is mantissa * 2^(exponent - 136), divided by the
/// factors of EXPOSURE and COLORCORR. Throws Error (exit code 2) that names `place` for anything
/// damaged, too large, or in XYZ.
[[nodiscard]] Image decode_hdr(std::span<const std::byte> bytes, const std::string& place);

/// `decode_hdr` of a whole file.
[[nodiscard]] Image read_hdr(const std::filesystem::path& path);

}  // namespace weft

#endif
