// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/render_path.h"

#include <algorithm>

#include "app/interrupt.h"
#include "frame/film_sums_file.h"
#include "image/exr.h"

namespace weft {
namespace {

constexpr double checkpoint_ms = 60e3;

/// What of `wanted` the sums do not hold yet. Only a start that is there can be left out.
SampleRange missing(SampleRange wanted, const std::vector<SampleRange>& have) {
    for (const SampleRange& range : have)
        if (range.first <= wanted.first && wanted.first < range.end)
            wanted.first = std::min(range.end, wanted.end);
    return wanted;
}

/// Whether the picture's error is small enough. Looked at after 16, 32, 64 ... samples: reading it
/// costs as much as some samples do, and looking often would end by luck.
class ErrorTarget {
  public:
    explicit ErrorTarget(const RenderOptions& options) : target_(options.target_error) {}

    bool reached(PathRenderer& renderer) {
        if (!target_ || renderer.samples() < next_look_) return false;
        next_look_ = 2 * renderer.samples();
        return relative_error(renderer.sums()) <= *target_;
    }

  private:
    std::optional<double> target_;
    std::uint64_t next_look_ = 16;
};

}  // namespace

std::unique_ptr<PathRenderer> make_path_renderer(Executor& executor, const FlatScene& scene,
                                                 const Camera& camera, const RenderOptions& options,
                                                 const PathSettings& settings) {
    FilmSums sums;
    PathSettings left = settings;
    if (options.resume && std::filesystem::exists(*options.resume)) {
        sums = sums_of(read_exr(*options.resume), options.resume->string());
        left.samples = missing(settings.samples, sums.ranges);
    }
    return std::make_unique<PathRenderer>(executor, scene, camera, left, std::move(sums));
}

bool render_path(PathRenderer& renderer, const RenderOptions& options, Progress& progress,
                 const Stopwatch& watch) {
    const double budget_ms = options.time_seconds ? *options.time_seconds * 1000.0 : 0.0;
    const std::uint32_t all = renderer.samples_left();
    ErrorTarget target(options);
    double saved = watch.total();
    const auto share_done = [&] {
        if (options.time_seconds) return std::min(1.0, watch.total() / budget_ms);
        return all > 0 ? static_cast<double>(all - renderer.samples_left()) / all : 1.0;
    };
    const KeepGoing keep_going = [&](Stage stage, double) {
        progress.update(share_done(), stage_name(stage));
        return !interrupt_flag();
    };
    while (renderer.samples_left() > 0 && !interrupt_flag()) {
        const bool late = options.time_seconds && renderer.samples() > 0 &&
                          watch.total() + renderer.next_frame_ms() > budget_ms;
        if (late || target.reached(renderer)) break;
        if (!renderer.render_frame(keep_going)) break;
        if (options.resume && watch.total() - saved > checkpoint_ms) {
            const FilmSums sums = renderer.sums();
            write_checkpoint(sums, resolve_sums(sums), options);
            saved = watch.total();
        }
    }
    return !interrupt_flag();
}

void write_checkpoint(const FilmSums& sums, Image image, const RenderOptions& options) {
    if (!options.resume) return;
    attach_sums(sums, image);
    write_exr(*options.resume, image);
}

}  // namespace weft
