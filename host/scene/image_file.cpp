// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/image_file.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "scene/stb_image_configuration.h"

#include <stb/stb_image.h>

namespace weft {
namespace {

constexpr const char* expected = "expected a PNG, JPEG, BMP or TGA picture";

struct StbiFree {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

/// A progressive JPEG may hold any number of scans of a few bytes, each of which costs a pass over
/// the whole picture. Real encoders write about ten.
void check_jpeg_scans(std::span<const std::byte> bytes, const std::string& place) {
    constexpr std::size_t max_scans = 64;
    if (bytes.size() < 2 || bytes[0] != std::byte{0xFF} || bytes[1] != std::byte{0xD8}) return;
    std::size_t scans = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i)
        scans += bytes[i] == std::byte{0xFF} && bytes[i + 1] == std::byte{0xDA} ? 1 : 0;
    if (scans > max_scans)
        throw input_error(place, "JPEG picture with " + std::to_string(scans) +
                                     " scans, expected at most " + std::to_string(max_scans));
}

}  // namespace

Texture decode_image(std::span<const std::byte> bytes, const std::string& place) {
    const std::size_t max_bytes =
        std::min<std::size_t>(limits::max_image_file_bytes, std::numeric_limits<int>::max());
    if (bytes.size() > max_bytes)
        throw input_error(place, "picture file is longer than the limit of " +
                                     std::to_string(max_bytes) + " bytes");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (length == 0 || stbi_info_from_memory(data, length, &width, &height, &channels) == 0 ||
        width <= 0 || height <= 0)
        throw input_error(place, std::string("picture cannot be decoded, ") + expected);
    constexpr int max_edge = static_cast<int>(limits::max_texture_edge);
    const std::size_t decoded =
        std::size_t{4} * static_cast<unsigned>(width) * static_cast<unsigned>(height);
    if (width > max_edge || height > max_edge || decoded > limits::max_texture_bytes)
        throw input_error(place, "picture of " + std::to_string(width) + " x " +
                                     std::to_string(height) + " pixels, expected at most " +
                                     std::to_string(max_edge) + " along each edge");
    check_jpeg_scans(bytes, place);
    const std::unique_ptr<stbi_uc, StbiFree> pixels(
        stbi_load_from_memory(data, length, &width, &height, &channels, 4));
    if (!pixels) {
        const char* why = stbi_failure_reason();
        throw input_error(place, std::string("picture is damaged (") +
                                     (why != nullptr ? why : "unknown reason") + "), " + expected);
    }
    const std::size_t size =
        std::size_t{4} * static_cast<unsigned>(width) * static_cast<unsigned>(height);
    Texture texture;
    texture.name = place;
    texture.width = static_cast<std::uint32_t>(width);
    texture.height = static_cast<std::uint32_t>(height);
    texture.rgba.assign(pixels.get(), pixels.get() + size);
    return texture;
}

Texture read_image(const std::filesystem::path& path, const std::string& place) {
    const std::vector<std::byte> bytes = read_file(path, limits::max_image_file_bytes, place);
    Texture texture = decode_image(bytes, place.empty() ? path.string() : place);
    texture.name = path.filename().string();
    return texture;
}

}  // namespace weft
