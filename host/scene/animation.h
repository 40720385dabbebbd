// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_ANIMATION_H
#define WEFT_SCENE_ANIMATION_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace weft {

/// A transform in parts: scaled first, then rotated, then moved.
struct Pose {
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x, y, z, w
    glm::dvec3 scale{1.0};
};

[[nodiscard]] glm::dmat4 matrix_of(const Pose& pose);

/// `quaternion` divided by its length.
[[nodiscard]] glm::dvec4 unit_quaternion(const glm::dvec4& quaternion);

enum class Interpolation : std::uint8_t {
    step,    ///< a key holds until the next
    linear,  ///< straight between keys; rotations at constant speed along the shortest arc
    cubic,   ///< cubic Hermite spline with the tangents of the keys
};

/// The values of one property of a node over time, which are constant before the first and after
/// the last key.
struct KeyTrack {
    Interpolation interpolation = Interpolation::linear;
    std::uint32_t width = 3;   ///< numbers of a value: 3 of a vector, 4 of a quaternion x, y, z, w,
                               ///< any number of weights
    std::vector<float> times;  ///< seconds, strictly increasing, at least one
    std::vector<float> values;  ///< `width` a key; cubic: in-tangent, value, out-tangent of each

    [[nodiscard]] std::size_t keys() const noexcept { return times.size(); }
};

/// Value of a track of vectors at `time`, seconds.
[[nodiscard]] glm::dvec3 vector_at(const KeyTrack& track, double time);

/// Value of a track of rotations at `time`, seconds: a unit quaternion.
[[nodiscard]] glm::dvec4 rotation_at(const KeyTrack& track, double time);

/// All numbers of the value of a track of any width at `time`, seconds, each for itself.
[[nodiscard]] std::vector<double> numbers_at(const KeyTrack& track, double time);

/// A node whose local transform changes. Its transform to the world is the product, from the left,
/// of that of `parent` (the moving node above it), that of the resting nodes in between, and its
/// own.
struct MovingNode {
    int parent = -1;  ///< index into Animation::nodes, below this node's own; -1: the world
    glm::dmat4 to_parent{1.0};
    Pose rest;                                        ///< values of properties without a track
    int translation = -1, rotation = -1, scale = -1;  ///< index into Animation::tracks, or -1
};

/// Attaches an instance, light or camera to a moving node, or with -1 to the world.
struct Attachment {
    int node = -1;            ///< index into Animation::nodes
    glm::dmat4 to_node{1.0};  ///< through the resting nodes below the moving one

    [[nodiscard]] bool moves() const noexcept { return node >= 0; }
};

/// One of the animations of a file. All of them play at once; where several move the same
/// property, the first does.
struct AnimationClip {
    std::string name;
    double duration = 0.0;            ///< seconds from 0 to its last key
    std::size_t channels = 0;         ///< properties that it animates by the file
    std::size_t channels_played = 0;  ///< those of them that move something
};

/// The animation of a scene.
struct Animation {
    std::vector<AnimationClip> clips;
    std::vector<KeyTrack> tracks;
    std::vector<MovingNode> nodes;  ///< parents before children
};

/// Frames per second where none are named.
inline constexpr double default_frame_rate = 30.0;

/// The frames of so many seconds at a frame rate, 1 and up. A last key between two frames is shown
/// by the frame before it.
[[nodiscard]] std::uint64_t frame_count(double seconds, double frame_rate);

/// A moving node's own transform at `time`, seconds.
[[nodiscard]] glm::dmat4 local_at(const Animation& animation, const MovingNode& node, double time);

/// The transforms to the world of all moving nodes at `time`, seconds.
[[nodiscard]] std::vector<glm::dmat4> nodes_to_world_at(const Animation& animation, double time);

/// The transform to the world by an attachment, at `time`, seconds.
[[nodiscard]] glm::dmat4 to_world_at(const Animation& animation, const Attachment& attachment,
                                     double time);

}  // namespace weft

#endif
