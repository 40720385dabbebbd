// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/kernels/kernel_frames.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "device/shared_scene.h"
#include "render/path_renderer.h"
#include "render/renderer.h"

namespace weft::bench {
namespace {

bool same_stage(const StageStats& a, const StageStats& b) {
    return a.stage == b.stage && a.component == b.component;
}

void add_stages(const std::vector<StageStats>& stages, std::vector<StageStats>& sums) {
    for (const StageStats& stage : stages) {
        const auto same = std::find_if(sums.begin(), sums.end(), [&](const StageStats& sum) {
            return same_stage(sum, stage);
        });
        if (same == sums.end()) {
            sums.push_back(stage);
        } else {
            same->ms += stage.ms;
            same->rays += stage.rays;
        }
    }
}

/// A backend while a scene is measured: one acceleration structure for all that renders there.
class MeteredStage {
  public:
    explicit MeteredStage(const MeteredBackend& backend)
        : name_(backend.name), meter_(backend.executor), shared_(meter_) {}

    [[nodiscard]] const std::string& name() const noexcept { return name_; }

    void set_method(const FlatScene& scene, const Camera& camera, const MeteredMethod& method,
                    const MeteredRun& run) {
        renderer_.reset();
        if (method.algorithm == Algorithm::path) {
            PathSettings settings;
            settings.width = settings.height = run.size;
            settings.samples.end = run.path_samples;
            renderer_ =
                std::make_unique<PathRenderer>(shared_, scene, camera, settings, FilmSums{});
        } else {
            RenderSettings settings;
            settings.algorithm = method.algorithm;
            settings.width = settings.height = run.size;
            renderer_ = std::make_unique<Renderer>(shared_, scene, camera, settings);
        }
        whole_image_ = method.algorithm == Algorithm::path;
    }

    [[nodiscard]] MeteredFrame render(const Camera& camera) {
        renderer_->set_camera(camera);
        const std::size_t before = renderer_->stats().size();
        (void)meter_.take();
        const RunTimer watch;
        MeteredFrame frame;
        while (renderer_->render_frame({}) && whole_image_) continue;
        frame.timing = watch.elapsed();
        Metered metered = meter_.take();
        take_down(before, metered, frame);
        return frame;
    }

    /// After a renderer has been made.
    [[nodiscard]] BackendScene structure() const {
        BackendScene scene{name_, meter_.scene_ms(), std::nullopt};
        if (const BvhStats* const bvh = meter_.bvh()) scene.bytes = bvh->bytes;
        return scene;
    }

  private:
    void take_down(std::size_t first, Metered& metered, MeteredFrame& frame) const {
        FrameStats all;
        for (std::size_t i = first; i < renderer_->stats().size(); ++i) {
            const FrameStats& stats = renderer_->stats()[i];
            all.rays += stats.rays;
            all.stages.insert(all.stages.end(), stats.stages.begin(), stats.stages.end());
        }
        frame.rays_of_kernels_known = add_rays(all, metered.runs);
        frame.rays = all.rays;
        frame.read_bytes = metered.read_bytes;
        frame.written_bytes = metered.written_bytes;
        frame.kernels = by_kernel(metered.runs);
        for (const KernelUse& use : frame.kernels) frame.device_ms += use.ms;
        add_stages(all.stages, frame.stages);
    }

    std::string name_;
    KernelMeter meter_;
    SharedScene shared_;
    std::unique_ptr<FrameRenderer> renderer_;
    bool whole_image_ = false;
};

using Stages = std::vector<std::unique_ptr<MeteredStage>>;

MethodOnBackends meter_method(Stages& stages, const Camera& camera, const MeteredMethod& method,
                              const MeteredRun& run) {
    MethodOnBackends result{method.name, {}};
    for (const auto& stage : stages) result.backends.push_back({stage->name(), {}});
    for (std::uint32_t round = 0; round < run.warm_up + run.repetitions; ++round)
        for (std::size_t b = 0; b < stages.size(); ++b) {
            MeteredFrame frame = stages[b]->render(camera);
            if (round >= run.warm_up) result.backends[b].frames.push_back(std::move(frame));
        }
    return result;
}

}  // namespace

double MeteredFrame::kernel_ms(KernelId kernel) const {
    for (const KernelUse& use : kernels)
        if (use.kernel == kernel) return use.ms;
    return 0.0;
}

double MeteredFrame::stage_ms(const StageStats& stage) const {
    for (const StageStats& other : stages)
        if (same_stage(other, stage)) return other.ms;
    return 0.0;
}

MeteredScene meter_scene(const std::string& name, const FlatScene& scene, const Camera& camera,
                         const std::vector<MeteredBackend>& backends,
                         const std::vector<MeteredMethod>& methods, const MeteredRun& run) {
    MeteredScene result;
    result.name = name;
    result.triangles = scene.triangles.size();
    result.media = scene.media.present();
    Stages stages;
    for (const MeteredBackend& backend : backends)
        stages.push_back(std::make_unique<MeteredStage>(backend));
    for (const MeteredMethod& method : methods) {
        for (const auto& stage : stages) stage->set_method(scene, camera, method, run);
        if (result.structures.empty())
            for (const auto& stage : stages) result.structures.push_back(stage->structure());
        result.methods.push_back(meter_method(stages, camera, method, run));
    }
    return result;
}

}  // namespace weft::bench
