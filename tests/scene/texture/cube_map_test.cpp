// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture/cube_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace weft::cube_map_test {
namespace {

/// Each texel holds the unit vector to its middle, raised by 1, as OpenGL defines the faces.
CubeMap directions(std::uint32_t size) {
    CubeMap cube;
    cube.size = size;
    for (std::size_t face = 0; face < 6; ++face)
        for (std::uint32_t j = 0; j < size; ++j)
            for (std::uint32_t i = 0; i < size; ++i) {
                const double s = (2.0 * i + 1.0) / size - 1.0;
                const double t = (2.0 * j + 1.0) / size - 1.0;
                const std::array<glm::dvec3, 6> all = {
                    glm::dvec3(1.0, -t, -s), glm::dvec3(-1.0, -t, s), glm::dvec3(s, 1.0, t),
                    glm::dvec3(s, -1.0, -t), glm::dvec3(s, -t, 1.0),  glm::dvec3(-s, -t, -1.0)};
                cube.faces[face].push_back(glm::vec3(glm::normalize(all[face]) + 1.0));
            }
    return cube;
}

TEST(CubeMap, IsSmoothOverEdgesAndCorners) {
    const CubeMap cube = directions(64);
    for (int k = 0; k < 4000; ++k) {
        // Points all around, by a Fibonacci lattice.
        const double y = 1.0 - (2.0 * k + 1.0) / 4000.0;
        const double r = std::sqrt(1.0 - y * y);
        const double phi = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const glm::dvec3 d(r * std::cos(phi), y, r * std::sin(phi));
        const glm::vec3 found = radiance_from(cube, 3.0 * d);
        EXPECT_LT(glm::length(found - 1.0F - glm::vec3(d)), 0.025F) << k;
    }
}

TEST(CubeMap, BecomesAnImageInEquirectangularProjection) {
    const EnvironmentImage image = equirectangular(directions(16));
    ASSERT_EQ(image.width, 64u);
    ASSERT_EQ(image.height, 32u);
    ASSERT_EQ(image.radiance.size(), 3u * 64u * 32u);
    EXPECT_FALSE(image.rows_at_poles);
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        const float* const rgb = &image.radiance[3 * (std::size_t{64} * row + column)];
        return glm::vec3(rgb[0], rgb[1], rgb[2]) - 1.0F;
    };
    // The middle lies at +x, a quarter to the right of it +z, the upper edge at +y.
    EXPECT_LT(glm::length(at(32, 16) - glm::vec3(1, 0, 0)), 0.1F);
    EXPECT_LT(glm::length(at(48, 16) - glm::vec3(0, 0, 1)), 0.1F);
    EXPECT_LT(glm::length(at(16, 16) - glm::vec3(0, 0, -1)), 0.1F);
    EXPECT_LT(glm::length(at(0, 16) - glm::vec3(-1, 0, 0)), 0.1F);
    EXPECT_LT(glm::length(at(5, 0) - glm::vec3(0, 1, 0)), 0.1F);
    EXPECT_LT(glm::length(at(5, 31) - glm::vec3(0, -1, 0)), 0.1F);
}

}  // namespace
}  // namespace weft::cube_map_test
