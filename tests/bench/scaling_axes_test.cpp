// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/scaling_axes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "bench/scaling/scaling_report.h"
#include "device/native/native_executor.h"
#include "scene/flat_scene.h"
#include "tests/testing/temporary_folder.h"

namespace weft::bench::scaling_axes_test {
namespace {

const ScalingAxis& axis_of(const std::vector<ScalingAxis>& axes, const std::string& name) {
    return *std::find_if(axes.begin(), axes.end(),
                         [&](const ScalingAxis& axis) { return axis.name == name; });
}

/// Area of all squares [-1,1]^2 that give light.
double area_light_area(const Scene& scene) {
    double area = 0.0;
    for (const Instance& instance : scene.instances) {
        if (scene.materials[instance.material].emission.radiance == glm::vec3(0.0F)) continue;
        const glm::dvec3 across(instance.to_world[0]);
        const glm::dvec3 along(instance.to_world[1]);
        area += 4.0 * glm::length(glm::cross(across, along));
    }
    return area;
}

TEST(ScalingAxes, ScenesAreWhatTheAxisSays) {
    const std::vector<ScalingAxis> axes = scaling_axes(64, 6, false);
    for (const ScalingPoint& point : axis_of(axes, "triangles").points) {
        if (point.x >= 2e4) break;
        EXPECT_EQ(static_cast<double>(flatten(point.scene()).triangles.size()), point.x);
    }
    EXPECT_GT(axis_of(axes, "triangles").points.back().x, 9.9e6);

    const ScalingAxis& lights = axis_of(axes, "lights");
    const double area = area_light_area(lights.points.front().scene());
    EXPECT_NEAR(area, 0.36, 1e-12);
    for (const ScalingPoint& point : lights.points) {
        if (point.x > 300.0) break;
        const Scene scene = point.scene();
        EXPECT_EQ(static_cast<double>(flatten(scene).area_lights), point.x);
        EXPECT_NEAR(area_light_area(scene), area, 1e-9 * area) << point.x;
    }
    for (const ScalingPoint& point : axis_of(axes, "depth").points) {
        const Scene scene = point.scene();
        ASSERT_EQ(scene.outer_medium, 0);
        // The room is two units wide.
        EXPECT_NEAR(2.0 * static_cast<double>(scene.media[0].sigma_t.y), point.x, 1e-6 * point.x);
    }
    std::vector<double> threads;
    for (const ScalingPoint& point : axis_of(axes, "threads").points) threads.push_back(point.x);
    EXPECT_EQ(threads, (std::vector<double>{1.0, 2.0, 3.0, 4.0, 6.0}));
    for (const ScalingPoint& point : axis_of(axes, "resolution").points)
        EXPECT_EQ(static_cast<double>(point.size) * point.size, point.x);
    for (const ScalingPoint& point : axis_of(axes, "vpls").points)
        EXPECT_EQ(static_cast<double>(point.sampling.vpls_per_set), point.x);
}

TEST(ScalingAxes, PointsTakeTurnsAndAreCompared) {
    const TemporaryFolder folder;
    ScalingAxis axis = axis_of(scaling_axes(16, 1, true), "vpls");
    axis.builds = true;
    ASSERT_GE(axis.points.size(), 3U);
    axis.points.resize(3);
    axis.points[2].memory_bytes = 1000;
    std::vector<std::string> said;
    ScalingRun run;
    run.methods = {{"igi", Algorithm::igi, {}}, {"ir", Algorithm::ir, {}}};
    run.repetitions = 2;
    run.references = folder.path();
    run.reference_spp = 2;
    run.memory_bytes = 999;
    run.say = [&](const std::string& text) { said.push_back(text); };
    const auto executor = make_native_executor(NativeTraversal::own_bvh, 0);
    const AxisFrames frames = measure_axis(axis, run, *executor, *executor);

    ASSERT_EQ(frames.points.size(), 2U);
    ASSERT_EQ(frames.left_out.size(), 1U);
    EXPECT_FALSE(said.empty());
    for (const PointFrames& point : frames.points) {
        EXPECT_EQ(point.build_ms.size(), 3U);
        ASSERT_EQ(point.methods.size(), 2U);
        for (const MethodAtPoint& method : point.methods) {
            EXPECT_EQ(method.wall_ms.size(), 2U);
            EXPECT_EQ(method.device_ms.size(), 2U);
            ASSERT_TRUE(method.errors.relmse.has_value());
            EXPECT_GT(*method.errors.relmse, 0.0);
            EXPECT_TRUE(method.errors.hdrflip.has_value());
        }
        // Every pixel of `ir` gathers what nine of `igi` share.
        EXPECT_GT(point.methods[1].rays, 4 * point.methods[0].rays);
    }
    EXPECT_GT(frames.points[1].methods[0].rays, frames.points[0].methods[0].rays);

    const nlohmann::json json = axis_json(axis, run.methods, frames);
    EXPECT_EQ(json["methods"][0]["points"].size(), 2U);
    EXPECT_TRUE(json["methods"][0]["relmse_exponent"].is_number());
    EXPECT_TRUE(json["build"]["law"].is_object());
    EXPECT_NE(axis_table(json).find("left out: "), std::string::npos);
    EXPECT_TRUE(scaling_summary(nlohmann::json::array({json}))["vpls"]["igi"]["slope"].is_number());
}

TEST(ScalingAxes, FreeMemoryIsKnownOnLinux) {
    // More than this program takes, and less than any machine has.
    EXPECT_GT(available_memory(), std::uint64_t{1} << 20);
    EXPECT_LT(available_memory(), std::uint64_t{1} << 50);
}

}  // namespace
}  // namespace weft::bench::scaling_axes_test
