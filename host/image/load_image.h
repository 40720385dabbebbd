// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_LOAD_IMAGE_H
#define WEFT_IMAGE_LOAD_IMAGE_H

#include <filesystem>

#include "image/image.h"

namespace weft {

/// Reads an OpenEXR, Radiance HDR or PNG image, whatever its name ends with, into linear values.
/// Throws Error (exit code 2) for anything else, and for what is damaged or too large.
[[nodiscard]] Image load_image(const std::filesystem::path& path);

/// Whether a loaded image held values for a display, from black at 0 to white at 1, rather than
/// those of a scene, as a PNG does.
[[nodiscard]] bool is_display_referred(const Image& image);

}  // namespace weft

#endif
