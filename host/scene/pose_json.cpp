// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/pose_json.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "scene/transform.h"

namespace weft {

Pose read_pose(const JsonValue& node) {
    const std::array<double, 3> t = node.numbers_or<3>("translation", {0.0, 0.0, 0.0});
    const std::array<double, 4> r = node.numbers_or<4>("rotation", {0.0, 0.0, 0.0, 1.0});
    const std::array<double, 3> s = node.numbers_or<3>("scale", {1.0, 1.0, 1.0});
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(std::abs(length - 1.0) < 0.1))
        throw node.at("rotation")
            .error("is a quaternion of length " + std::to_string(length) + ", expected 1");
    return {glm::dvec3(t[0], t[1], t[2]), unit_quaternion(glm::dvec4(r[0], r[1], r[2], r[3])),
            glm::dvec3(s[0], s[1], s[2])};
}

glm::dmat4 read_matrix(const JsonValue& value) {
    std::array<double, 16> identity{};
    for (std::size_t i = 0; i < 4; ++i) identity[5 * i] = 1.0;
    const std::array<double, 16> values = value.numbers_or<16>("matrix", identity);
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            matrix[column][row] = values[static_cast<std::size_t>(4 * column + row)];
    for (int column = 0; column < 4; ++column) {
        const double expected = column == 3 ? 1.0 : 0.0;
        if (std::abs(matrix[column][3] - expected) > 1e-6)
            throw value.at("matrix").error("is not affine, expected 0, 0, 0, 1 as its last row");
        matrix[column][3] = expected;
    }
    return matrix;
}

}  // namespace weft
