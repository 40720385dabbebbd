// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_EXR_H
#define WEFT_IMAGE_EXR_H

#include <filesystem>

#include "base/file.h"
#include "image/image.h"

namespace weft {

/// Writes every layer as channels of one scan-line OpenEXR file, compressed without loss: the layer
/// without a name as `R`, `G`, `B`, any other as `name.R`; metadata as string attributes. Values
/// are written as they are, or rounded to 16 bits (see Layer::half). Throws Error (exit code 5),
/// leaving an older file untouched.
void write_exr(const std::filesystem::path& path, const Image& image,
               WriteMode mode = WriteMode::flushed);

/// Reads a single-part scan-line OpenEXR file with a lossless compression. Channels are grouped
/// into layers by their names up to the last dot (RGB, then A, then X, Y, Z, then the rest in
/// alphabetical order); a channel whose last part is longer than one letter becomes a layer of its
/// full name with the channel `Y`. Throws Error (exit code 2) for anything damaged or too large.
[[nodiscard]] Image read_exr(const std::filesystem::path& path);

/// From now on that many threads read and write one file together: for commands that do little
/// else. Throws std::system_error where no thread can be started.
void use_exr_threads(int threads);

}  // namespace weft

#endif
