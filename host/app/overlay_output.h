// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_OVERLAY_OUTPUT_H
#define WEFT_APP_OVERLAY_OUTPUT_H

#include <filesystem>
#include <string>

#include "base/diagnostics.h"
#include "image/image.h"

namespace CLI {
class App;
}

namespace weft {

struct RenderOptions;

/// Adds `--overlays` to `weft render`.
void add_overlays(CLI::App& render);

/// Reads it, after all other options have been read. Throws Error (exit code 1).
void read_overlays(const CLI::App& command, RenderOptions& options);

/// The file of an overlay of a layer: of `out.exr` and `direct.level` it is `out.direct.level.png`.
[[nodiscard]] std::filesystem::path overlay_output(const std::filesystem::path& output,
                                                   const std::string& layer);

/// Writes all overlays of a picture beside the output, or warns that there are none. Throws Error
/// (exit code 5).
void write_overlays(const RenderOptions& options, const Image& image, Diagnostics& diagnostics);

}  // namespace weft

#endif
