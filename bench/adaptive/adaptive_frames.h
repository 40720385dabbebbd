// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_ADAPTIVE_ADAPTIVE_FRAMES_H
#define WEFT_BENCH_ADAPTIVE_ADAPTIVE_FRAMES_H

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/common/candidate.h"
#include "device/executor.h"
#include "image/image.h"
#include "pipeline/frame_renderer.h"
#include "plan/frame_plan.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft::bench {

/// A way of making frames.
struct FrameMethod {
    std::string name;  ///< for tables, files and JSON
    Algorithm algorithm = Algorithm::ais;
    SamplingSettings sampling;
};

/// What light a frame is asked for.
enum class FrameView : std::uint8_t { full, indirect, direct };
inline constexpr std::array frame_views{FrameView::full, FrameView::indirect, FrameView::direct};
[[nodiscard]] const char* to_string(FrameView view);

/// Time and rays of some stages of a frame.
struct StageSum {
    double ms = 0.0;  ///< on the device
    std::uint64_t rays = 0;

    void add(const StageStats& stage) {
        ms += stage.ms;
        rays += stage.rays;
    }
    /// Million rays per second; 0 where nothing was traced.
    [[nodiscard]] double mrays() const {
        return rays > 0 && ms > 0.0 ? static_cast<double>(rays) * 1e-3 / ms : 0.0;
    }
};

/// One frame.
struct FrameTime {
    double wall_ms = 0.0;  ///< of render_frame as its caller sees it
    double cpu_ms = 0.0;   ///< processor time of the process meanwhile
    StageSum all;          ///< all stages
    StageSum indirect;     ///< the stages labelled with that component
    StageSum direct;
    StageSum media;
    StageSum vpl_gather;             ///< of `indirect`, the shadow rays to VPLs
    StageSum area_lights;            ///< of `direct`, the shadow rays to area lights
    std::vector<StageStats> stages;  ///< in order, those of equal name and component as one
    std::vector<LevelStats> levels;  ///< of adaptive components

    /// Milliseconds of that stage; 0 where there is none.
    [[nodiscard]] double stage_ms(const std::string& component, Stage stage) const;
    /// Pixels that the component sampled; 0 where it is not adaptive.
    [[nodiscard]] std::uint64_t sampled(std::string_view component) const;
};
/// `timing` is what its caller saw.
[[nodiscard]] FrameTime frame_time(const FrameStats& stats, const Timing& timing);

/// All frames of one method, repetition by repetition.
struct MethodFrames {
    std::string name;
    std::array<std::vector<FrameTime>, frame_views.size()> runs;  ///< by FrameView
    Image image;  ///< the full frame, which every repetition makes anew

    [[nodiscard]] const std::vector<FrameTime>& of(FrameView view) const {
        return runs[static_cast<std::size_t>(view)];
    }
    /// Median of a figure over the repetitions.
    [[nodiscard]] double median_of(FrameView view,
                                   const std::function<double(const FrameTime&)>& figure) const;
};

/// How frames are made and how often.
struct FrameRun {
    std::uint32_t size = 512;
    std::uint32_t repetitions = 9;
    std::uint32_t warm_up = 1;
    bool packets = true;  ///< measure the packet rate as well
    bool alone = true;    ///< make frames with one light alone as well
};

/// Everything measured of one scene's frames.
struct AdaptiveFrames {
    std::vector<MethodFrames> methods;
    std::vector<StageSum> packets;  ///< of each repetition; empty where there is no indirect light

    /// The method of that name, or null.
    [[nodiscard]] const MethodFrames* find(std::string_view name) const;
};

/// Frame 0 of every method, again and again, one view after the other: all renderers of a view
/// live at once on `executor` and take turns, frame by frame; among the full frames the packets
/// that `bench rays` measures take theirs, for as long as the longest gathering of shadow rays,
/// where they are wanted. The first `warm_up` rounds do not count.
[[nodiscard]] AdaptiveFrames measure_frames(Executor& executor, const FlatScene& scene,
                                            const Camera& camera,
                                            const std::vector<FrameMethod>& methods,
                                            const FrameRun& run);

/// How many times as fast `a` is as `b`: median over the repetitions of the ratios within each.
/// 0 where there is nothing to compare.
[[nodiscard]] double frame_ratio(const MethodFrames& a, const MethodFrames& b, FrameView view,
                                 const std::function<double(const FrameTime&)>& figure);

}  // namespace weft::bench

#endif
