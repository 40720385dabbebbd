// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/adaptive/adaptive_frames.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "bench/common/frame_recorder.h"
#include "bench/common/own_queries.h"
#include "render/renderer.h"

namespace weft::bench {
namespace {

/// As many slots as `bench rays` takes of its largest packets.
constexpr std::size_t packet_slots = std::size_t{1} << 20;

RenderSettings settings_of(const FrameMethod& method, FrameView view, std::uint32_t size) {
    RenderSettings settings;
    settings.algorithm = method.algorithm;
    settings.sampling = method.sampling;
    settings.width = settings.height = size;
    settings.direct = view != FrameView::indirect;
    settings.indirect = view != FrameView::direct;
    settings.media = view == FrameView::full;
    return settings;
}

/// The packet rate of a scene, measured whenever it is asked for.
class PacketRate {
  public:
    PacketRate(Executor& executor, const FlatScene& scene, const Camera& camera) {
        if (!plan_for(scene, RenderSettings{}).has_indirect()) return;
        frame_ = record_frame(executor, scene, camera);
        const PacketSet packets = shadow_packets(frame_, packet_slots);
        rays_ = packets.rays;
        candidate_ = OwnQueries("packets", executor, *frame_.scene).packets(packets);
    }

    /// Runs for at least `ms` on the device: what is compared is to meet the same machine.
    void measure(double ms, std::vector<StageSum>& rates) const {
        if (!candidate_) return;
        StageSum sum;
        do {
            sum.ms += candidate_->run().ms;
            sum.rays += rays_;
        } while (sum.ms < ms);
        rates.push_back(sum);
    }

  private:
    RecordedFrame frame_;
    std::uint64_t rays_ = 0;
    std::optional<Candidate> candidate_;
};

/// One view of all methods; `between` runs once a round, and is told how long most shadow rays
/// took.
void measure_view(Executor& executor, const FlatScene& scene, const Camera& camera,
                  const std::vector<FrameMethod>& methods, FrameView view, const FrameRun& run,
                  const std::function<void(bool counts, double gather_ms)>& between,
                  AdaptiveFrames& result) {
    std::vector<std::unique_ptr<Renderer>> renderers;
    for (const FrameMethod& method : methods)
        renderers.push_back(std::make_unique<Renderer>(executor, scene, camera,
                                                       settings_of(method, view, run.size)));
    for (std::uint32_t round = 0; round < run.warm_up + run.repetitions; ++round) {
        const bool counts = round >= run.warm_up;
        double gather_ms = 0.0;
        for (std::size_t m = 0; m < methods.size(); ++m) {
            Renderer& renderer = *renderers[m];
            renderer.set_camera(camera);
            const RunTimer watch;
            renderer.render_frame({});
            const FrameTime time = frame_time(renderer.stats().back(), watch.elapsed());
            gather_ms = std::max(gather_ms, time.vpl_gather.ms + time.area_lights.ms);
            if (counts) result.methods[m].runs[static_cast<std::size_t>(view)].push_back(time);
        }
        between(counts, gather_ms);
    }
    if (view != FrameView::full) return;
    for (std::size_t m = 0; m < methods.size(); ++m)
        result.methods[m].image = renderers[m]->image();
}

}  // namespace

const char* to_string(FrameView view) {
    constexpr std::array names{"full", "indirect", "direct"};
    return names[static_cast<std::size_t>(view)];
}

FrameTime frame_time(const FrameStats& stats, const Timing& timing) {
    FrameTime time;
    time.wall_ms = timing.wall_ms;
    time.cpu_ms = timing.cpu_ms;
    time.levels = stats.levels;
    for (const StageStats& stage : stats.stages) {
        time.all.add(stage);
        const auto same = std::find_if(time.stages.begin(), time.stages.end(), [&](const auto& s) {
            return s.stage == stage.stage && s.component == stage.component;
        });
        if (same == time.stages.end()) {
            time.stages.push_back(stage);
        } else {
            same->ms += stage.ms;
            same->rays += stage.rays;
        }
        if (stage.component == "indirect") time.indirect.add(stage);
        if (stage.component == "direct") time.direct.add(stage);
        if (stage.component == "media") time.media.add(stage);
        if (stage.stage == Stage::vpl_gather) time.vpl_gather.add(stage);
        if (stage.stage == Stage::area_lights) time.area_lights.add(stage);
    }
    return time;
}

double FrameTime::stage_ms(const std::string& component, Stage wanted) const {
    for (const StageStats& stage : stages)
        if (stage.component == component && stage.stage == wanted) return stage.ms;
    return 0.0;
}

std::uint64_t FrameTime::sampled(std::string_view component) const {
    for (const LevelStats& level : levels)
        if (level.component == component) return level.samples;
    return 0;
}

double MethodFrames::median_of(FrameView view,
                               const std::function<double(const FrameTime&)>& figure) const {
    std::vector<double> values;
    for (const FrameTime& time : of(view)) values.push_back(figure(time));
    return median(std::move(values));
}

const MethodFrames* AdaptiveFrames::find(std::string_view name) const {
    for (const MethodFrames& method : methods)
        if (method.name == name) return &method;
    return nullptr;
}

AdaptiveFrames measure_frames(Executor& executor, const FlatScene& scene, const Camera& camera,
                              const std::vector<FrameMethod>& methods, const FrameRun& run) {
    AdaptiveFrames result;
    for (const FrameMethod& method : methods) result.methods.push_back({method.name, {}, {}});
    std::optional<PacketRate> packets;
    if (run.packets) packets.emplace(executor, scene, camera);
    std::vector<StageSum> ignored;
    for (const FrameView view : frame_views) {
        if (view != FrameView::full && !run.alone) continue;
        measure_view(
            executor, scene, camera, methods, view, run,
            [&](bool counts, double gather_ms) {
                if (view != FrameView::full || !packets) return;
                packets->measure(gather_ms, counts ? result.packets : ignored);
            },
            result);
    }
    return result;
}

double frame_ratio(const MethodFrames& a, const MethodFrames& b, FrameView view,
                   const std::function<double(const FrameTime&)>& figure) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(a.of(view).size(), b.of(view).size()); ++i) {
        const double ours = figure(a.of(view)[i]);
        const double theirs = figure(b.of(view)[i]);
        if (ours > 0.0 && theirs > 0.0) ratios.push_back(theirs / ours);
    }
    return median(std::move(ratios));
}

}  // namespace weft::bench
