// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TEXTURE_JPEG_H
#define WEFT_SCENE_TEXTURE_JPEG_H

#include <cstddef>
#include <span>
#include <string>

#include "scene/scene.h"

namespace weft {

/// Whether the bytes begin as every JPEG file does.
[[nodiscard]] bool is_jpeg(std::span<const std::byte> bytes);

/// Decodes a JPEG file into RGBA8, top row first. `check_size` is called with the dimensions before
/// anything is allocated for them, and throws where they are too large. Throws Error (exit code 2)
/// that begins with `place` for a damaged or truncated file, or one with more scans than any usual
/// encoder makes.
[[nodiscard]] Texture decode_jpeg(std::span<const std::byte> bytes, const std::string& place,
                                  void (*check_size)(std::uint32_t width, std::uint32_t height,
                                                     const std::string& place));

}  // namespace weft

#endif
