// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "scene/scene.h"

namespace weft::deformation_test {
namespace {

// Results are floats of about 1.
constexpr double tolerance = 1e-6;

/// A turn about +z, then a move.
glm::dmat4 placed(double angle, const glm::dvec3& move) {
    glm::dmat4 matrix(1.0);
    matrix[0] = {std::cos(angle), std::sin(angle), 0.0, 0.0};
    matrix[1] = {-std::sin(angle), std::cos(angle), 0.0, 0.0};
    matrix[3] = glm::dvec4(move, 1.0);
    return matrix;
}

/// Vertices in the unit cube with unit normals.
MeshShape cloud(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    const auto vector = [&] {
        const float x = uniform(random);
        const float y = uniform(random);
        return glm::vec3(x, y, uniform(random));
    };
    MeshShape shape;
    for (std::size_t i = 0; i < count; ++i) {
        shape.positions.push_back(vector());
        shape.normals.push_back(glm::normalize(vector() + glm::vec3(0.0F, 0.0F, 1.5F)));
    }
    return shape;
}

/// Lets joints 0, 1... carry every vertex with these weights.
void attach(MeshShape& shape, const std::vector<float>& weights) {
    shape.influences.width = static_cast<std::uint32_t>(weights.size());
    for (std::size_t v = 0; v < shape.positions.size(); ++v)
        for (std::size_t i = 0; i < weights.size(); ++i) {
            shape.influences.joints.push_back(static_cast<std::uint16_t>(i));
            shape.influences.weights.push_back(weights[i]);
        }
}

struct Deformed {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    bool mirrored = false;
};

Deformed deformed(const MeshShape& shape, const std::vector<double>& weights,
                  const std::vector<glm::dmat4>& joints) {
    Deformed made;
    Mesh mesh;
    made.mirrored = deform(shape, weights, joints, mesh);
    made.positions = mesh.positions;
    made.normals = mesh.normals;
    made.tangents = mesh.tangents;
    EXPECT_EQ(made.positions.size(), shape.positions.size());
    EXPECT_EQ(made.normals.size(), shape.normals.size());
    return made;
}

void expect_near(const glm::vec3& a, const glm::dvec3& b) {
    EXPECT_LE(glm::length(glm::dvec3(a) - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Deformation, ARigidJointIsARigidTransform) {
    MeshShape shape = cloud(3000);
    attach(shape, {1.0F});
    const glm::dmat4 joint = placed(0.7, {0.3, -0.2, 0.9});
    const Deformed made = deformed(shape, {}, {joint});
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        expect_near(made.positions[i],
                    glm::dvec3(joint * glm::dvec4(glm::dvec3(shape.positions[i]), 1.0)));
        expect_near(made.normals[i], glm::dmat3(joint) * glm::dvec3(shape.normals[i]));
    }
    EXPECT_FALSE(made.mirrored);
}

TEST(Deformation, TwoJointsAtHalfWeightsBendByHalfAndShrink) {
    // The mean of the identity and of a turn by a is a turn by a / 2, scaled by cos(a / 2) across
    // the axis; normals are scaled by its inverse there.
    MeshShape shape = cloud(100);
    attach(shape, {0.5F, 0.5F});
    const double angle = 1.2;
    const double shrunk = std::cos(0.5 * angle);
    const Deformed made = deformed(shape, {}, {glm::dmat4(1.0), placed(angle, {0, 0, 0})});
    const glm::dmat3 half(placed(0.5 * angle, {0, 0, 0}));
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        const glm::dvec3 p(shape.positions[i]);
        const glm::dvec3 n(shape.normals[i]);
        expect_near(made.positions[i], half * glm::dvec3(shrunk * p.x, shrunk * p.y, p.z));
        expect_near(made.normals[i],
                    glm::normalize(half * glm::dvec3(n.x / shrunk, n.y / shrunk, n.z)));
    }
}

TEST(Deformation, MorphTargetsAddWhatTheirWeightsSay) {
    MeshShape shape = cloud(50);
    const MeshShape other = cloud(150);
    shape.targets.resize(2);
    shape.targets[0].positions.assign(other.positions.end() - 50, other.positions.end());
    shape.targets[0].normals.assign(other.normals.end() - 50, other.normals.end());
    // The other only moves vertices.
    shape.targets[1].positions.assign(50, glm::vec3(0.0F, 2.0F, 0.0F));
    for (const std::vector<double>& weights :
         {std::vector<double>{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.0}, {-0.25, 1.5}}) {
        const Deformed made = deformed(shape, weights, {});
        for (std::size_t i = 0; i < shape.positions.size(); ++i) {
            expect_near(made.positions[i],
                        glm::dvec3(shape.positions[i]) +
                            weights[0] * glm::dvec3(shape.targets[0].positions[i]) +
                            glm::dvec3(0.0, 2.0 * weights[1], 0.0));
            expect_near(made.normals[i],
                        glm::normalize(glm::dvec3(shape.normals[i]) +
                                       weights[0] * glm::dvec3(shape.targets[0].normals[i])));
        }
    }
    EXPECT_EQ(deformed(shape, {0.0, 0.0}, {}).positions, shape.positions);
}

TEST(Deformation, JointsCarryWhatTargetsMake) {
    MeshShape shape;
    shape.positions = {{1, 0, 0}};
    shape.targets.resize(1);
    shape.targets[0].positions = {{1, 0, 0}};
    attach(shape, {1.0F});
    const Deformed made = deformed(shape, {0.5}, {placed(0.5 * std::numbers::pi, {0, 0, 4})});
    expect_near(made.positions[0], {0.0, 1.5, 4.0});
}

TEST(Deformation, NormalsStayAtRightAnglesToWhatIsScaledUnevenly) {
    MeshShape shape = cloud(40);
    attach(shape, {1.0F});
    glm::dmat4 scaling = placed(0.4, {1, 2, 3});
    scaling[0] *= 3.0;
    scaling[2] *= 0.2;
    const Deformed made = deformed(shape, {}, {scaling});
    for (std::size_t i = 0; i < shape.normals.size(); ++i) {
        const glm::dvec3 n(shape.normals[i]);
        EXPECT_NEAR(static_cast<double>(glm::length(made.normals[i])), 1.0, tolerance);
        for (const glm::dvec3& helper : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
            const glm::dvec3 along = glm::dmat3(scaling) * glm::cross(n, helper);
            EXPECT_NEAR(glm::dot(glm::dvec3(made.normals[i]), along), 0.0, 3.0 * tolerance);
        }
    }
}

TEST(Deformation, NormalsOfWhatIsFlattenedAreThatOfThePlane) {
    MeshShape shape = cloud(40);
    attach(shape, {1.0F});
    glm::dmat4 flat(1.0);
    flat[2] = glm::dvec4(0.0);
    const Deformed made = deformed(shape, {}, {flat});
    // All normals of the cloud look towards +z.
    for (const glm::vec3& normal : made.normals) expect_near(normal, {0.0, 0.0, 1.0});
    // What becomes a line or a point has none.
    flat[1] = glm::dvec4(0.0);
    for (const glm::vec3& normal : deformed(shape, {}, {flat}).normals)
        EXPECT_EQ(normal, glm::vec3(0.0F));
}

TEST(Deformation, WeightsThatAreRoundedDoNotMoveAnything) {
    // A sum of 0.99999 of a move by a million would be ten short.
    MeshShape shape;
    shape.positions = {{0.25F, 0.5F, 0.75F}};
    attach(shape, {0.33333F, 0.33333F, 0.33333F});
    const glm::dmat4 away = placed(0.0, {1048576.0, 0.0, 0.0});
    expect_near(deformed(shape, {}, {away, away, away}).positions[0], {1048576.25, 0.5, 0.75});
}

TEST(Deformation, JointsWithoutWeightMayBeAnything) {
    MeshShape shape = cloud(10);
    attach(shape, {1.0F, 0.0F});
    const glm::dmat4 nowhere(std::numeric_limits<double>::quiet_NaN());
    const Deformed made = deformed(shape, {}, {glm::dmat4(1.0), nowhere});
    EXPECT_EQ(made.positions, shape.positions);
}

TEST(Deformation, SaysThatJointsMirror) {
    MeshShape shape = cloud(10);
    attach(shape, {1.0F});
    glm::dmat4 mirror(1.0);
    mirror[0][0] = -1.0;
    const Deformed made = deformed(shape, {}, {mirror});
    EXPECT_TRUE(made.mirrored);
    // As those of a triangle whose corners keep their order: they point inwards then.
    for (std::size_t i = 0; i < shape.normals.size(); ++i) {
        const glm::dvec3 n(shape.normals[i]);
        expect_near(made.normals[i], {n.x, -n.y, -n.z});
    }
}

TEST(Deformation, JointMatricesLeadFromTheShapeToTheFrame) {
    Skin skin;
    skin.frame = {0, placed(0.0, {1, 0, 0})};
    skin.joints = {{1, placed(0.0, {0, 3, 0})}, {-1, placed(0.0, {5, 5, 5})}};
    skin.inverse_bind = {placed(0.0, {0, 0, 2}), glm::dmat4(1.0)};
    const std::vector<glm::dmat4> nodes = {placed(0.0, {10, 0, 0}), placed(0.0, {20, 0, 0})};
    const std::vector<glm::dmat4> matrices = joint_matrices(skin, nodes);
    ASSERT_EQ(matrices.size(), 2U);
    EXPECT_EQ(matrices[0], placed(0.0, {9, 3, 2}));
    EXPECT_EQ(matrices[1], placed(0.0, {-6, 5, 5}));
}

}  // namespace
}  // namespace weft::deformation_test
