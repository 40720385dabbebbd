// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture/image_file.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/texture/jpeg.h"
#include "scene/texture/stb_image_configuration.h"

#include <stb/stb_image.h>

namespace weft {
namespace {

constexpr const char* expected = "expected a PNG, JPEG, BMP or TGA image";

struct StbiFree {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

/// More bytes than any decoder needs in one block: pixels of 8 bytes, rounded up to blocks of 32,
/// in a buffer that grows by doubling, or twice the file.
std::size_t largest_block(std::size_t file_bytes, int width, int height) {
    const std::size_t pixels =
        (static_cast<std::size_t>(width) + 64) * (static_cast<std::size_t>(height) + 64);
    constexpr std::size_t tables = std::size_t{1} << 20;
    return std::max(2 * file_bytes, 16 * pixels) + tables;
}

/// Refuses images that are too large, before they are decoded.
void check_size(std::uint32_t width, std::uint32_t height, const std::string& place) {
    const std::size_t decoded = std::size_t{4} * width * height;
    if (width > limits::max_texture_edge || height > limits::max_texture_edge ||
        decoded > limits::max_texture_bytes)
        throw input_error(place, "image of " + std::to_string(width) + " x " +
                                     std::to_string(height) + " pixels, expected at most " +
                                     std::to_string(limits::max_texture_edge) + " along each edge");
}

}  // namespace

Texture decode_image(std::span<const std::byte> bytes, const std::string& place) {
    const std::size_t max_bytes =
        std::min<std::size_t>(limits::max_image_file_bytes, std::numeric_limits<int>::max());
    if (bytes.size() > max_bytes)
        throw input_error(place, "image file is longer than the limit of " +
                                     std::to_string(max_bytes) + " bytes");
    if (is_jpeg(bytes)) return decode_jpeg(bytes, place, check_size);
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = static_cast<int>(bytes.size());
    stbi_max_block = largest_block(bytes.size(), 0, 0);
    int width = 0;
    int height = 0;
    int channels = 0;
    const bool known =
        length > 0 && stbi_info_from_memory(data, length, &width, &height, &channels) != 0;
    // A BMP whose rows begin at the top says so by a negative height.
    if (height < 0 && height > std::numeric_limits<int>::min()) height = -height;
    if (!known || width <= 0 || height <= 0)
        throw input_error(place, std::string("image cannot be decoded, ") + expected);
    check_size(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), place);
    stbi_max_block = largest_block(bytes.size(), width, height);
    const std::unique_ptr<stbi_uc, StbiFree> pixels(
        stbi_load_from_memory(data, length, &width, &height, &channels, 4));
    if (!pixels) {
        const char* why = stbi_failure_reason();
        throw input_error(place, "image is damaged (" +
                                     quote(why != nullptr ? why : "unknown reason") + "), " +
                                     expected);
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
