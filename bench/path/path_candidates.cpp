// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_candidates.h"

#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

#include "base/error.h"

namespace weft::bench {
namespace {

double mean_of(const Image& image) {
    const Layer* const beauty = image.find("");
    if (beauty == nullptr || beauty->values.empty()) return 0.0;
    return std::accumulate(beauty->values.begin(), beauty->values.end(), 0.0) /
           static_cast<double>(beauty->values.size());
}

}  // namespace

WeftPaths::WeftPaths(std::string name, Executor& executor, const FlatScene& scene,
                     const Camera& camera, const PathSettings& settings)
    : name_(std::move(name)),
      executor_(executor),
      scene_(scene),
      camera_(camera),
      settings_(settings) {}

void WeftPaths::prepare() {
    renderer_.reset();
    renderer_ = std::make_unique<PathRenderer>(executor_, scene_, camera_, settings_, FilmSums{});
}

std::optional<PathRun> WeftPaths::run() {
    const RunTimer watch;
    while (renderer_->render_frame({})) continue;
    const Image image = renderer_->image();
    PathRun run{watch.elapsed(), 0, mean_of(image)};
    for (const FrameStats& frame : renderer_->stats()) run.rays += frame.rays;
    renderer_.reset();
    return run;
}

MitsubaPaths::MitsubaPaths(const MitsubaSettings& mitsuba, std::string variant,
                           const std::filesystem::path& scene, const PathSettings& settings)
    : variant_(std::move(variant)) {
    try {
        child_ = std::make_unique<ChildProcess>(std::vector<std::string>{
            mitsuba.python, "-B", mitsuba.script.string(), variant_, scene.string(),
            std::to_string(settings.width), std::to_string(settings.samples.end),
            std::to_string(mitsuba.threads)});
    } catch (const Error& error) {
        problem_ = error.what();
        return;
    }
    const auto line = answer();
    if (line && line->starts_with("READY ")) version_ = line->substr(6);
}

std::optional<std::string> MitsubaPaths::answer() {
    auto line = child_->read_line();
    if (!line) problem_ = child_->fate();
    if (line && line->starts_with("ERROR ")) problem_ = line->substr(6);
    if (problem_.empty()) return line;
    child_.reset();
    return std::nullopt;
}

std::optional<PathRun> MitsubaPaths::run() {
    if (!child_) return std::nullopt;
    if (!child_->write_line("render")) problem_ = child_->fate();
    const auto line = answer();
    if (!line) return std::nullopt;
    double seconds = 0.0;
    double processor = 0.0;
    PathRun run;
    if (std::sscanf(line->c_str(), "%lf %lf %lf", &seconds, &processor, &run.mean) != 3 ||
        !(seconds > 0.0)) {
        problem_ = "it answers with something else than times";
        child_.reset();
        return std::nullopt;
    }
    run.timing = {1e3 * seconds, 1e3 * seconds, 1e3 * processor};
    return run;
}

}  // namespace weft::bench
