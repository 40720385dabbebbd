// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_PNG_H
#define WEFT_IMAGE_PNG_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/file.h"
#include "image/background.h"
#include "image/image.h"
#include "image/tone.h"

namespace weft {

/// How an image becomes 8 bits.
struct PngSettings {
    double exposure_ev = 0.0;  ///< stops
    ToneCurve tone = ToneCurve::none;
    /// Empty: the image is opaque, whatever its alpha. A transparent one gives the file alpha, not
    /// premultiplied. A colour is put behind what exposure and tone curve have made of the image.
    std::optional<Background> background{};
};

/// The beauty layer (`RGB...` or `Y`) times 2^exposure_ev, under the tone curve, as an 8-bit sRGB
/// PNG. Values are clamped to [0, 1] (NaN counts as 0) and rounded with an 8x8 ordered dither,
/// which depends on the pixel's place alone and keeps values that 8 bits can hold; metadata becomes
/// text chunks. Throws std::invalid_argument where there is no such layer or the image is too
/// large, and std::runtime_error where metadata does not fit into a PNG.
[[nodiscard]] std::vector<std::byte> png_bytes(const Image& image, const PngSettings& settings);
[[nodiscard]] std::vector<std::byte> png_bytes(const Image& image, double exposure_ev);

/// Writes these bytes as a file. Throws Error (exit code 5), leaving an older file untouched.
void write_png(const std::filesystem::path& path, const Image& image, const PngSettings& settings,
               WriteMode mode = WriteMode::flushed);
void write_png(const std::filesystem::path& path, const Image& image, double exposure_ev,
               WriteMode mode = WriteMode::flushed);

/// Exposure in stops for the beauty layer, from the luminances Y of its pixels that are finite and
/// not black (Y > 2^-20 of their mean): `key = log2(0.18 / exp(mean(log Y)))` puts the log-average
/// at middle grey. Pixels half of whose luminance or more is that of their layer "emission", lamps
/// and the sky, have no part in the mean, unless fewer than one in a hundred are left. Highlights
/// are protected by at most two stops: the result is `max(key - 2, min(key, -log2(P)))`, P being
/// the 95th percentile of Y. 0 for a black image.
[[nodiscard]] double auto_exposure(const Image& image);

}  // namespace weft

#endif
