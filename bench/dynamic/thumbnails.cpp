// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/thumbnails.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <vector>

#include "image/png.h"

namespace weft::bench {

Image thumbnail(const Image& image) {
    const std::uint32_t longest = std::max(image.width, image.height);
    const std::uint32_t block = (longest + thumbnail_edge - 1) / thumbnail_edge;
    Image small;
    small.width = std::max(1U, image.width / block);
    small.height = std::max(1U, image.height / block);
    const Layer& layer = *image.find("");
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const std::size_t small_pixels = std::size_t{small.width} * small.height;
    std::vector<float> values(layer.channels.size() * small_pixels, 0.0F);
    const float share = 1.0F / static_cast<float>(block * block);
    for (std::size_t channel = 0; channel < layer.channels.size(); ++channel)
        for (std::uint32_t y = 0; y < std::min(image.height, small.height * block); ++y)
            for (std::uint32_t x = 0; x < std::min(image.width, small.width * block); ++x)
                values[channel * small_pixels + (y / block) * small.width + x / block] +=
                    share * layer.values[channel * pixels + std::size_t{y} * image.width + x];
    small.layers.push_back({"", layer.channels, std::move(values)});
    return small;
}

std::string write_thumbnail(const std::filesystem::path& folder, const std::string& name,
                            const Image& image, double exposure) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::string file;
    for (const char c : name) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
        if (plain) file += c;
        if (c == ' ') file += '-';
    }
    file += ".png";
    write_png(folder / file, thumbnail(image), exposure);
    return file;
}

}  // namespace weft::bench
