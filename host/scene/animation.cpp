// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/animation.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Where a time lies: `share` of the way from key `first` to the next, [0, 1). A share of 0 needs
/// no next key.
struct Place {
    std::size_t first = 0;
    double share = 0.0;
    double seconds = 0.0;  ///< between the two keys
};

Place place_of(const KeyTrack& track, double time) {
    const auto after =
        std::upper_bound(track.times.begin(), track.times.end(), time,
                         [](double t, float key) { return t < static_cast<double>(key); });
    if (after == track.times.begin()) return {};
    Place place{static_cast<std::size_t>(after - track.times.begin()) - 1, 0.0, 0.0};
    if (after == track.times.end()) return place;
    const auto start = static_cast<double>(track.times[place.first]);
    place.seconds = static_cast<double>(*after) - start;
    place.share = (time - start) / place.seconds;
    return place;
}

/// Number `i` of part `part` of key `key`: of a cubic track 0 and 2 are its tangents, 1 is its
/// value.
double number_of(const KeyTrack& track, std::size_t key, std::size_t part, std::size_t i) {
    const std::size_t parts = track.interpolation == Interpolation::cubic ? 3 : 1;
    return static_cast<double>(track.values[(key * parts + part) * track.width + i]);
}

std::size_t value_part(const KeyTrack& track) {
    return track.interpolation == Interpolation::cubic ? 1 : 0;
}

glm::dvec4 part_of(const KeyTrack& track, std::size_t key, std::size_t part) {
    glm::dvec4 value(0.0);
    for (std::uint32_t i = 0; i < track.width; ++i)
        value[static_cast<int>(i)] = number_of(track, key, part, i);
    return value;
}

glm::dvec4 value_of(const KeyTrack& track, std::size_t key) {
    return part_of(track, key, value_part(track));
}

/// Value of a cubic Hermite spline from `a` to `b` with the slopes at both ends, over a time of 1.
template <typename Value>
Value hermite(const Value& a, const Value& leaving, const Value& b, const Value& arriving,
              double t) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return a * (2.0 * t3 - 3.0 * t2 + 1.0) + leaving * (t3 - 2.0 * t2 + t) +
           b * (3.0 * t2 - 2.0 * t3) + arriving * (t3 - t2);
}

glm::dvec4 spline_at(const KeyTrack& track, const Place& place) {
    return hermite<glm::dvec4>(value_of(track, place.first),
                               part_of(track, place.first, 2) * place.seconds,
                               value_of(track, place.first + 1),
                               part_of(track, place.first + 1, 0) * place.seconds, place.share);
}

/// From unit quaternion `a` to `b` at constant speed. The two signs of a quaternion are the same
/// rotation; the nearer one makes the arc the shortest.
glm::dvec4 slerp(const glm::dvec4& a, const glm::dvec4& b, double share) {
    constexpr double nearly_equal = 1.0 - 1e-9;
    const double cosine = glm::dot(a, b);
    const glm::dvec4 to = cosine < 0.0 ? -b : b;
    const double near = std::abs(cosine);
    if (near > nearly_equal) return unit_quaternion(a + (to - a) * share);
    const double angle = std::acos(near);
    return unit_quaternion((a * std::sin((1.0 - share) * angle) + to * std::sin(share * angle)) /
                           std::sin(angle));
}

}  // namespace

glm::dvec4 unit_quaternion(const glm::dvec4& quaternion) {
    const double x = quaternion.x;
    const double y = quaternion.y;
    const double z = quaternion.z;
    const double w = quaternion.w;
    return quaternion / std::sqrt(x * x + y * y + z * z + w * w);
}

glm::dmat4 matrix_of(const Pose& pose) {
    const double x = pose.rotation.x;
    const double y = pose.rotation.y;
    const double z = pose.rotation.z;
    const double w = pose.rotation.w;
    const glm::dvec3 column_x(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y));
    const glm::dvec3 column_y(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x));
    const glm::dvec3 column_z(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
    return {glm::dvec4(column_x * pose.scale.x, 0.0), glm::dvec4(column_y * pose.scale.y, 0.0),
            glm::dvec4(column_z * pose.scale.z, 0.0), glm::dvec4(pose.translation, 1.0)};
}

glm::dvec3 vector_at(const KeyTrack& track, double time) {
    const Place place = place_of(track, time);
    const glm::dvec4 from = value_of(track, place.first);
    if (place.share <= 0.0 || track.interpolation == Interpolation::step) return glm::dvec3(from);
    if (track.interpolation == Interpolation::cubic) return glm::dvec3(spline_at(track, place));
    return glm::dvec3(from + (value_of(track, place.first + 1) - from) * place.share);
}

glm::dvec4 rotation_at(const KeyTrack& track, double time) {
    const Place place = place_of(track, time);
    const glm::dvec4 from = unit_quaternion(value_of(track, place.first));
    if (place.share <= 0.0 || track.interpolation == Interpolation::step) return from;
    if (track.interpolation == Interpolation::linear)
        return slerp(from, unit_quaternion(value_of(track, place.first + 1)), place.share);
    // Tangents may lead a spline through zero, which no rotation is near to.
    constexpr double least_length = 1e-6;
    const glm::dvec4 spline = spline_at(track, place);
    const double length = glm::length(spline);
    return length > least_length && std::isfinite(length) ? unit_quaternion(spline) : from;
}

std::vector<double> numbers_at(const KeyTrack& track, double time) {
    const Place place = place_of(track, time);
    const bool between = place.share > 0.0 && track.interpolation != Interpolation::step;
    const std::size_t part = value_part(track);
    std::vector<double> numbers(track.width);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double from = number_of(track, place.first, part, i);
        numbers[i] = from;
        if (!between) continue;
        const double to = number_of(track, place.first + 1, part, i);
        numbers[i] =
            track.interpolation == Interpolation::linear
                ? from + (to - from) * place.share
                : hermite(from, number_of(track, place.first, 2, i) * place.seconds, to,
                          number_of(track, place.first + 1, 0, i) * place.seconds, place.share);
    }
    return numbers;
}

glm::dmat4 local_at(const Animation& animation, const MovingNode& node, double time) {
    const auto track = [&](int index) -> const KeyTrack& {
        return animation.tracks[static_cast<std::size_t>(index)];
    };
    Pose pose = node.rest;
    if (node.translation >= 0) pose.translation = vector_at(track(node.translation), time);
    if (node.rotation >= 0) pose.rotation = rotation_at(track(node.rotation), time);
    if (node.scale >= 0) pose.scale = vector_at(track(node.scale), time);
    return matrix_of(pose);
}

std::vector<glm::dmat4> nodes_to_world_at(const Animation& animation, double time) {
    std::vector<glm::dmat4> to_world;
    to_world.reserve(animation.nodes.size());
    for (const MovingNode& node : animation.nodes) {
        const glm::dmat4 parent =
            node.parent < 0 ? glm::dmat4(1.0) : to_world[static_cast<std::size_t>(node.parent)];
        to_world.push_back(parent * node.to_parent * local_at(animation, node, time));
    }
    return to_world;
}

glm::dmat4 to_world_at(const Animation& animation, const Attachment& attachment, double time) {
    const auto node_at = [&](int index) -> const MovingNode& {
        return animation.nodes[static_cast<std::size_t>(index)];
    };
    std::vector<int> way;
    for (int node = attachment.node; node >= 0; node = node_at(node).parent) way.push_back(node);
    glm::dmat4 to_world(1.0);
    for (auto index = way.rbegin(); index != way.rend(); ++index) {
        const MovingNode& node = node_at(*index);
        to_world = to_world * node.to_parent * local_at(animation, node, time);
    }
    return to_world * attachment.to_node;
}

std::uint64_t frame_count(double seconds, double frame_rate) {
    // Rounding must not drop a key that lies on a frame.
    constexpr double rounding = 1e-6;
    constexpr double most = 1e15;
    const double steps = std::min(std::floor(seconds * frame_rate * (1.0 + rounding)), most);
    return static_cast<std::uint64_t>(steps) + 1;
}

}  // namespace weft
