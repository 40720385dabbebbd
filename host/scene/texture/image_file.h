// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TEXTURE_IMAGE_FILE_H
#define WEFT_SCENE_TEXTURE_IMAGE_FILE_H

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "scene/scene.h"

namespace weft {

/// Decodes PNG, JPEG, BMP or TGA bytes into RGBA8, top row first. `place` names the image in
/// errors. Throws Error (exit code 2) when the bytes are not an image or are larger than
/// `limits::max_texture_edge`.
[[nodiscard]] Texture decode_image(std::span<const std::byte> bytes, const std::string& place);

/// `decode_image` of a whole file. `place` is where the file is referred to.
[[nodiscard]] Texture read_image(const std::filesystem::path& path, const std::string& place);

}  // namespace weft

#endif
