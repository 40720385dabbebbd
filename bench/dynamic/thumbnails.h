// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_THUMBNAILS_H
#define WEFT_BENCH_DYNAMIC_THUMBNAILS_H

#include <filesystem>
#include <string>

#include "image/image.h"

namespace weft::bench {

/// The longest edge of a thumbnail, pixels.
inline constexpr std::uint32_t thumbnail_edge = 192;

/// The beauty layer, each pixel the mean of a block of as many as it takes; where they do not come
/// out even, what is left at the right and the bottom goes.
[[nodiscard]] Image thumbnail(const Image& image);

/// Writes one as a PNG into a folder, which is made where it is missing; returns the file's name,
/// `name` without what does not belong into one. `exposure` in stops. Throws Error (exit code 5).
std::string write_thumbnail(const std::filesystem::path& folder, const std::string& name,
                            const Image& image, double exposure);

}  // namespace weft::bench

#endif
