// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/neighbour_clamping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace weft {
namespace {

constexpr std::size_t group = 8;  ///< records, or boxes, in a box

using Point = std::array<double, 3>;

/// Bounds of records, and their least radius.
struct Box {
    Point lower, upper;
    double radius;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Box empty_box{
    {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, infinity};

Box box_of(const shared::float4& place) {
    const Point p{double{place.x}, double{place.y}, double{place.z}};
    return {p, p, double{place.w}};
}

void grow(Box& box, const Box& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], other.lower[axis]);
        box.upper[axis] = std::max(box.upper[axis], other.upper[axis]);
    }
    box.radius = std::min(box.radius, other.radius);
}

/// Lower bound of the radii to which records of the box clamp one at `p`. Every step rounds alike
/// for a box and for what it holds, so that rounding makes no clamping record be skipped.
double bound(const Box& box, const Point& p, double slope) {
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double outside =
            std::max({0.0, box.lower[axis] - p[axis], p[axis] - box.upper[axis]});
        square += outside * outside;
    }
    return box.radius + slope * std::sqrt(square);
}

/// A tree of the records in their order: the first level holds them, each further one the boxes of
/// `group` of the level before.
std::vector<std::vector<Box>> levels_of(std::span<const shared::float4> places) {
    std::vector<std::vector<Box>> levels(1);
    for (const shared::float4& place : places) levels[0].push_back(box_of(place));
    while (levels.back().size() > 1) {
        const std::vector<Box>& below = levels.back();
        std::vector<Box> boxes((below.size() + group - 1) / group, empty_box);
        for (std::size_t i = 0; i < below.size(); ++i) grow(boxes[i / group], below[i]);
        levels.push_back(std::move(boxes));
    }
    return levels;
}

/// Clamps the radius of a record at `p` by those of the records in one box.
// NOLINTNEXTLINE(misc-no-recursion): as deep as the tree is high
void clamp_by(const std::vector<std::vector<Box>>& levels, std::size_t level, std::size_t index,
              const Point& p, double slope, double& radius) {
    const double least = bound(levels[level][index], p, slope);
    if (!(least < radius)) return;
    if (level == 0) {
        radius = least;
        return;
    }
    const std::size_t end = std::min(levels[level - 1].size(), (index + 1) * group);
    for (std::size_t i = index * group; i < end; ++i)
        clamp_by(levels, level - 1, i, p, slope, radius);
}

}  // namespace

std::vector<float> neighbour_clamped(std::span<const shared::float4> places, double slope) {
    const std::vector<std::vector<Box>> levels = levels_of(places);
    std::vector<float> radii;
    radii.reserve(places.size());
    for (const shared::float4& place : places) {
        const Point p{double{place.x}, double{place.y}, double{place.z}};
        double radius = place.w;
        clamp_by(levels, levels.size() - 1, 0, p, slope, radius);
        radii.push_back(static_cast<float>(radius));
    }
    return radii;
}

}  // namespace weft
