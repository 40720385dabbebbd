// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_candidates.h"

#include <cstdio>
#include <fstream>
#include <utility>

#include "base/error.h"

namespace weft::bench {

WeftPaths::WeftPaths(const PathAlgorithm& algorithm, std::string backend, Executor& executor,
                     const FlatScene& scene, const Camera& camera, const PathSettings& settings)
    : candidate_name_{std::string(algorithm.name), std::move(backend)},
      algorithm_(algorithm),
      executor_(executor),
      scene_(scene),
      camera_(camera),
      settings_(settings) {}

void WeftPaths::prepare(std::uint32_t seed) {
    renderer_.reset();
    settings_.seed = seed;
    renderer_ = algorithm_.make(executor_, scene_, camera_, settings_);
}

std::optional<PathRun> WeftPaths::run() {
    const RunTimer watch;
    while (renderer_->render_frame({})) continue;
    Image image = renderer_->image();
    PathRun run{watch.elapsed(), 0, {}};
    for (const FrameStats& frame : renderer_->stats()) run.rays += frame.rays;
    for (Layer& layer : image.layers)
        if (layer.name.empty()) run.values = std::move(layer.values);
    renderer_.reset();
    return run;
}

MitsubaPaths::MitsubaPaths(const MitsubaChoice& mitsuba, const std::filesystem::path& scene,
                           const PathSettings& settings, const std::filesystem::path& folder,
                           int threads)
    : candidate_name_{mitsuba_algorithm, mitsuba.variant},
      image_(folder / "mitsuba.raw"),
      value_count_(std::size_t{3} * settings.width * settings.height) {
    try {
        child_ = std::make_unique<ChildProcess>(std::vector<std::string>{
            mitsuba.programs.python, "-B",
            mitsuba.programs.folder / "cross_validation" / "mitsuba_speed.py", mitsuba.variant,
            mitsuba.library, scene.string(), std::to_string(settings.width),
            std::to_string(settings.samples.end), std::to_string(threads), image_.string()});
    } catch (const Error& error) {
        problem_ = error.what();
        return;
    }
    answer();
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
    if (!child_->write_line(std::to_string(seed_))) problem_ = child_->fate();
    const auto line = answer();
    return line ? read_run(*line) : std::nullopt;
}

std::optional<PathRun> MitsubaPaths::read_run(const std::string& line) {
    double seconds = 0.0;
    double processor = 0.0;
    PathRun run;
    if (std::sscanf(line.c_str(), "%lf %lf", &seconds, &processor) != 2 || !(seconds > 0.0)) {
        problem_ = "it answers with something else than times";
        child_.reset();
        return std::nullopt;
    }
    run.timing = {1e3 * seconds, 1e3 * seconds, 1e3 * processor};
    run.values.resize(value_count_);
    std::ifstream file(image_, std::ios::binary);
    const auto bytes = static_cast<std::streamsize>(value_count_ * sizeof(float));
    if (!file.read(reinterpret_cast<char*>(run.values.data()), bytes) || file.get() != EOF) {
        problem_ = "its image is of another size";
        child_.reset();
        return std::nullopt;
    }
    return run;
}

}  // namespace weft::bench
