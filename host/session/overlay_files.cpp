// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/overlay_files.h"

#include <vector>

#include "adaptive/level_overlay.h"
#include "image/png.h"

namespace weft {

std::filesystem::path overlay_output(const std::filesystem::path& output,
                                     const std::string& layer) {
    std::filesystem::path path = output;
    return path.replace_filename(output.stem().string() + "." + layer + ".png");
}

void write_overlays(const std::filesystem::path& output, const Image& image,
                    const std::optional<double>& exposure_ev, Diagnostics& diagnostics,
                    WriteMode mode) {
    const std::vector<std::string> layers = overlay_layers(image);
    if (layers.empty())
        diagnostics.warn("",
                         "nothing in the scene is sampled adaptively, --overlays has nothing "
                         "to show");
    const double exposure = exposure_ev ? *exposure_ev : auto_exposure(image);
    for (const std::string& layer : layers) {
        Image overlay = level_overlay(image, layer, exposure);
        overlay.metadata = image.metadata;
        overlay.metadata["layer"] = layer;
        write_png(overlay_output(output, layer), overlay, 0.0, mode);
    }
}

}  // namespace weft
