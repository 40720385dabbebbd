// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/smooth_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "selftest/scene_builder.h"

namespace weft::selftest {
namespace {

constexpr double albedo = 0.5;
constexpr double fov = 0.9;
const glm::dvec3 eye(0.0, 0.0, 3.0);
const glm::dvec3 travels(1.0, 0.1, 0.2);

// Far above the float error of barycentric coordinates and cosines, far below a pixel.
constexpr double rounding = 1e-5;

Mesh ball_mesh() {
    Mesh ball = icosphere(1, false);
    ball.normals = ball.positions;
    return ball;
}

/// The pixel if it sees this triangle from outside.
BallPixel pixel_on(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& direction) {
    const std::array from{corners[0] - eye, corners[1] - eye, corners[2] - eye};
    const glm::dvec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    BallPixel pixel;
    if (glm::dot(normal, from[0]) >= 0.0) return pixel;
    const glm::dvec3 edges(glm::dot(direction, glm::cross(from[2], from[1])),
                           glm::dot(direction, glm::cross(from[0], from[2])),
                           glm::dot(direction, glm::cross(from[1], from[0])));
    const glm::dvec3 weights = edges / (edges.x + edges.y + edges.z);
    const double least = std::min({weights.x, weights.y, weights.z});
    if (least < -rounding) return pixel;
    const glm::dvec3 light = -glm::normalize(travels);
    // Vertices of the unit ball are their own normals.
    const glm::dvec3 smooth =
        glm::normalize(weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2]);
    pixel.on_ball = true;
    pixel.facet_lit = glm::dot(normal, light) > 0.0;
    pixel.cosine = std::max(0.0, glm::dot(smooth, light));
    pixel.radiance = pixel.facet_lit ? albedo / std::numbers::pi * pixel.cosine : 0.0;
    pixel.undecided = least < rounding || std::abs(glm::dot(normal, light)) < rounding;
    return pixel;
}

}  // namespace

SmoothBall smooth_ball() {
    SceneBuilder builder;
    builder.add(ball_mesh(), builder.material(glm::vec3(static_cast<float>(albedo))));
    builder.light(LightType::directional, {}, glm::vec3(1.0F), travels);
    return {std::move(builder.scene), look_at(eye, {0.0, 0.0, 0.0}, fov)};
}

const std::vector<BallPixel>& ball_pixels() {
    static const std::vector<BallPixel> all = [] {
        const Mesh ball = ball_mesh();
        const double scale = 2.0 * std::tan(0.5 * fov) / ball_height;
        std::vector<BallPixel> pixels(std::size_t{ball_width} * ball_height);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const double x = static_cast<double>(i % ball_width) + 0.5 - 0.5 * ball_width;
            const double y = static_cast<double>(i / ball_width) + 0.5 - 0.5 * ball_height;
            for (const auto& [a, b, c] : ball.triangles) {
                const BallPixel pixel =
                    pixel_on({glm::dvec3(ball.positions[a]), glm::dvec3(ball.positions[b]),
                              glm::dvec3(ball.positions[c])},
                             {scale * x, -scale * y, -1.0});
                if (pixel.on_ball) pixels[i] = pixel;
            }
        }
        return pixels;
    }();
    return all;
}

double largest_block() {
    double largest = 0.0;
    for (const BallPixel& pixel : ball_pixels())
        if (pixel.on_ball && !pixel.undecided && !pixel.facet_lit)
            largest = std::max(largest, pixel.cosine);
    return largest;
}

}  // namespace weft::selftest
