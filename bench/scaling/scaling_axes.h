// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_SCALING_SCALING_AXES_H
#define WEFT_BENCH_SCALING_SCALING_AXES_H

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/scaling/scaling_laws.h"
#include "plan/frame_plan.h"
#include "scene/scene.h"

namespace weft::bench {

/// One setting of what an axis varies; all else is the standard setting.
struct ScalingPoint {
    double x = 0.0;
    std::function<Scene()> scene;
    std::uint32_t size = 256;  ///< width and height
    SamplingSettings sampling{};
    int threads = 0;                 ///< above 0: on native kernels with so many
    std::uint64_t memory_bytes = 0;  ///< that making it takes at most, as far as known
};

/// What is varied, and what is expected of it.
struct ScalingAxis {
    std::string name;     ///< as --only has it
    std::string unit;     ///< of x
    std::string setting;  ///< what is the same at all points
    Law law;              ///< of the time of a frame
    bool builds = false;  ///< the acceleration structure is timed as well
    bool errors = false;  ///< images are compared with references
    std::vector<ScalingPoint> points;
};

/// All axes. `size` is that of images where it is not varied; `threads` the most to use.
[[nodiscard]] std::vector<ScalingAxis> scaling_axes(std::uint32_t size, std::uint32_t threads,
                                                    bool quick);

/// The names of all axes.
[[nodiscard]] std::vector<std::string> scaling_axis_names();

/// A lit room with a few boxes, and in place of its area light a grid of `edge`^2 smaller ones that
/// take up the same area.
[[nodiscard]] Scene area_lights_scene(std::uint32_t edge);

/// A lit room with a few boxes, full of even fog. `depth`: optical depth along 2 scene units, from
/// wall to wall.
[[nodiscard]] Scene fog_scene(double depth);

}  // namespace weft::bench

#endif
