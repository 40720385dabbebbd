// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_HALF_PLANE_H
#define WEFT_TESTS_TESTING_HALF_PLANE_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "tests/testing/scene_builder.h"

// Straight edges whose coverage of every pixel is known.
namespace weft::test {

inline constexpr double fov = 0.8;
inline constexpr double eye = 5.0;  ///< distance of the camera from the plane z = 0

inline Camera front_camera() {
    return look_at({0.0, 0.0, eye}, {0.0, 0.0, 0.0}, fov);
}

/// A line on the film in pixels from the upper left corner; the half-plane is
/// on the side of its normal.
struct Line {
    glm::dvec2 point, normal;

    [[nodiscard]] double distance(const glm::dvec2& p) const { return glm::dot(p - point, normal); }
};

/// Share of the pixel (x, y) on the side of the line's normal: its square
/// clipped by the line.
inline double coverage(const Line& line, std::uint32_t x, std::uint32_t y) {
    const glm::dvec2 corner(x, y);
    const glm::dvec2 square[] = {corner, corner + glm::dvec2(1, 0), corner + glm::dvec2(1, 1),
                                 corner + glm::dvec2(0, 1)};
    std::vector<glm::dvec2> kept;
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 a = square[i];
        const glm::dvec2 b = square[(i + 1) % 4];
        const double from = line.distance(a);
        const double to = line.distance(b);
        if (from >= 0.0) kept.push_back(a);
        if ((from >= 0.0) != (to >= 0.0)) kept.push_back(a + (b - a) * (from / (from - to)));
    }
    double doubled = 0.0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec2 a = kept[i];
        const glm::dvec2 b = kept[(i + 1) % kept.size()];
        doubled += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(doubled);
}

/// The half-plane that the line shows on the plane at `z`, 200 wide and 100
/// deep.
inline Mesh half_plane(const Line& line, double z, std::uint32_t width, std::uint32_t height) {
    const double pixel = 2.0 * (eye - z) * std::tan(0.5 * fov) / height;
    const glm::vec3 point((line.point.x - 0.5 * width) * pixel,
                          (0.5 * height - line.point.y) * pixel, z);
    const glm::vec3 inwards(line.normal.x, -line.normal.y, 0.0);
    const glm::vec3 along(inwards.y, -inwards.x, 0.0F);
    return quad_mesh(point - 100.0F * along, 200.0F * along, 100.0F * inwards);
}

/// A line near the centre of the image, its normal at that angle from the
/// film's x axis.
inline Line line_at(double degrees, std::uint32_t width, std::uint32_t height) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return {{0.5 * width + 0.21, 0.5 * height - 0.13}, {std::cos(angle), std::sin(angle)}};
}

}  // namespace weft::test

#endif
