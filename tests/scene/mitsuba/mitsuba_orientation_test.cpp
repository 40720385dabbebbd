// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Which way cameras look and surfaces face. The expected numbers were read off Mitsuba 3.9.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/testing/mitsuba_folder.h"

namespace weft::mitsuba_orientation_test {
namespace {

/// The direction of the ray through a point of the image, (0,0) its upper left corner, as the
/// description of Camera defines it.
glm::dvec3 ray(const Scene& scene, double x, double y) {
    const Camera& camera = scene.cameras.at(0);
    const double width = scene.film->width;
    const double height = scene.film->height;
    const double extent =
        std::array{width, height, std::hypot(width, height), std::min(width, height),
                   std::max(width, height)}[static_cast<std::size_t>(camera.fov_axis)];
    const double pixel = 2.0 * std::tan(0.5 * camera.fov) / extent;
    const double right = (x - 0.5) * width * pixel * (camera.mirror_x ? -1.0 : 1.0);
    return glm::normalize(glm::dmat3(camera.to_world) *
                          glm::dvec3(right, (0.5 - y) * height * pixel, -1.0));
}

void expect_ray(const Scene& scene, double x, double y, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(ray(scene, x, y) - expected), 2e-6) << x << " " << y;
}

Scene camera_scene(const std::string& properties, int width = 400, int height = 200) {
    MitsubaFolder folder;
    return folder.read("<sensor type=\"perspective\">" + properties +
                       "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" +
                       std::to_string(width) + "\"/><integer name=\"height\" value=\"" +
                       std::to_string(height) + "\"/></film></sensor>");
}

TEST(MitsubaOrientation, LookatCameraMatchesMitsuba) {
    const Scene scene = camera_scene(
        "<float name=\"fov\" value=\"50\"/><transform name=\"to_world\">"
        "<lookat origin=\"1,2,3\" target=\"-2,1,-4\" up=\"0.1,1,0.2\"/></transform>");
    EXPECT_FALSE(scene.cameras.at(0).mirror_x);
    EXPECT_GT(glm::determinant(scene.cameras[0].to_world), 0.0);
    EXPECT_EQ(glm::dvec3(scene.cameras[0].to_world[3]), glm::dvec3(1, 2, 3));
    expect_ray(scene, 0, 0, {-0.7346443, 0.09511589, -0.67175174});
    expect_ray(scene, 1, 0, {0.025973534, 0.08393034, -0.99613297});
    expect_ray(scene, 0, 1, {-0.7186257, -0.31481436, -0.6200554});
    expect_ray(scene, 0.5, 0.5, {-0.39056674, -0.13018888, -0.9113224});
    expect_ray(scene, 0.25, 0.75, {-0.581078, -0.23476411, -0.77925235});
}

TEST(MitsubaOrientation, MirroredCameraMatchesMitsuba) {
    const Scene scene = camera_scene(
        "<float name=\"fov\" value=\"50\"/><transform name=\"to_world\">"
        "<lookat origin=\"1,2,3\" target=\"-2,1,-4\" up=\"0,1,0\"/><scale x=\"-1\"/></transform>");
    EXPECT_TRUE(scene.cameras.at(0).mirror_x);
    EXPECT_GT(glm::determinant(scene.cameras[0].to_world), 0.0);
    expect_ray(scene, 0, 0, {0.7369838, 0.08954222, -0.66995287});
    expect_ray(scene, 1, 0, {-0.02312631, 0.089542225, -0.9957144});
    expect_ray(scene, 0, 1, {0.7157785, -0.32042626, -0.6204739});
    expect_ray(scene, 0.25, 0.75, {0.5795244, -0.23782617, -0.7794807});
}

TEST(MitsubaOrientation, FovAxesMatchMitsuba) {
    struct Case {
        const char* axis;
        int width;
        int height;
        glm::dvec3 corner;
    };
    const glm::dvec3 wide_small(0.70710677, 0.35355338, 0.6123724);
    const glm::dvec3 wide_large(0.48507127, 0.24253564, 0.8401681);
    const glm::dvec3 tall_small(0.35355338, 0.70710677, 0.6123724);
    const glm::dvec3 tall_large(0.24253562, 0.48507124, 0.84016806);
    const std::vector<Case> cases = {
        {"x", 400, 200, wide_large},
        {"x", 200, 400, tall_small},
        {"y", 400, 200, wide_small},
        {"y", 200, 400, tall_large},
        {"smaller", 400, 200, wide_small},
        {"smaller", 200, 400, tall_small},
        {"larger", 400, 200, wide_large},
        {"larger", 200, 400, tall_large},
        {"diagonal", 400, 200, {0.4472136, 0.2236068, 0.8660254}},
        {"diagonal", 200, 400, {0.2236068, 0.4472136, 0.8660254}},
    };
    for (const Case& one : cases) {
        const Scene scene =
            camera_scene("<float name=\"fov\" value=\"60\"/><string name=\"fov_axis\" value=\"" +
                             std::string(one.axis) + "\"/>",
                         one.width, one.height);
        SCOPED_TRACE(one.axis);
        expect_ray(scene, 0, 0, one.corner);
    }
}

TEST(MitsubaOrientation, DefaultsOfFilmAndFieldOfViewMatchMitsuba) {
    MitsubaFolder folder;
    const Scene scene = folder.read("<sensor type=\"perspective\"/>");
    EXPECT_EQ(scene.film->width, 768U);
    EXPECT_EQ(scene.film->height, 576U);
    const glm::dvec3 left = ray(scene, 0, 0.5);
    EXPECT_NEAR(glm::degrees(2.0 * std::atan2(left.x, left.z)), 38.18484, 1e-4);
    const Scene wide = folder.read(
        "<sensor type=\"perspective\"><string name=\"focal_length\" value=\"35mm\"/></sensor>");
    const glm::dvec3 wide_left = ray(wide, 0, 0.5);
    EXPECT_NEAR(glm::degrees(2.0 * std::atan2(wide_left.x, wide_left.z)), 52.62254, 1e-4);
}

/// The world-space normal of the front of a triangle.
glm::dvec3 front(const Scene& scene, const Instance& instance, std::size_t triangle) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    std::array<glm::dvec3, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i)
        corner[i] = glm::dvec3(
            instance.to_world *
            glm::dvec4(glm::dvec3(mesh.positions.at(mesh.triangles.at(triangle)[i])), 1.0));
    const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    return instance.flip_normals ? -normal : normal;
}

/// Whether the front of a shape is at +z, or outside for closed shapes.
bool shines_forward(const std::string& shape, const std::string& transform, bool flip) {
    MitsubaFolder folder;
    const Scene scene =
        folder.read("<shape " + shape + "<transform name=\"to_world\">" + transform +
                    "</transform><boolean name=\"flip_normals\" value=\"" +
                    (flip ? "true" : "false") + "\"/><emitter type=\"area\"/></shape>");
    const Instance& instance = scene.instances.at(0);
    EXPECT_GT(glm::determinant(instance.to_world), 0.0);
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const bool closed =
        shape.find("cube") != std::string::npos || shape.find("sphere") != std::string::npos;
    std::size_t forward = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::dvec3 normal = front(scene, instance, i);
        glm::dvec3 reference(0, 0, 1);
        if (closed)
            reference =
                glm::dvec3(instance.to_world *
                           glm::dvec4(glm::dvec3(mesh.positions[mesh.triangles[i][0]]), 0.0));
        if (glm::dot(normal, reference) > 0.0) ++forward;
        if (mesh.normals.empty()) continue;
        // Shading normals, carried along by the inverse transpose, are on the same side.
        const glm::dvec3 shading = glm::transpose(glm::inverse(glm::dmat3(instance.to_world))) *
                                   glm::dvec3(mesh.normals[mesh.triangles[i][0]]);
        EXPECT_GT(glm::dot(instance.flip_normals ? -normal : normal, shading), 0.0);
    }
    EXPECT_TRUE(forward == 0 || forward == mesh.triangles.size()) << shape << transform;
    return forward > 0;
}

TEST(MitsubaOrientation, FrontSidesMatchMitsubaUnderMirroringAndFlipping) {
    const auto file = [](const std::string& name, const std::string& more) {
        return "type=\"ply\"><string name=\"filename\" value=\"" + name + "\"/>" + more;
    };
    struct Case {
        std::string shape;
        std::array<bool, 3> forward;  // as it is, mirrored in x, mirrored in z
    };
    const std::vector<Case> cases = {
        {"type=\"rectangle\">", {true, true, false}},
        {"type=\"disk\">", {true, true, false}},
        {"type=\"sphere\">", {true, false, false}},
        {"type=\"cube\">", {true, true, true}},
        {file("square.ply", ""), {true, false, true}},
        {file("square.ply", "<boolean name=\"face_normals\" value=\"true\"/>"),
         {true, false, true}},
        {file("normals.ply", ""), {true, true, false}},
        {file("normals.ply", "<boolean name=\"face_normals\" value=\"true\"/>"),
         {true, false, true}},
    };
    const std::array<std::string, 3> transforms = {"", "<scale x=\"-1\"/>", "<scale z=\"-1\"/>"};
    for (const Case& one : cases) {
        for (std::size_t i = 0; i < transforms.size(); ++i) {
            EXPECT_EQ(shines_forward(one.shape, transforms[i], false), one.forward[i])
                << one.shape << transforms[i];
            EXPECT_EQ(shines_forward(one.shape, transforms[i], true), !one.forward[i])
                << one.shape << transforms[i] << " flipped";
        }
    }
}

const std::string tent =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
    "property float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 1\n4 0 0\n0 1 0\n-1 0 0.5\n0 -2 0\n3 0 1 2\n3 0 2 3\n3 0 3 4\n";

TEST(MitsubaOrientation, SmoothNormalsMatchMitsuba) {
    MitsubaFolder folder;
    folder.folder().write("tent.ply", tent);
    const Scene scene =
        folder.read("<shape type=\"ply\"><string name=\"filename\" value=\"tent.ply\"/></shape>");
    const std::array<glm::vec3, 5> expected = {{{-0.2243507F, 0.382319F, 0.896381F},
                                                {0.1740776F, 0.6963106F, 0.6963106F},
                                                {-0.0086705F, 0.7070801F, 0.7070801F},
                                                {-0.4445456F, 0.1090702F, 0.8890911F},
                                                {-0.4082483F, -0.4082483F, 0.8164966F}}};
    ASSERT_EQ(scene.meshes.at(0).normals.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_LT(glm::length(scene.meshes[0].normals[i] - expected[i]), 1e-6F) << i;
}

TEST(MitsubaOrientation, SmoothNormalsAreThoseOfTheTransformedMesh) {
    MitsubaFolder folder;
    folder.folder().write("tent.ply", tent);
    const Scene scene = folder.read(
        "<shape type=\"ply\"><string name=\"filename\" value=\"tent.ply\"/>"
        "<transform name=\"to_world\"><scale x=\"3\" y=\"0.5\" z=\"-2\"/>"
        "<rotate y=\"1\" angle=\"30\"/></transform></shape>");
    // Read off Mitsuba for the same shape.
    const std::array<glm::vec3, 5> expected = {{{0.4250185F, -0.7606623F, 0.4906649F},
                                                {0.0861904F, -0.9693509F, 0.2300654F},
                                                {0.1323255F, -0.9700633F, 0.2036349F},
                                                {0.7478230F, -0.0318675F, 0.6631330F},
                                                {0.3488514F, 0.8846517F, 0.3093444F}}};
    const Instance& instance = scene.instances.at(0);
    const glm::dmat3 to_world_normal = glm::transpose(glm::inverse(glm::dmat3(instance.to_world)));
    for (std::size_t i = 0; i < 5; ++i) {
        const glm::vec3 normal(
            glm::normalize(to_world_normal * glm::dvec3(scene.meshes.at(0).normals.at(i))));
        EXPECT_LT(glm::length(normal - expected[i]), 2e-6F) << i;
    }
}

}  // namespace
}  // namespace weft::mitsuba_orientation_test
