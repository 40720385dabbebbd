// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture/environment_file.h"

#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/limits.h"
#include "image/load_image.h"

namespace weft {
namespace {

// What an infinite value stands for: 16-bit floats of OpenEXR files overflow in the sun.
constexpr float largest_half = 65504.0F;

/// Where red, green and blue are among the planes of the beauty.
std::array<std::size_t, 3> planes_of(const Layer* beauty, const std::string& place) {
    const std::string channels = beauty == nullptr ? "" : beauty->channels;
    std::array<std::size_t, 3> planes{};
    for (std::size_t c = 0; c < 3; ++c) planes[c] = channels.find("RGB"[c]);
    if (planes[0] == std::string::npos && planes[1] == std::string::npos &&
        planes[2] == std::string::npos)
        planes.fill(channels.find('Y'));
    for (const std::size_t plane : planes)
        if (plane == std::string::npos)
            throw input_error(place,
                              "has no colour to light a scene with, expected the channels R, G "
                              "and B");
    return planes;
}

/// The value as a radiance; counts it where it is none.
float mend(float value, std::size_t& mended) {
    if (std::isfinite(value) && value >= 0.0F) return value;
    ++mended;
    return value > 0.0F ? largest_half : 0.0F;
}

}  // namespace

EnvironmentFile read_environment(const std::filesystem::path& path) {
    const std::string place = path.string();
    const Image image = load_image(path);
    const std::size_t pixels = std::size_t{image.width} * image.height;
    if (pixels > limits::max_environment_pixels)
        throw input_error(place, "has " + std::to_string(image.width) + " x " +
                                     std::to_string(image.height) + " pixels, expected at most " +
                                     std::to_string(limits::max_environment_pixels));
    const Layer* const beauty = image.find("");
    const std::array<std::size_t, 3> planes = planes_of(beauty, place);
    EnvironmentFile file{std::make_shared<EnvironmentImage>()};
    file.image->name = path.filename().string();
    file.image->width = image.width;
    file.image->height = image.height;
    file.image->radiance.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            file.image->radiance[3 * i + c] =
                mend(beauty->values[planes[c] * pixels + i], file.mended);
    return file;
}

}  // namespace weft
