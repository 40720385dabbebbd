// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_KERNELS_KERNEL_FRAMES_H
#define WEFT_BENCH_KERNELS_KERNEL_FRAMES_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/candidate.h"
#include "bench/kernels/kernel_meter.h"
#include "device/executor.h"
#include "plan/frame_plan.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft::bench {

/// An executor to compare, by its name in tables and JSON.
struct MeteredBackend {
    std::string name;
    Executor& executor;
};

/// What a frame is made with.
struct MeteredMethod {
    std::string name;
    Algorithm algorithm = Algorithm::ais;
};

/// Of what size frames are and how often they are made.
struct MeteredRun {
    std::uint32_t size = 512;
    std::uint32_t repetitions = 9;
    std::uint32_t warm_up = 1;
    std::uint32_t path_samples = 4;  ///< per pixel, of an image of `path`
};

/// One frame; of `path` a whole image.
struct MeteredFrame {
    Timing timing;
    double device_ms = 0.0;  ///< of all kernels
    std::uint64_t rays = 0;
    std::uint64_t read_bytes = 0;
    std::uint64_t written_bytes = 0;
    std::vector<StageStats> stages;      ///< in order, those of equal name and component as one
    std::vector<KernelUse> kernels;      ///< as by_kernel has them
    bool rays_of_kernels_known = false;  ///< see add_rays

    /// Milliseconds of that kernel; 0 where it did not run.
    [[nodiscard]] double kernel_ms(KernelId kernel) const;
    /// Milliseconds of that stage; 0 where there is none.
    [[nodiscard]] double stage_ms(const StageStats& stage) const;
};

/// The frames of one method on one backend, repetition by repetition.
struct BackendFrames {
    std::string backend;
    std::vector<MeteredFrame> frames;
};

/// The same frames on all backends.
struct MethodOnBackends {
    std::string method;
    std::vector<BackendFrames> backends;
};

/// What a scene is traced in on a backend.
struct BackendScene {
    std::string backend;
    double build_ms = 0.0;
    std::optional<std::uint64_t> bytes;  ///< of Weft's own tree
};

/// Everything measured of one scene.
struct MeteredScene {
    std::string name;
    std::uint64_t triangles = 0;
    bool media = false;
    std::vector<BackendScene> structures;
    std::vector<MethodOnBackends> methods;
};

/// Frame 0 of every method, again and again: the backends take turns, frame by frame. The first
/// `warm_up` rounds do not count. Throws Error.
[[nodiscard]] MeteredScene meter_scene(const std::string& name, const FlatScene& scene,
                                       const Camera& camera,
                                       const std::vector<MeteredBackend>& backends,
                                       const std::vector<MeteredMethod>& methods,
                                       const MeteredRun& run);

}  // namespace weft::bench

#endif
