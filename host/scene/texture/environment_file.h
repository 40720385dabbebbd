// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TEXTURE_ENVIRONMENT_FILE_H
#define WEFT_SCENE_TEXTURE_ENVIRONMENT_FILE_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

#include "scene/environment_image.h"

namespace weft {

/// An image of the environment as a file has it.
struct EnvironmentFile {
    std::shared_ptr<EnvironmentImage> image;
    std::size_t mended = 0;  ///< values that were no radiance, see mended_values
};

/// What a warning says of values that are no radiance.
inline constexpr std::string_view mended_values =
    "values are negative or not finite: taken as 0, infinite ones as 65504";

/// Reads the beauty of an OpenEXR, Radiance HDR or PNG image: channels R, G and B, or Y alone. Rows
/// are of the same height. Throws Error (exit code 2) that names the file for what is damaged or
/// too large, or has no such channels.
[[nodiscard]] EnvironmentFile read_environment(const std::filesystem::path& path);

}  // namespace weft

#endif
