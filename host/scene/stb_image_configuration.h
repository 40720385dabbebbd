// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_STB_IMAGE_CONFIGURATION_H
#define WEFT_SCENE_STB_IMAGE_CONFIGURATION_H

#include "base/limits.h"

// stb_image is configured by macros that must agree wherever its header is included.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS static_cast<int>(weft::limits::max_texture_edge)

#endif
