// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_OVERLAY_FILES_H
#define WEFT_SESSION_OVERLAY_FILES_H

#include <filesystem>
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "base/file.h"
#include "image/image.h"

namespace weft {

/// The file for the overlay of a layer: `out.direct.level.png` for `out.exr` and `direct.level`.
[[nodiscard]] std::filesystem::path overlay_output(const std::filesystem::path& output,
                                                   const std::string& layer);

/// Writes all overlays of an image beside the output, exposed by so many stops (empty:
/// automatically), or warns that there are none. Throws Error (exit code 5).
void write_overlays(const std::filesystem::path& output, const Image& image,
                    const std::optional<double>& exposure_ev, Diagnostics& diagnostics,
                    WriteMode mode = WriteMode::flushed);

}  // namespace weft

#endif
