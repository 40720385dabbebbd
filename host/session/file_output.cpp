// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/file_output.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "film/film_sums_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "session/overlay_files.h"

namespace weft {
namespace {

constexpr double save_ms = 60e3;

bool is_png(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".png";
}

}  // namespace

void FileOutput::write(SessionImage rendered) {
    Image& image = rendered.image;
    if (settings_.with_sums && rendered.sums) attach_sums(*rendered.sums, image);
    image.metadata["software"] = "weft " WEFT_VERSION;
    image.metadata["scene"] = settings_.scene;
    image.metadata["algorithm"] = to_string(rendered.algorithm);
    image.metadata["samples"] = std::to_string(rendered.samples);
    image.metadata["seed"] = std::to_string(rendered.seed);
    if (is_png(settings_.file)) {
        write_png(settings_.file, image,
                  settings_.exposure_ev ? *settings_.exposure_ev : auto_exposure(image),
                  settings_.tone);
    } else {
        write_exr(settings_.file, image);
    }
    if (settings_.overlays)
        write_overlays(settings_.file, image, settings_.exposure_ev, diagnostics_);
}

std::optional<double> FileOutput::save_interval_ms() const {
    return settings_.sums ? std::optional(save_ms) : std::nullopt;
}

void FileOutput::save(const FilmSums& sums, const Image& image) {
    if (!settings_.sums) return;
    Image saved = image;
    attach_sums(sums, saved);
    write_exr(*settings_.sums, saved);
}

}  // namespace weft
