// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/scaling_axes.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/common/bench_scenes.h"

namespace weft::bench {
namespace {

/// The instance of box_scene that gives light.
constexpr std::size_t area_light = 1;
/// Half the edge of the part of the ceiling that a grid of area lights is spread over.
constexpr double ceiling_half = 0.6;

/// Host memory at its highest for a triangle of a generated scene: mesh, flat scene, builder and
/// tree.
constexpr std::uint64_t triangle_bytes = 600;

std::vector<double> only_some(std::vector<double> all, bool quick) {
    if (!quick) return all;
    std::vector<double> some;
    for (std::size_t i = 0; i < all.size(); i += 2) some.push_back(all[i]);
    return some;
}

ScalingAxis triangles_axis(std::uint32_t size, bool quick) {
    ScalingAxis axis{"triangles",
                     "triangles",
                     "a room with a rugged floor of ever more triangles",
                     {LawKind::logarithmic},
                     true,
                     false,
                     {}};
    // 2 edge^2 and 14 for the room: about 1e2, 1e3, ... 1e7.
    for (const std::uint32_t edge : {7U, 22U, 71U, 224U, 707U, 2236U}) {
        if (quick && edge > 224) break;
        ScalingPoint point;
        point.x = 2.0 * edge * edge + 14.0;
        point.scene = [edge] { return terrain_scene(edge); };
        point.size = size;
        point.memory_bytes = static_cast<std::uint64_t>(point.x) * triangle_bytes;
        axis.points.push_back(point);
    }
    return axis;
}

ScalingAxis resolution_axis(std::uint32_t size) {
    ScalingAxis axis{"resolution", "pixels", "a room with a few boxes", {LawKind::line}, false,
                     false,        {}};
    for (const std::uint32_t edge : {size / 4, size / 2, size, 2 * size, 4 * size}) {
        ScalingPoint point;
        point.x = static_cast<double>(edge) * edge;
        point.scene = box_scene;
        point.size = edge;
        axis.points.push_back(point);
    }
    return axis;
}

ScalingAxis vpls_axis(std::uint32_t size, bool quick) {
    ScalingAxis axis{
        "vpls", "VPLs per set", "a room with a few boxes", {LawKind::line}, false, true, {}};
    for (const double count : only_some({8, 16, 32, 64, 128, 256, 512}, quick)) {
        ScalingPoint point;
        point.x = count;
        point.scene = box_scene;
        point.size = size;
        point.sampling.vpls_per_set = static_cast<std::uint32_t>(count);
        axis.points.push_back(point);
    }
    return axis;
}

ScalingAxis lights_axis(std::uint32_t size, bool quick) {
    const SamplingSettings standard;
    const double all_sampled =
        static_cast<double>(standard.max_samples_per_set) / standard.samples_per_light;
    ScalingAxis axis{
        "lights",
        "area lights",
        "a room with a few boxes and a ceiling of area lights of the same area together",
        {LawKind::line, all_sampled},
        false,
        true,
        {}};
    for (const double edge : only_some({1, 2, 4, 8, 16, 32, 64}, quick)) {
        ScalingPoint point;
        point.x = edge * edge;
        point.scene = [edge] { return area_lights_scene(static_cast<std::uint32_t>(edge)); };
        point.size = size;
        axis.points.push_back(point);
    }
    return axis;
}

ScalingAxis threads_axis(std::uint32_t size, std::uint32_t threads) {
    ScalingAxis axis{
        "threads", "threads", "a room with a few boxes, native kernels", {LawKind::amdahl}, false,
        false,     {}};
    std::vector<std::uint32_t> counts;
    for (std::uint32_t count = 1; count < threads; count = count < 4 ? count + 1 : count * 2)
        counts.push_back(count);
    counts.push_back(std::max(1U, threads));
    for (const std::uint32_t count : counts) {
        ScalingPoint point;
        point.x = count;
        point.scene = box_scene;
        point.size = size;
        point.threads = static_cast<int>(count);
        axis.points.push_back(point);
    }
    return axis;
}

ScalingAxis depth_axis(std::uint32_t size, bool quick) {
    ScalingAxis axis{"depth",
                     "optical depth",
                     "a room with a few boxes, full of even fog from wall to wall",
                     {LawKind::constant},
                     false,
                     true,
                     {}};
    for (const double depth : only_some({0.1, 0.3, 1.0, 3.0, 10.0}, quick)) {
        ScalingPoint point;
        point.x = depth;
        point.scene = [depth] { return fog_scene(depth); };
        point.size = size;
        axis.points.push_back(point);
    }
    return axis;
}

}  // namespace

Scene area_lights_scene(std::uint32_t edge) {
    Scene scene = box_scene();
    const Instance whole = scene.instances[area_light];
    scene.instances.erase(scene.instances.begin() + area_light);
    const double step = 2.0 * ceiling_half / edge;
    const glm::dvec3 place(whole.to_world[3]);
    for (std::uint32_t k = 0; k < edge; ++k)
        for (std::uint32_t i = 0; i < edge; ++i) {
            Instance small = whole;
            for (int column = 0; column < 3; ++column) small.to_world[column] /= edge;
            small.to_world[3] =
                glm::dvec4(edge > 1 ? (i + 0.5) * step - ceiling_half : place.x, place.y,
                           edge > 1 ? (k + 0.5) * step - ceiling_half : place.z, 1.0);
            scene.instances.push_back(small);
        }
    return scene;
}

Scene fog_scene(double depth) {
    constexpr double room = 2.0;
    Scene scene = box_scene();
    Medium fog;
    fog.name = "fog";
    fog.type = "homogeneous";
    fog.sigma_t = glm::vec3(static_cast<float>(depth / room));
    scene.media.push_back(fog);
    scene.outer_medium = 0;
    return scene;
}

std::vector<ScalingAxis> scaling_axes(std::uint32_t size, std::uint32_t threads, bool quick) {
    return {triangles_axis(size, quick), resolution_axis(size),       vpls_axis(size, quick),
            lights_axis(size, quick),    threads_axis(size, threads), depth_axis(size, quick)};
}

std::vector<std::string> scaling_axis_names() {
    std::vector<std::string> names;
    for (const ScalingAxis& axis : scaling_axes(16, 1, true)) names.push_back(axis.name);
    return names;
}

}  // namespace weft::bench
