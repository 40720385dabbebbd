// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_JPEG_CHECK_H
#define WEFT_SCENE_JPEG_CHECK_H

#include <cstddef>
#include <span>
#include <string>

namespace weft {

/// Refuses JPEG files that stb_image must not see: with a Huffman table of more than 256 symbols,
/// which older versions of it write past its end, or with more scans than a sane encoder makes.
/// Everything that is no JPEG file passes. Throws Error (exit code 2) that begins with `place`.
void check_jpeg(std::span<const std::byte> bytes, const std::string& place);

}  // namespace weft

#endif
