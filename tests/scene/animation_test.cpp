// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace weft::animation_test {
namespace {

constexpr double pi = std::numbers::pi;
// Keys are floats, and so are the closed forms only that exact.
constexpr double tolerance = 1e-6;

KeyTrack vectors(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
    return {interpolation, 3, std::move(times), std::move(values)};
}

KeyTrack rotations(Interpolation interpolation, std::vector<float> times,
                   const std::vector<glm::dvec4>& values) {
    KeyTrack track{interpolation, 4, std::move(times), {}};
    for (const glm::dvec4& value : values)
        for (int i = 0; i < 4; ++i) track.values.push_back(static_cast<float>(value[i]));
    return track;
}

/// A turn about +y.
glm::dvec4 turn(double angle) {
    return {0.0, std::sin(0.5 * angle), 0.0, std::cos(0.5 * angle)};
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double within = tolerance) {
    EXPECT_LE(glm::length(a - b), within)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// The same rotation, whichever sign its quaternion has.
void expect_same_rotation(const glm::dvec4& a, const glm::dvec4& b, double within = tolerance) {
    EXPECT_NEAR(glm::length(a), 1.0, 1e-12);
    EXPECT_GE(std::abs(glm::dot(a, b)), 1.0 - within)
        << a.x << ' ' << a.y << ' ' << a.z << ' ' << a.w << " is not " << b.x << ' ' << b.y << ' '
        << b.z << ' ' << b.w;
}

TEST(Animation, LinearKeysAreJoinedByStraightLines) {
    const KeyTrack track = vectors(Interpolation::linear, {1, 2, 4}, {0, 0, 0, 1, -2, 4, 3, 2, 4});
    EXPECT_EQ(vector_at(track, 1.0), glm::dvec3(0, 0, 0));
    EXPECT_EQ(vector_at(track, 1.25), glm::dvec3(0.25, -0.5, 1));
    EXPECT_EQ(vector_at(track, 2.0), glm::dvec3(1, -2, 4));
    EXPECT_EQ(vector_at(track, 3.5), glm::dvec3(2.5, 1, 4));
    EXPECT_EQ(vector_at(track, 4.0), glm::dvec3(3, 2, 4));
}

TEST(Animation, StepsHoldUntilTheNextKey) {
    const KeyTrack track = vectors(Interpolation::step, {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
    EXPECT_EQ(vector_at(track, 0.999), glm::dvec3(1));
    EXPECT_EQ(vector_at(track, 1.0), glm::dvec3(2));
    EXPECT_EQ(vector_at(track, 1.999), glm::dvec3(2));
    EXPECT_EQ(vector_at(track, 2.0), glm::dvec3(3));
    const KeyTrack turns = rotations(Interpolation::step, {0, 1}, {turn(0.3), turn(2.0)});
    expect_same_rotation(rotation_at(turns, 0.9), turn(0.3));
    expect_same_rotation(rotation_at(turns, 1.0), turn(2.0));
}

TEST(Animation, RestsOutsideOfItsKeys) {
    const std::vector<float> values{1, 2, 3, 4, 5, 6};
    for (const Interpolation kind : {Interpolation::linear, Interpolation::step}) {
        const KeyTrack track = vectors(kind, {1, 2}, values);
        EXPECT_EQ(vector_at(track, 0.0), glm::dvec3(1, 2, 3));
        EXPECT_EQ(vector_at(track, 1e30), glm::dvec3(4, 5, 6));
    }
    // Neither tangent at the ends leads on.
    const KeyTrack cubic = vectors(Interpolation::cubic, {1, 2},
                                   {9, 9, 9, 1, 2, 3, 9, 9, 9, 9, 9, 9, 4, 5, 6, 9, 9, 9});
    EXPECT_EQ(vector_at(cubic, 0.5), glm::dvec3(1, 2, 3));
    EXPECT_EQ(vector_at(cubic, 2.5), glm::dvec3(4, 5, 6));
    const KeyTrack turns = rotations(Interpolation::linear, {1, 2}, {turn(0.5), turn(1.0)});
    expect_same_rotation(rotation_at(turns, 0.0), turn(0.5));
    expect_same_rotation(rotation_at(turns, 9.0), turn(1.0));
    for (const Interpolation kind : {Interpolation::linear, Interpolation::step})
        EXPECT_EQ(vector_at(vectors(kind, {3}, {7, 8, 9}), 5.0), glm::dvec3(7, 8, 9));
}

TEST(Animation, CubicSplinesMeetAnyCubicPolynomial) {
    // x = t^3 - 2 t, y = t^2, z = 5 with their own derivatives as tangents are met everywhere.
    const auto at = [](double t) { return glm::dvec3(t * t * t - 2 * t, t * t, 5); };
    const auto slope = [](double t) { return glm::dvec3(3 * t * t - 2, 2 * t, 0); };
    KeyTrack track = vectors(Interpolation::cubic, {0, 0.5, 2, 2.25}, {});
    for (const float t : track.times) {
        const auto time = static_cast<double>(t);
        for (const glm::dvec3& part : {slope(time), at(time), slope(time)})
            for (int i = 0; i < 3; ++i) track.values.push_back(static_cast<float>(part[i]));
    }
    for (double t = 0.0; t < 2.25; t += 0.03125) expect_near(vector_at(track, t), at(t));
}

TEST(Animation, CubicTangentsLeaveAndArriveOnTheirOwnSides) {
    // Between keys 0 and 1 at 2 s: out-tangent 1 of the first, in-tangent 0 of the second, the
    // others would be noticed. Hermite at the middle: (0 + 1) / 2 + 2 s / 8 * (1 - 0).
    const KeyTrack track = vectors(Interpolation::cubic, {0, 2},
                                   {50, 50, 50, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 70, 70, 70});
    expect_near(vector_at(track, 1.0), glm::dvec3(0.75));
}

TEST(Animation, RotationsTurnAtConstantSpeed) {
    const KeyTrack track = rotations(Interpolation::linear, {0, 2}, {turn(0.2), turn(2.8)});
    for (double t = 0.0; t <= 2.0; t += 0.125)
        expect_same_rotation(rotation_at(track, t), turn(0.2 + 1.3 * t), 1e-12);
}

TEST(Animation, RotationsTakeTheShortestWay) {
    // From 10 to 350 degrees it is 20 degrees through 0, not 340; the quaternions' signs, of which
    // each rotation has two, make no difference.
    const glm::dvec4 from = turn(10 * pi / 180);
    const glm::dvec4 to = turn(350 * pi / 180);
    for (const glm::dvec4& start : {from, -from})
        for (const glm::dvec4& end : {to, -to}) {
            const KeyTrack track = rotations(Interpolation::linear, {0, 1}, {start, end});
            expect_same_rotation(rotation_at(track, 0.5), turn(0.0), 1e-12);
            expect_same_rotation(rotation_at(track, 0.25), turn(5 * pi / 180), 1e-12);
        }
}

TEST(Animation, RotationsThatAreNearlyEqualStayFinite) {
    const glm::dvec4 a = turn(1.0);
    for (const glm::dvec4& b : {a, -a, turn(1.0 + 1e-7)}) {
        const KeyTrack track = rotations(Interpolation::linear, {0, 1}, {a, b});
        for (const double t : {0.0, 0.3, 0.5, 0.9}) expect_same_rotation(rotation_at(track, t), a);
    }
}

TEST(Animation, RotationsOfUnevenLengthAreNormalised) {
    const KeyTrack track =
        rotations(Interpolation::linear, {0, 1}, {turn(0.2) * 1.05, turn(1.2) * 0.95});
    expect_same_rotation(rotation_at(track, 0.0), turn(0.2));
    expect_same_rotation(rotation_at(track, 0.5), turn(0.7), 1e-12);
}

TEST(Animation, CubicRotationsAreNormalisedSplines) {
    KeyTrack track = rotations(
        Interpolation::cubic, {0, 1},
        {{0, 0, 0, 0}, turn(0.0), {0, 0.5, 0, 0}, {0, 0.5, 0, 0}, turn(1.0), {0, 0, 0, 0}});
    // At the middle: half of both values and an eighth of the difference of the tangents, 0.
    const glm::dvec4 middle = 0.5 * (turn(0.0) + turn(1.0));
    expect_same_rotation(rotation_at(track, 0.5), middle / glm::length(middle));
    // Tangents that lead through zero give no rotation; the key before stands in.
    track =
        rotations(Interpolation::cubic, {0, 1},
                  {{0, 0, 0, 0}, turn(0.0), {0, 0, 0, 0}, {0, 0, 0, 0}, -turn(0.0), {0, 0, 0, 0}});
    expect_same_rotation(rotation_at(track, 0.5), turn(0.0));
}

TEST(Animation, PosesScaleThenTurnThenMove) {
    Pose pose;
    pose.scale = {2, 3, 4};
    pose.rotation = turn(pi / 2);
    pose.translation = {10, 20, 30};
    const glm::dmat4 matrix = matrix_of(pose);
    // +y turns +x to -z.
    expect_near(glm::dvec3(matrix * glm::dvec4(1, 0, 0, 1)), {10, 20, 28}, 1e-12);
    expect_near(glm::dvec3(matrix * glm::dvec4(0, 1, 0, 1)), {10, 23, 30}, 1e-12);
    expect_near(glm::dvec3(matrix * glm::dvec4(0, 0, 1, 1)), {14, 20, 30}, 1e-12);
}

/// A turning arm at (100, 0, 0), a resting joint at its end, 5 along its x, on which something
/// rises, and 1 further along x, at rest on that, the thing attached.
Animation arm(Attachment& attachment) {
    Animation animation;
    animation.tracks = {rotations(Interpolation::linear, {0, 1}, {turn(0.0), turn(pi / 2)}),
                        vectors(Interpolation::linear, {0, 1}, {0, 0, 0, 0, 8, 0})};
    MovingNode turning;
    turning.rest.translation = {100, 0, 0};
    turning.rotation = 0;
    MovingNode rising;
    rising.parent = 0;
    rising.to_parent[3] = glm::dvec4(5, 0, 0, 1);
    rising.rest.scale = glm::dvec3(2.0);
    rising.translation = 1;
    animation.nodes = {turning, rising};
    attachment.node = 1;
    attachment.to_node[3] = glm::dvec4(1, 0, 0, 1);
    return animation;
}

TEST(Animation, ParentsCarryTheirChildren) {
    Attachment attachment;
    const Animation animation = arm(attachment);
    const auto place = [&](double time) {
        return glm::dvec3(to_world_at(animation, attachment, time)[3]);
    };
    // 5 + 2 * 1 along the arm, whose scale counts below the joint alone.
    expect_near(place(0.0), {107, 0, 0});
    expect_near(place(0.5), {100 + 7 * std::sqrt(0.5), 4, -7 * std::sqrt(0.5)});
    expect_near(place(1.0), {100, 8, -7});
    expect_near(place(50.0), {100, 8, -7});
    const glm::dmat4 end = to_world_at(animation, attachment, 1.0);
    expect_near(glm::dvec3(end[0]), {0, 0, -2});
    expect_near(glm::dvec3(end[1]), {0, 2, 0});
    expect_near(glm::dvec3(end[2]), {2, 0, 0});
}

TEST(Animation, WhatIsFixedToTheWorldRests) {
    Attachment attachment;
    const Animation animation = arm(attachment);
    attachment.node = -1;
    EXPECT_FALSE(attachment.moves());
    EXPECT_EQ(to_world_at(animation, attachment, 0.7), attachment.to_node);
}

TEST(Animation, NumbersAreEachForThemselvesInAnyNumber) {
    const KeyTrack one{Interpolation::linear, 1, {1, 3}, {2, 4}};
    EXPECT_EQ(numbers_at(one, 0.0), std::vector<double>{2.0});
    EXPECT_EQ(numbers_at(one, 1.5), std::vector<double>{2.5});
    EXPECT_EQ(numbers_at(one, 5.0), std::vector<double>{4.0});
    const KeyTrack step{Interpolation::step, 5, {0, 1}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}};
    EXPECT_EQ(numbers_at(step, 0.9), (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(numbers_at(step, 1.0), (std::vector<double>{6, 7, 8, 9, 10}));
    // A spline of vectors is that of their numbers.
    const KeyTrack spline{Interpolation::cubic,
                          3,
                          {0, 2},
                          {9, 9, 9, 1, 2, 3, 0.5F, -1, 2, 1, 0, 3, 4, 0, 1, 9, 9, 9}};
    for (const double time : {0.0, 0.3, 1.9, 2.0}) {
        const std::vector<double> numbers = numbers_at(spline, time);
        ASSERT_EQ(numbers.size(), 3U);
        EXPECT_EQ(glm::dvec3(numbers[0], numbers[1], numbers[2]), vector_at(spline, time));
    }
}

TEST(Animation, AllNodesTogetherAreWhereEachIs) {
    Animation animation;
    animation.tracks = {vectors(Interpolation::linear, {0, 1}, {0, 0, 0, 1, 2, 3}),
                        rotations(Interpolation::linear, {0, 1}, {turn(0.0), turn(1.0)})};
    animation.nodes.resize(3);
    animation.nodes[0].translation = 0;
    animation.nodes[1].parent = 0;
    animation.nodes[1].rotation = 1;
    animation.nodes[1].to_parent[3] = {5, 6, 7, 1};
    animation.nodes[2].parent = 1;
    animation.nodes[2].translation = 0;
    const std::vector<glm::dmat4> nodes = nodes_to_world_at(animation, 0.7);
    ASSERT_EQ(nodes.size(), 3U);
    for (int node = 0; node < 3; ++node)
        EXPECT_EQ(nodes[static_cast<std::size_t>(node)],
                  to_world_at(animation, {node, glm::dmat4(1.0)}, 0.7));
}

}  // namespace
}  // namespace weft::animation_test
