// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/load_image.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "image/exr.h"
#include "image/hdr.h"
#include "image/read_png.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view exr_mark = "\x76\x2f\x31\x01";
constexpr std::string_view png_mark = "\x89PNG\r\n\x1a\n";
constexpr std::string_view hdr_mark = "#?";

// Metadata key that only this file sets; it is removed from the metadata of any file that is read.
constexpr const char* display_key = "weft:display-referred";

/// The first bytes of a file, as many as identify its format.
std::string head_of(const fs::path& path) {
    const std::vector<std::byte> bytes = read_file_head(path, png_mark.size());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Image load_image(const fs::path& path) {
    const std::string head = head_of(path);
    if (head.starts_with(exr_mark)) {
        Image image = read_exr(path);
        image.metadata.erase(display_key);
        return image;
    }
    if (head.starts_with(hdr_mark)) return read_hdr(path);
    if (!head.starts_with(png_mark))
        throw input_error(path.string(),
                          "is not an image, expected an OpenEXR, Radiance HDR or PNG file");
    Image image = decode_png(read_file(path, limits::max_image_file_bytes), path.string());
    image.metadata[display_key] = "sRGB";
    return image;
}

bool is_display_referred(const Image& image) {
    return image.metadata.contains(display_key);
}

}  // namespace weft
