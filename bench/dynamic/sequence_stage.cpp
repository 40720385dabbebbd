// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/sequence_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/field_of_view.h"

namespace weft::bench {
namespace {

/// The axis of the world that a direction is closest to, on its side.
glm::dvec3 nearest_axis(const glm::dvec3& direction) {
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(direction[axis]) > std::abs(direction[longest])) longest = axis;
    glm::dvec3 found(0.0);
    found[longest] = direction[longest] < 0.0 ? -1.0 : 1.0;
    return found;
}

}  // namespace

double view_distance(const Camera& camera, SceneProbe& probe) {
    const glm::dvec3 eye(camera.to_world[3]);
    const glm::dvec3 forward = -glm::dvec3(camera.to_world[2]);
    // Where the middle shows nothing, something beside it may tell how large the scene is.
    const glm::dvec3 down = -0.2 * glm::normalize(glm::dvec3(camera.to_world[1]));
    for (const glm::dvec3& way : {forward, glm::normalize(forward) + down})
        if (const auto distance = probe.distance(eye, way)) return *distance;
    return 1.0;
}

SequenceStage::SequenceStage(const Camera& camera, SceneProbe& probe)
    : probe_(probe),
      eye_(camera.to_world[3]),
      up_(nearest_axis(glm::dvec3(camera.to_world[1]))),
      tangent_(vertical_tangent(camera, 1.0)) {
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(camera.to_world[2]));
    glm::dvec3 level = forward - glm::dot(forward, up_) * up_;
    if (!(glm::length(level) > 0.1)) level = glm::dvec3(camera.to_world[1]);
    level -= glm::dot(level, up_) * up_;
    ahead_ = glm::normalize(level);
    right_ = glm::cross(ahead_, up_);
    depth_ = view_distance(camera, probe) * std::max(0.1, glm::dot(forward, ahead_));
}

glm::dvec3 SequenceStage::level_point(double ahead, double right) const {
    return eye_ + depth_ * (ahead * ahead_ + right * right_);
}

double SequenceStage::depth_to_floor(const glm::dvec3& point) {
    constexpr double beside = 0.04;
    double deepest = 0.0;
    for (const auto& [x, y] :
         {std::array{0.0, 0.0}, std::array{beside, 0.0}, std::array{-beside, 0.0},
          std::array{0.0, beside}, std::array{0.0, -beside}}) {
        const auto found = probe_.distance(point + depth_ * (x * right_ + y * ahead_), -up_);
        if (found) deepest = std::max(deepest, *found);
    }
    return deepest > 0.0 ? deepest : 0.3 * depth_;
}

glm::dvec3 SequenceStage::floor_at(double ahead, double right) {
    const glm::dvec3 point = level_point(ahead, right);
    return point - depth_to_floor(point) * up_;
}

std::vector<glm::dvec3> SequenceStage::free_places(std::size_t count) {
    struct Place {
        glm::dvec3 foot;
        double depth;
    };
    std::vector<Place> places;
    for (const double right : {0.0, -0.28, 0.28})
        for (const double ahead : {0.62, 0.78, 0.92}) {
            const glm::dvec3 point = level_point(ahead, right);
            const auto clear = probe_.distance(eye_, point - eye_);
            if (clear && *clear < glm::length(point - eye_)) continue;
            if (const auto depth = probe_.distance(point, -up_))
                places.push_back({point - *depth * up_, *depth});
        }
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.depth > b.depth; });
    std::vector<glm::dvec3> feet;
    const double apart = 0.2 * depth_;
    for (const Place& place : places) {
        const bool crowded = std::any_of(feet.begin(), feet.end(), [&](const glm::dvec3& foot) {
            return glm::length(foot - place.foot) < apart;
        });
        if (feet.size() < count && !crowded) feet.push_back(place.foot);
    }
    return feet;
}

SequenceStage::Side SequenceStage::side() {
    constexpr double ahead = 0.6;
    const double seen = 0.8 * tangent_ * ahead * depth_;
    const glm::dvec3 middle = level_point(ahead, 0.0);
    Side side;
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& way : {right_, -right_}) {
        const double wall = probe_.distance(middle, way).value_or(seen);
        if (wall >= nearest) continue;
        nearest = wall;
        side.foot = middle + std::min(0.97 * wall, seen) * way;
        side.inwards = -way;
    }
    const double below = depth_to_floor(side.foot);
    const double above = probe_.distance(side.foot, up_).value_or(0.2 * depth_);
    side.foot -= below * up_;
    side.height = below + above;
    return side;
}

glm::dmat4 SequenceStage::standing(const glm::dvec3& foot, const glm::dvec3& x, double size) const {
    // A hair above the floor, so that no two faces lie in one plane.
    const glm::dvec3 lifted = foot + 1e-3 * size * up_;
    return {glm::dvec4(size * x, 0.0), glm::dvec4(size * up_, 0.0),
            glm::dvec4(size * glm::cross(x, up_), 0.0), glm::dvec4(lifted, 1.0)};
}

}  // namespace weft::bench
