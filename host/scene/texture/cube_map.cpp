// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture/cube_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>

namespace weft {
namespace {

/// Where a ray from the cube's middle meets it: s to the right and t down, from -1 to 1.
struct CubePoint {
    std::size_t face;
    double s, t;
};

CubePoint point_towards(const glm::dvec3& d) {
    const glm::dvec3 size = glm::abs(d);
    if (size.x >= size.y && size.x >= size.z)
        return d.x > 0.0 ? CubePoint{0, -d.z / size.x, -d.y / size.x}
                         : CubePoint{1, d.z / size.x, -d.y / size.x};
    if (size.y >= size.z)
        return d.y > 0.0 ? CubePoint{2, d.x / size.y, d.z / size.y}
                         : CubePoint{3, d.x / size.y, -d.z / size.y};
    return d.z > 0.0 ? CubePoint{4, d.x / size.z, -d.y / size.z}
                     : CubePoint{5, -d.x / size.z, -d.y / size.z};
}

/// The direction of a point in the plane of a face, which may lie beyond its edges.
glm::dvec3 direction_of(const CubePoint& p) {
    switch (p.face) {
        case 0:
            return {1.0, -p.t, -p.s};
        case 1:
            return {-1.0, -p.t, p.s};
        case 2:
            return {p.s, 1.0, p.t};
        case 3:
            return {p.s, -1.0, -p.t};
        case 4:
            return {p.s, -p.t, 1.0};
        default:
            return {-p.s, -p.t, -1.0};
    }
}

/// A texel of a face; beyond its edges the nearest one of the face that lies there.
glm::vec3 texel(const CubeMap& cube, std::size_t face, std::int64_t i, std::int64_t j) {
    const auto size = static_cast<std::int64_t>(cube.size);
    if (i < 0 || j < 0 || i >= size || j >= size) {
        const auto centre = [&](std::int64_t k) {
            return (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(size) - 1.0;
        };
        const CubePoint there = point_towards(direction_of({face, centre(i), centre(j)}));
        const auto nearest = [&](double s) {
            const double at = std::floor(0.5 * (s + 1.0) * static_cast<double>(size));
            return std::clamp(static_cast<std::int64_t>(at), std::int64_t{0}, size - 1);
        };
        face = there.face;
        i = nearest(there.s);
        j = nearest(there.t);
    }
    return cube.faces[face][static_cast<std::size_t>(j * size + i)];
}

}  // namespace

glm::vec3 radiance_from(const CubeMap& cube, const glm::dvec3& direction) {
    const CubePoint p = point_towards(direction);
    const double x = 0.5 * (p.s + 1.0) * cube.size - 0.5;
    const double y = 0.5 * (p.t + 1.0) * cube.size - 0.5;
    const auto i = static_cast<std::int64_t>(std::floor(x));
    const auto j = static_cast<std::int64_t>(std::floor(y));
    const auto a = static_cast<float>(x - std::floor(x));
    const auto b = static_cast<float>(y - std::floor(y));
    return glm::mix(glm::mix(texel(cube, p.face, i, j), texel(cube, p.face, i + 1, j), a),
                    glm::mix(texel(cube, p.face, i, j + 1), texel(cube, p.face, i + 1, j + 1), a),
                    b);
}

EnvironmentImage equirectangular(const CubeMap& cube) {
    EnvironmentImage image;
    image.width = 4 * cube.size;
    image.height = 2 * cube.size;
    image.radiance.reserve(std::size_t{3} * image.width * image.height);
    for (std::uint32_t row = 0; row < image.height; ++row) {
        const double theta = glm::pi<double>() * (row + 0.5) / image.height;
        for (std::uint32_t column = 0; column < image.width; ++column) {
            const double phi = 2.0 * glm::pi<double>() * ((column + 0.5) / image.width - 0.5);
            const glm::vec3 rgb =
                radiance_from(cube, {std::sin(theta) * std::cos(phi), std::cos(theta),
                                     std::sin(theta) * std::sin(phi)});
            image.radiance.insert(image.radiance.end(), {rgb.r, rgb.g, rgb.b});
        }
    }
    return image;
}

}  // namespace weft
