// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/scaling_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>

#include "bench/common/bench_main.h"
#include "device/native/native_executor.h"
#include "device/shared_scene.h"
#include "pipeline/frame_context.h"
#include "render/camera_params.h"
#include "render/renderer.h"
#include "scene/flat_scene.h"
#include "tradeoff/reference_images.h"

namespace weft::bench {
namespace {

/// Builds are timed this often, but once where they take long.
constexpr std::uint32_t builds = 3;
constexpr std::uint64_t long_build = 2'000'000;  ///< triangles

/// A point with all that renders there.
class PointStage {
  public:
    PointStage(const ScalingPoint& point, Executor& executor)
        : point_(point),
          own_(point.threads > 0 ? make_native_executor(NativeTraversal::own_bvh, point.threads)
                                 : nullptr),
          executor_(own_ ? *own_ : executor),
          shared_(executor_) {
        const Scene scene = point.scene();
        flat_ = flatten(scene);
        Diagnostics diagnostics;
        camera_ = choose_camera(scene, flat_, "", diagnostics);
    }
    PointStage(const PointStage&) = delete;  // its renderers refer to it
    PointStage& operator=(const PointStage&) = delete;

    [[nodiscard]] const FlatScene& flat() const noexcept { return flat_; }
    [[nodiscard]] const Camera& camera() const noexcept { return camera_; }

    /// Milliseconds of the acceleration structure, made and thrown away.
    [[nodiscard]] double build() {
        (void)upload_scene(executor_, flat_);
        return executor_.scene_ms();
    }

    void make_renderers(const std::vector<FrameMethod>& methods) {
        for (const FrameMethod& method : methods) {
            RenderSettings settings;
            settings.algorithm = method.algorithm;
            settings.sampling = point_.sampling;
            settings.width = settings.height = point_.size;
            renderers_.push_back(std::make_unique<Renderer>(shared_, flat_, camera_, settings));
        }
    }

    void render(std::size_t method, bool counts, MethodAtPoint& result) {
        const auto limit = limit_threads(point_.threads);
        Renderer& renderer = *renderers_[method];
        renderer.set_camera(camera_);
        const RunTimer watch;
        renderer.render_frame({});
        const double wall_ms = watch.elapsed().wall_ms;
        if (!counts) return;
        double device_ms = 0.0;
        for (const StageStats& stage : renderer.stats().back().stages) device_ms += stage.ms;
        result.wall_ms.push_back(wall_ms);
        result.device_ms.push_back(device_ms);
        result.rays = renderer.stats().back().rays;
    }

    [[nodiscard]] Image image(std::size_t method) { return renderers_[method]->image(); }

  private:
    ScalingPoint point_;
    std::unique_ptr<Executor> own_;
    Executor& executor_;
    SharedScene shared_;
    FlatScene flat_;
    Camera camera_;
    std::vector<std::unique_ptr<Renderer>> renderers_;
};

using Stages = std::vector<std::unique_ptr<PointStage>>;

void time_builds(Stages& stages, AxisFrames& result) {
    for (std::uint32_t round = 0; round < builds; ++round)
        for (std::size_t p = 0; p < stages.size(); ++p)
            if (round == 0 || stages[p]->flat().triangles.size() < long_build)
                result.points[p].build_ms.push_back(stages[p]->build());
}

void time_frames(const ScalingRun& run, Stages& stages, AxisFrames& result) {
    for (std::uint32_t round = 0; round < run.warm_up + run.repetitions; ++round)
        for (std::size_t p = 0; p < stages.size(); ++p)
            for (std::size_t m = 0; m < run.methods.size(); ++m)
                stages[p]->render(m, round >= run.warm_up, result.points[p].methods[m]);
}

void compare(const ScalingAxis& axis, const ScalingRun& run, Stages& stages,
             Executor& path_executor, AxisFrames& result) {
    for (std::size_t p = 0; p < stages.size(); ++p) {
        SharedScene shared(path_executor);
        ReferenceImages references(run.references, shared, run.say);
        ReferenceWish wish{"scaling-" + axis.name, axis.points[p].size, true, run.reference_spp};
        wish.with_halves = true;
        const ErrorChoice choice{.visible = false, .hdrflip = true};
        const Reference reference = references.find(stages[p]->flat(), stages[p]->camera(), wish);
        result.points[p].reference = reference.json();
        if (const auto floor = floor_errors(reference.image, choice))
            result.points[p].reference["floor"] = floor->json();
        for (std::size_t m = 0; m < run.methods.size(); ++m)
            result.points[p].methods[m].errors =
                image_errors(reference.image, stages[p]->image(m), "", choice);
    }
}

/// The number that a file begins with, or after a line's key; 0 where there is none.
std::uint64_t number_in(const char* file, const std::string& key) {
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) {
        if (!line.starts_with(key)) continue;
        std::istringstream words(line.substr(key.size()));
        std::uint64_t number = 0;
        return words >> number ? number : 0;
    }
    return 0;
}

/// What the machine has room for; what is not is named. Points without need of memory stay.
ScalingAxis affordable(const ScalingAxis& axis, const ScalingRun& run, AxisFrames& result) {
    ScalingAxis kept = axis;
    kept.points.clear();
    std::uint64_t taken = 0;  // all points live at once
    for (const ScalingPoint& point : axis.points) {
        if (run.memory_bytes == 0 || taken + point.memory_bytes <= run.memory_bytes) {
            taken += point.memory_bytes;
            kept.points.push_back(point);
            continue;
        }
        result.left_out.push_back(
            fmt::format("{:.3g} {}: needs about {:.1f} GB of host memory, {:.1f} GB are free",
                        point.x, axis.unit, static_cast<double>(point.memory_bytes) * 1e-9,
                        static_cast<double>(run.memory_bytes - taken) * 1e-9));
        run.say(result.left_out.back());
    }
    return kept;
}

}  // namespace

AxisFrames measure_axis(const ScalingAxis& axis, const ScalingRun& run, Executor& executor,
                        Executor& path_executor) {
    AxisFrames result;
    const ScalingAxis kept = affordable(axis, run, result);
    Stages stages;
    for (const ScalingPoint& point : kept.points) {
        stages.push_back(std::make_unique<PointStage>(point, executor));
        result.points.push_back({point.x,
                                 stages.back()->flat().triangles.size(),
                                 {},
                                 std::vector<MethodAtPoint>(run.methods.size())});
    }
    if (axis.builds) time_builds(stages, result);
    for (const auto& stage : stages) stage->make_renderers(run.methods);
    time_frames(run, stages, result);
    if (axis.errors && run.reference_spp > 0) compare(kept, run, stages, path_executor, result);
    return result;
}

std::uint64_t available_memory() {
    std::uint64_t free = number_in("/proc/meminfo", "MemAvailable:") * 1024;
    const std::uint64_t limit = number_in("/sys/fs/cgroup/memory.max", "");
    const std::uint64_t used = number_in("/sys/fs/cgroup/memory.current", "");
    if (limit > 0) free = std::min(free, limit > used ? limit - used : 1);
    return free;
}

}  // namespace weft::bench
