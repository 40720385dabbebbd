// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_density.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>

#include "base/file.h"
#include "scene/pose_json.h"

namespace weft {
namespace {

/// From the unit cube to a box of its lower and its upper corner.
glm::dmat4 read_box(const JsonValue& density) {
    const std::array<double, 6> box = density.numbers_or<6>("box", {});
    glm::dmat4 placement(1.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double edge = box.at(axis + 3) - box.at(axis);
        if (!(edge > 0.0) || !std::isfinite(edge))
            throw density.at("box").error(
                fmt::format("reaches from {} to {} along {}, expected increasing numbers",
                            box.at(axis), box.at(axis + 3), "xyz"[axis]));
        const auto i = static_cast<glm::length_t>(axis);
        placement[i][i] = edge;
        placement[3][i] = box.at(axis);
    }
    return placement;
}

glm::dmat4 read_invertible_matrix(const JsonValue& density) {
    const glm::dmat4 matrix = read_matrix(density);
    const double determinant = glm::determinant(glm::dmat3(matrix));
    if (determinant == 0.0 || !std::isfinite(1.0 / determinant))
        throw density.at("matrix").error("cannot be inverted, expected one that can");
    return matrix;
}

}  // namespace

void GltfDensities::read(const JsonValue& density, Medium& medium) {
    const JsonValue uri = density.at("uri");
    const glm::dmat4 matrix = read_invertible_matrix(density);
    glm::dmat4 placement(1.0);
    const bool boxed = density.find("box").has_value();
    if (boxed) placement = read_box(density);
    medium.grid = set_.add(resolve_reference(document_, uri.as_string(), uri.place(), true),
                           density.string_or("grid", ""), uri.place());
    if (!boxed) placement = grids_[static_cast<std::size_t>(medium.grid)].placement;
    medium.type = "heterogeneous";
    medium.grid_to_world = matrix * placement;
}

}  // namespace weft
