// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_ENVIRONMENT_IMAGES_H
#define WEFT_TESTS_TESTING_ENVIRONMENT_IMAGES_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>

#include "scene/environment_image.h"

// Images of the environment, and what they are from any direction: a reference implementation that
// adds up the tents of all texels.
namespace weft::test {

/// The direction with these coordinates in an image.
inline glm::dvec3 direction_at(double u, double v) {
    const double turn = 2.0 * std::numbers::pi * (u - 0.5);
    const double angle = std::numbers::pi * v;
    return {std::sin(angle) * std::cos(turn), std::cos(angle), std::sin(angle) * std::sin(turn)};
}

/// The direction of the middle of a texel.
inline glm::dvec3 texel_direction(const EnvironmentImage& image, std::uint32_t column,
                                  std::uint32_t row) {
    const double v = image.rows_at_poles ? static_cast<double>(row) / (image.height - 1)
                                         : (row + 0.5) / image.height;
    return direction_at((column + 0.5) / image.width, v);
}

/// An image with that radiance in the middle of each texel.
inline EnvironmentImage image_of(std::uint32_t width, std::uint32_t height, bool rows_at_poles,
                                 const std::function<glm::vec3(const glm::dvec3&)>& radiance) {
    EnvironmentImage image;
    image.name = "made up";
    image.width = width;
    image.height = height;
    image.rows_at_poles = rows_at_poles;
    for (std::uint32_t row = 0; row < height; ++row)
        for (std::uint32_t column = 0; column < width; ++column) {
            const glm::vec3 value = radiance(texel_direction(image, column, row));
            image.radiance.insert(image.radiance.end(), {value.r, value.g, value.b});
        }
    return image;
}

inline EnvironmentImage constant_image(const glm::vec3& radiance) {
    return image_of(4, 2, false, [&](const glm::dvec3&) { return radiance; });
}

/// A black image but for one texel.
inline EnvironmentImage one_texel(std::uint32_t width, std::uint32_t height, std::uint32_t column,
                                  std::uint32_t row, const glm::vec3& radiance) {
    EnvironmentImage image =
        image_of(width, height, false, [](const glm::dvec3&) { return glm::vec3(0.0F); });
    for (int c = 0; c < 3; ++c)
        image.radiance[3 * (std::size_t{row} * width + column) + static_cast<std::size_t>(c)] =
            radiance[c];
    return image;
}

/// A sky that grows brighter towards +y, and in it a small sun 1000 times as bright.
inline EnvironmentImage sunny_sky() {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, 0.5, 0.7));
    return image_of(64, 32, false, [&](const glm::dvec3& d) {
        return glm::dot(d, sun) > 0.99 ? glm::vec3(1000.0F, 900.0F, 700.0F)
                                       : glm::vec3(0.5F, 0.7F, 1.0F) * float(1.2 + d.y);
    });
}

/// Radiance from a unit direction in the frame of the image.
inline glm::dvec3 radiance_from(const EnvironmentImage& image, const glm::dvec3& direction) {
    const double width = image.width;
    const double u = 0.5 + std::atan2(direction.z, direction.x) / (2.0 * std::numbers::pi);
    const double v = std::acos(std::clamp(direction.y, -1.0, 1.0)) / std::numbers::pi;
    const double x = u * width - 0.5;
    const double y = image.rows_at_poles ? v * (image.height - 1) : v * image.height - 0.5;
    const auto tent = [](double distance) { return std::max(0.0, 1.0 - std::abs(distance)); };
    // The shorter way around.
    const auto across = [&](double at) {
        return image.width == 1 ? 1.0 : tent(x - at - width * std::round((x - at) / width));
    };
    glm::dvec3 sum(0.0);
    for (std::uint32_t row = 0; row < image.height; ++row) {
        const bool over_pole = !image.rows_at_poles && (row == 0 || row + 1 == image.height);
        if (tent(y - row) == 0.0 && !over_pole) continue;
        for (std::uint32_t column = 0; column < image.width; ++column) {
            double weight = across(column) * tent(y - row);
            if (over_pole) {
                // What lies over a pole is the same row on the other side; half of an odd width
                // lies between two texels.
                const double other = 0.5 * (across(column + std::floor(0.5 * width)) +
                                            across(column + std::ceil(0.5 * width)));
                if (row == 0) weight += other * tent(y + 1.0);
                if (row + 1 == image.height) weight += other * tent(y - image.height);
            }
            const std::size_t texel = 3 * (std::size_t{row} * image.width + column);
            sum += weight * glm::dvec3(image.radiance[texel], image.radiance[texel + 1],
                                       image.radiance[texel + 2]);
        }
    }
    return sum;
}

/// The integral over all directions of the radiance times `weight`, by the midpoint rule over rows
/// of equal height and columns, `steps` of each texel. Off by about 0.4 times the square of the
/// height of a step, in radians.
inline glm::dvec3 integral_over(const EnvironmentImage& image,
                                const std::function<double(const glm::dvec3&)>& weight,
                                std::uint32_t steps = 16) {
    const std::uint32_t rows = steps * std::max(image.height, 4U);
    const std::uint32_t columns = steps * std::max(image.width, 4U);
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < columns; ++j) {
            const double v = (i + 0.5) / rows;
            const glm::dvec3 d = direction_at((j + 0.5) / columns, v);
            const double weighed = weight(d);
            if (weighed != 0.0)
                sum += weighed * std::sin(std::numbers::pi * v) * radiance_from(image, d);
        }
    return sum * (2.0 * std::numbers::pi * std::numbers::pi / (double(rows) * columns));
}

/// Irradiance of a surface of that normal that nothing hides, in the frame of the image.
inline glm::dvec3 irradiance_by(const EnvironmentImage& image, const glm::dvec3& normal,
                                std::uint32_t steps = 16) {
    return integral_over(
        image, [&](const glm::dvec3& d) { return std::max(0.0, glm::dot(d, normal)); }, steps);
}

}  // namespace weft::test

#endif
