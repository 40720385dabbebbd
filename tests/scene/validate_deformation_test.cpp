// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/validate_deformation.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "base/error.h"
#include "scene/validate_scene.h"

namespace weft::validate_deformation_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Parts of a scene in which a triangle is carried by two joints and moved by a target.
struct Parts {
    Scene scene;
    MeshShape shape;

    Parts() {
        scene.source = "a.gltf";
        scene.materials.emplace_back();
        Mesh mesh;
        mesh.name = "g";
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        mesh.triangles = {{0, 1, 2}};
        scene.meshes.push_back(mesh);
        scene.instances.emplace_back();
        scene.instances[0].name = "i";
        scene.instances[0].may_move = true;
        scene.instances[0].deformation = 0;
        scene.skins.emplace_back();
        scene.skins[0].joints.resize(2);
        scene.skins[0].inverse_bind.assign(2, glm::dmat4(1.0));
        scene.deformations.emplace_back();
        scene.deformations[0].skin = 0;
        scene.deformations[0].weights = {0.5};
        shape.positions = mesh.positions;
        shape.targets.resize(1);
        shape.targets[0].positions.resize(3);
        shape.influences = {2, {0, 1, 0, 1, 0, 1}, {1.0F, 0.0F, 0.5F, 0.5F, 0.25F, 0.75F}};
    }
    [[nodiscard]] Deformation& deformation() { return scene.deformations[0]; }
};

std::string error_after(const std::function<void(Parts&)>& change) {
    Parts parts;
    change(parts);
    parts.deformation().shape = std::make_shared<const MeshShape>(parts.shape);
    try {
        validate_scene(parts.scene);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(ValidateDeformation, AcceptsWhatIsWhole) {
    EXPECT_EQ(error_after([](Parts&) {}), "no error");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.targets[0].positions.clear(); }), "no error");
    EXPECT_EQ(error_after([](Parts& p) {
                  p.scene.animation.tracks.push_back({Interpolation::linear, 1, {0}, {1}});
                  p.deformation().weights_track = 0;
                  p.deformation().weights.clear();
              }),
              "no error");
}

TEST(ValidateDeformation, ChecksReferences) {
    EXPECT_EQ(error_after([](Parts& p) { p.scene.instances[0].deformation = 1; }),
              "a.gltf: instance 'i' refers to a deformation that does not exist");
    EXPECT_EQ(error_after([](Parts& p) {
                  p.scene.meshes.push_back(p.scene.meshes[0]);
                  p.scene.instances[0].mesh = 1;
              }),
              "a.gltf: instance 'i' has a deformation of another mesh");
    EXPECT_EQ(error_after([](Parts& p) { p.deformation().mesh = 1; }),
              "a.gltf: deformation lacks its mesh");
    const std::string object = "a.gltf: deformation of mesh 'g' ";
    EXPECT_EQ(error_after([](Parts& p) { p.deformation().skin = 1; }),
              object + "refers to a skin that does not exist");
    EXPECT_EQ(error_after([](Parts& p) { p.deformation().skin = -1; }), object + "lacks a skin");
    EXPECT_EQ(error_after([](Parts& p) { p.deformation().weights_track = 0; }),
              object + "refers to a track that does not exist");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.influences.joints[3] = 2; }),
              object + "refers to a joint that does not exist");
    EXPECT_EQ(error_after([](Parts& p) { p.scene.skins[0].joints[1].node = 0; }),
              "a.gltf: skin moves with a node that does not exist");
}

TEST(ValidateDeformation, ChecksNumbersOfThings) {
    const std::string object = "a.gltf: deformation of mesh 'g' ";
    EXPECT_EQ(error_after([](Parts& p) { p.shape.positions.pop_back(); }),
              object + "has the wrong number of vertices");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.normals.resize(3); }),
              object + "has the wrong number of vertices");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.targets[0].positions.pop_back(); }),
              object + "has a target with the wrong number of vertices");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.targets[0].normals.resize(3); }),
              object + "has a target with the wrong number of vertices");
    EXPECT_EQ(error_after([](Parts& p) { p.deformation().weights.push_back(1.0); }),
              object + "has the wrong number of weights");
    EXPECT_EQ(error_after([](Parts& p) {
                  p.scene.animation.tracks.push_back({Interpolation::linear, 2, {0}, {1, 1}});
                  p.deformation().weights_track = 0;
              }),
              object + "has the wrong number of weights");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.influences.weights.pop_back(); }),
              object + "has the wrong number of joint weights");
    EXPECT_EQ(error_after([](Parts& p) { p.scene.skins[0].inverse_bind.pop_back(); }),
              "a.gltf: skin has the wrong number of matrices");
}

TEST(ValidateDeformation, ChecksNumbers) {
    const std::string object = "a.gltf: deformation of mesh 'g' ";
    EXPECT_EQ(error_after([](Parts& p) { p.shape.positions[1].x = nan; }),
              object + "has a vertex that is not finite");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.targets[0].positions[2].z = nan; }),
              object + "has a target that is not finite");
    EXPECT_EQ(error_after([](Parts& p) { p.deformation().weights[0] = double{nan}; }),
              object + "has a weight that is not finite");
    for (const float weight : {nan, -0.5F})
        EXPECT_EQ(error_after([&](Parts& p) { p.shape.influences.weights[2] = weight; }),
                  object + "has a joint weight that is negative or no number");
    EXPECT_EQ(error_after([](Parts& p) { p.shape.influences.weights[2] = 0.6F; }),
              object + "has joint weights without a sum of 1");
    EXPECT_EQ(error_after([](Parts& p) { p.scene.skins[0].inverse_bind[0][0][0] = double{nan}; }),
              "a.gltf: skin has a matrix that is not finite");
    EXPECT_EQ(error_after([](Parts& p) { p.scene.skins[0].frame.to_node[3][0] = double{nan}; }),
              "a.gltf: skin has a transform that is not finite");
}

TEST(ValidateDeformation, ChecksPosesOfVertices) {
    Parts parts;
    parts.deformation().shape = std::make_shared<const MeshShape>(parts.shape);
    EXPECT_NO_THROW(validate_pose(parts.scene, "then"));
    parts.scene.meshes[0].positions[2].y = nan;
    try {
        validate_pose(parts.scene, "then");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "a.gltf: instance 'i' then has a vertex that is not finite");
    }
}

}  // namespace
}  // namespace weft::validate_deformation_test
