// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TEXTURE_STB_IMAGE_CONFIGURATION_H
#define WEFT_SCENE_TEXTURE_STB_IMAGE_CONFIGURATION_H

#include <cstddef>

#include "base/limits.h"

namespace weft {

/// The largest block that stb_image may allocate in this thread, in bytes. It allocates chunks by
/// sizes in the file, before it has read their contents.
extern thread_local std::size_t stbi_max_block;

}  // namespace weft

// stb_image is configured by macros that must agree wherever its header is included.
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS static_cast<int>(weft::limits::max_texture_edge)

#endif
