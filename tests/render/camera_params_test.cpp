// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/camera_params.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <set>

#include "base/error.h"
#include "tests/testing/scene_builder.h"

namespace weft::camera_params_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

glm::dvec3 vector(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

shared::RenderParams params_of(const Camera& camera, std::uint32_t width, std::uint32_t height,
                               const KernelUnits& units = {}) {
    shared::RenderParams params{};
    params.camera.width = width;
    params.camera.height = height;
    set_camera(camera, units, params);
    return params;
}

Camera camera_with(FovAxis axis, double fov) {
    Camera camera;
    camera.fov_axis = axis;
    camera.fov = fov;
    return camera;
}

/// Full angles in degrees that the image spans: {horizontal, vertical, diagonal}.
glm::dvec3 angles_of(const shared::RenderParams& params) {
    const double right = glm::length(vector(params.camera.right));
    const double up = glm::length(vector(params.camera.up));
    return glm::dvec3(std::atan(right), std::atan(up), std::atan(std::hypot(right, up))) * 2.0 /
           degree;
}

TEST(CameraParams, FieldOfViewAlongEveryAxis) {
    for (const auto& [width, height] : {std::pair{200U, 100U}, {100U, 200U}, {150U, 150U}}) {
        const bool wide = width >= height;
        const double fov = 50.0;
        const auto angles = [fov, w = width, h = height](FovAxis axis) {
            return angles_of(params_of(camera_with(axis, fov * degree), w, h));
        };
        EXPECT_NEAR(angles(FovAxis::x).x, fov, 1e-4);
        EXPECT_NEAR(angles(FovAxis::y).y, fov, 1e-4);
        EXPECT_NEAR(angles(FovAxis::diagonal).z, fov, 1e-4);
        EXPECT_NEAR(angles(FovAxis::smaller)[wide ? 1 : 0], fov, 1e-4);
        EXPECT_NEAR(angles(FovAxis::larger)[wide ? 0 : 1], fov, 1e-4);
    }
}

TEST(CameraParams, PixelsAreSquare) {
    for (const FovAxis axis :
         {FovAxis::x, FovAxis::y, FovAxis::diagonal, FovAxis::smaller, FovAxis::larger}) {
        const shared::RenderParams params = params_of(camera_with(axis, 1.1), 321, 123);
        EXPECT_NEAR(glm::length(vector(params.camera.right)) / 321.0,
                    glm::length(vector(params.camera.up)) / 123.0, 1e-7);
        EXPECT_NEAR(params.camera.pixel_angle, 2.0 * glm::length(vector(params.camera.up)) / 123.0,
                    1e-7);
    }
}

TEST(CameraParams, LooksAlongMinusZWithYUp) {
    const shared::RenderParams params = params_of(camera_with(FovAxis::y, 90.0 * degree), 100, 100);
    EXPECT_NEAR(glm::length(vector(params.camera.forward) - glm::dvec3(0, 0, -1)), 0.0, 1e-7);
    EXPECT_NEAR(glm::length(vector(params.camera.right) - glm::dvec3(1, 0, 0)), 0.0, 1e-6);
    EXPECT_NEAR(glm::length(vector(params.camera.up) - glm::dvec3(0, 1, 0)), 0.0, 1e-6);
}

TEST(CameraParams, MirrorTurnsLeftAndRight) {
    Camera camera = camera_with(FovAxis::y, 1.0);
    const shared::RenderParams plain = params_of(camera, 64, 48);
    camera.mirror_x = true;
    const shared::RenderParams mirrored = params_of(camera, 64, 48);
    EXPECT_EQ(vector(mirrored.camera.right), -vector(plain.camera.right));
    EXPECT_EQ(vector(mirrored.camera.up), vector(plain.camera.up));
    EXPECT_EQ(vector(mirrored.camera.forward), vector(plain.camera.forward));
}

TEST(CameraParams, ScaleAndShearAreIgnored) {
    Camera camera = test::look_at({3.0, 2.0, 5.0}, {0.0, 0.0, 0.0}, 0.9);
    const shared::RenderParams plain = params_of(camera, 64, 48);
    for (int axis = 0; axis < 3; ++axis) camera.to_world[axis] *= 7.0 + axis;
    camera.to_world[0] += 0.25 * camera.to_world[2];
    const shared::RenderParams scaled = params_of(camera, 64, 48);
    EXPECT_NEAR(glm::length(vector(scaled.camera.forward) - vector(plain.camera.forward)), 0, 1e-6);
    EXPECT_NEAR(glm::length(vector(scaled.camera.right) - vector(plain.camera.right)), 0, 1e-6);
    EXPECT_NEAR(glm::length(vector(scaled.camera.up) - vector(plain.camera.up)), 0, 1e-6);
}

TEST(CameraParams, OriginIsInKernelUnits) {
    const KernelUnits units{{1e7, -2e7, 0.0}, 0.25};
    Camera camera;
    camera.to_world = glm::translate(glm::dmat4(1.0), glm::dvec3(1e7 + 4.0, -2e7 - 8.0, 2.0));
    const shared::RenderParams params = params_of(camera, 10, 10, units);
    EXPECT_EQ(vector(params.camera.origin), glm::dvec3(1.0, -2.0, 0.5));
    EXPECT_EQ(params.scene.unit, 0.25F);
}

TEST(CameraParams, SingleImagesUsePixelCentres) {
    shared::RenderParams params{};
    for (const std::uint32_t seed : {0U, 7U}) {
        set_jitter(0, true, seed, params);
        EXPECT_EQ(params.camera.jitter_x, 0.5F);
        EXPECT_EQ(params.camera.jitter_y, 0.5F);
    }
}

TEST(CameraParams, FramesFillThePixelEvenly) {
    for (const std::uint32_t seed : {0U, 1U, 4294967295U}) {
        // Halton points: 36 frames put one into every cell of 1/4 x 1/9, up to the shift.
        double x = 0.0;
        double y = 0.0;
        std::set<std::pair<float, float>> distinct;
        constexpr std::uint32_t frames = 36;
        for (std::uint32_t frame = 0; frame < frames; ++frame) {
            shared::RenderParams params{};
            set_jitter(frame, false, seed, params);
            for (const float v : {params.camera.jitter_x, params.camera.jitter_y}) {
                EXPECT_GE(v, 0.0F);
                EXPECT_LT(v, 1.0F);
            }
            x += static_cast<double>(params.camera.jitter_x) / frames;
            y += static_cast<double>(params.camera.jitter_y) / frames;
            distinct.insert({params.camera.jitter_x, params.camera.jitter_y});
        }
        EXPECT_EQ(distinct.size(), frames);
        EXPECT_NEAR(x, 0.5, 0.04) << seed;
        EXPECT_NEAR(y, 0.5, 0.08) << seed;
    }
}

TEST(CameraParams, JitterDependsOnTheSeedAlone) {
    shared::RenderParams a{};
    shared::RenderParams b{};
    set_jitter(5, false, 3, a);
    set_jitter(5, false, 3, b);
    EXPECT_EQ(a.camera.jitter_x, b.camera.jitter_x);
    set_jitter(5, false, 4, b);
    EXPECT_NE(a.camera.jitter_x, b.camera.jitter_x);
    EXPECT_NE(a.camera.jitter_y, b.camera.jitter_y);
}

TEST(CameraParams, AutomaticCameraShowsTheWholeScene) {
    for (const double size : {1e-3, 1.0, 1e4})
        for (const glm::dvec3 shape : {glm::dvec3(1, 1, 1), {10, 1, 1}, {1, 20, 0.1}}) {
            test::SceneBuilder builder;
            const glm::dmat4 to_world =
                glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, -50.0, 7.0) * size) *
                glm::scale(glm::dmat4(1.0), shape * size);
            builder.add(test::room_mesh(), builder.material(glm::vec3(0.5F)), to_world);
            const FlatScene flat = flatten(builder.scene);
            Diagnostics diagnostics;
            const Camera camera = choose_camera(builder.scene, flat, "", diagnostics);
            EXPECT_EQ(diagnostics.warnings().size(), 1u);
            for (const auto& [width, height] : {std::pair{100U, 100U}, {300U, 100U}, {50U, 200U}}) {
                const shared::RenderParams params = params_of(camera, width, height, flat.units);
                const glm::dvec3 forward = vector(params.camera.forward);
                const glm::dvec3 right = vector(params.camera.right);
                const glm::dvec3 up = vector(params.camera.up);
                for (const shared::float4& p : flat.positions) {
                    const glm::dvec3 d = vector(p) - vector(params.camera.origin);
                    const double depth = glm::dot(d, forward);
                    ASSERT_GT(depth, 0.0);
                    EXPECT_LE(std::abs(glm::dot(d, right)) / glm::dot(right, right) / depth, 1.0);
                    EXPECT_LE(std::abs(glm::dot(d, up)) / glm::dot(up, up) / depth, 1.0);
                }
            }
        }
}

Scene with_cameras() {
    Scene scene;
    scene.source = "two.gltf";
    for (const char* name : {"front", "top"}) {
        Camera camera;
        camera.name = name;
        scene.cameras.push_back(camera);
    }
    return scene;
}

TEST(CameraParams, CamerasAreChosenByName) {
    const Scene scene = with_cameras();
    const FlatScene flat = flatten(scene);
    Diagnostics diagnostics;
    EXPECT_EQ(choose_camera(scene, flat, "", diagnostics).name, "front");
    EXPECT_EQ(choose_camera(scene, flat, "top", diagnostics).name, "top");
    EXPECT_TRUE(diagnostics.warnings().empty());
}

std::string refusal(const Scene& scene, const std::string& name) {
    Diagnostics diagnostics;
    try {
        (void)choose_camera(scene, flatten(scene), name, diagnostics);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        return error.what();
    }
    return "no error";
}

TEST(CameraParams, UnknownNamesListWhatThereIs) {
    EXPECT_EQ(refusal(with_cameras(), "side"),
              "--camera \"side\" is not in the scene, expected one of: \"front\", \"top\"");
    EXPECT_EQ(refusal(Scene{}, "side"),
              "--camera \"side\" is not in the scene, expected a scene with cameras");
}

}  // namespace
}  // namespace weft::camera_params_test
