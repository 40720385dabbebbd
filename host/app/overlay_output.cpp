// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/overlay_output.h"

#include <filesystem>
#include <string>

#include "adaptive/level_overlay.h"
#include "app/command_line.h"
#include "app/options.h"
#include "base/error.h"

namespace weft {
namespace {

/// Whether some overlay of the output, or of one of its frames, is written to `other`.
bool is_overlay_output(const std::filesystem::path& output, const std::filesystem::path& other) {
    const std::filesystem::path path = other.lexically_normal();
    const std::string begin = output.stem().string() + ".";
    return path.parent_path() == output.lexically_normal().parent_path() &&
           path.extension() == ".png" && path.filename().string().starts_with(begin) &&
           is_overlay_layer(path.stem().string());
}

}  // namespace

void add_overlays(CLI::App& render) {
    add_flag(render, "--overlays",
             "Of ais: also writes how densely each component is sampled, and why, as PNG images");
}

void read_overlays(const CLI::App& command, RenderOptions& options) {
    options.overlays = is_given(command, "--overlays");
    if (!options.overlays) return;
    if (options.algorithm != Algorithm::ais)
        throw usage_error("--overlays: shows adaptive sampling, expected --algorithm ais");
    if (options.stats && is_overlay_output(options.output, *options.stats))
        throw usage_error("--stats: names the same file as one of the images of --overlays");
}

}  // namespace weft
