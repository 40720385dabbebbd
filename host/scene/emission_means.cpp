// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/emission_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

/// Most rows of look-ups in a triangle, which are no further apart than the texels they read.
constexpr int most_rows = 8;

/// Texel of a row of `size` that stands for the whole number `i`, however far outside it lies.
std::size_t wrapped(double i, std::uint32_t size, Wrap wrap) {
    const auto n = static_cast<double>(size);
    if (wrap == Wrap::clamp) return static_cast<std::size_t>(std::clamp(i, 0.0, n - 1.0));
    const double period = wrap == Wrap::mirror ? 2.0 * n : n;
    double inside = i - period * std::floor(i / period);
    if (inside >= n) inside = period - 1.0 - inside;
    return static_cast<std::size_t>(std::clamp(inside, 0.0, n - 1.0));
}

/// Bilinear look-up.
glm::dvec3 look_up(const LinearLevel& level, const Texture& texture, const glm::dvec2& uv) {
    const double x = uv.x * level.width - 0.5;
    const double y = uv.y * level.height - 0.5;
    glm::dvec3 sum(0.0);
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            const double column = std::floor(x) + dx;
            const double row = std::floor(y) + dy;
            const std::size_t texel = wrapped(row, level.height, texture.wrap_v) * level.width +
                                      wrapped(column, level.width, texture.wrap_u);
            const float* const value = &level.values[3 * texel];
            sum += (1.0 - std::abs(x - column)) * (1.0 - std::abs(y - row)) *
                   glm::dvec3(value[0], value[1], value[2]);
        }
    return sum;
}

glm::dvec3 mean_over(const std::array<glm::dvec2, 3>& corners, const Texture& texture,
                     const std::vector<LinearLevel>& levels) {
    const glm::dvec2 texels(texture.width, texture.height);
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        longest = std::max(longest, glm::length((corners[(i + 1) % 3] - corners[i]) * texels));
    const int rows = static_cast<int>(std::clamp(std::ceil(longest), 1.0, double{most_rows}));
    const double halvings = std::ceil(std::log2(std::max(1.0, longest / rows)));
    const auto last = static_cast<double>(levels.size() - 1);
    const LinearLevel& level = levels[static_cast<std::size_t>(std::min(halvings, last))];
    const glm::dvec2 a = (corners[1] - corners[0]) / static_cast<double>(rows);
    const glm::dvec2 b = (corners[2] - corners[0]) / static_cast<double>(rows);
    // The triangle is cut into rows^2 equal ones, and looked up in the middle of each.
    glm::dvec3 sum(0.0);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; i + j < rows; ++j) {
            const glm::dvec2 corner =
                corners[0] + static_cast<double>(i) * a + static_cast<double>(j) * b;
            sum += look_up(level, texture, corner + (a + b) / 3.0);
            if (i + j + 1 < rows) sum += look_up(level, texture, corner + (a + b) * (2.0 / 3.0));
        }
    return sum / static_cast<double>(rows * rows);
}

}  // namespace

std::vector<glm::vec3> EmissionMeans::of(const Mesh& mesh, int number) {
    const Texture& texture = scene_.textures[static_cast<std::size_t>(number)];
    if (number != last_) levels_ = linear_mip_levels(texture);
    last_ = number;
    const std::vector<glm::vec2>& uvs = emission_uvs(mesh);
    std::vector<glm::vec3> means;
    means.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        std::array<glm::dvec2, 3> corners{};
        for (std::size_t i = 0; i < 3 && !uvs.empty(); ++i)
            corners[i] = glm::dvec2(uvs[triangle[i]]);
        means.emplace_back(mean_over(corners, texture, levels_));
    }
    return means;
}

}  // namespace weft
