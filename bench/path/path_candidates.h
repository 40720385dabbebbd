// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_CANDIDATES_H
#define WEFT_BENCH_PATH_PATH_CANDIDATES_H

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "bench/common/candidate.h"
#include "bench/common/child_process.h"
#include "device/executor.h"
#include "render/path_renderer.h"

namespace weft::bench {

/// One image of a path tracer.
struct PathRun {
    Timing timing;
    std::uint64_t rays = 0;  ///< 0 where that is not known
    double mean = 0.0;       ///< of all values of the image
};

/// A path tracer with a scene loaded.
class PathCandidate {
  public:
    virtual ~PathCandidate() = default;

    [[nodiscard]] virtual std::string name() const = 0;
    /// Makes everything ready for the next run; not timed.
    virtual void prepare() {}
    /// Renders the image once, from the first path to values in memory. Nothing where the
    /// candidate is not available, from then on.
    [[nodiscard]] virtual std::optional<PathRun> run() = 0;
    /// Why it is not available; empty where it is.
    [[nodiscard]] virtual std::string problem() const { return {}; }
};

/// Weft's `path` on one executor. What it is given must outlive it.
class WeftPaths : public PathCandidate {
  public:
    WeftPaths(std::string name, Executor& executor, const FlatScene& scene, const Camera& camera,
              const PathSettings& settings);

    [[nodiscard]] std::string name() const override { return name_; }
    void prepare() override;
    [[nodiscard]] std::optional<PathRun> run() override;

  private:
    std::string name_;
    Executor& executor_;
    const FlatScene& scene_;
    const Camera& camera_;
    PathSettings settings_;
    std::unique_ptr<PathRenderer> renderer_;
};

/// How to start Mitsuba.
struct MitsubaSettings {
    std::string python;            ///< interpreter
    std::filesystem::path script;  ///< mitsuba_speed.py
    int threads = 0;               ///< 0: all
};

/// A variant of Mitsuba 3 in a process of its own, since some end it where the machine lacks
/// something.
class MitsubaPaths : public PathCandidate {
  public:
    /// Loads the scene file; where that fails, `problem` says why.
    MitsubaPaths(const MitsubaSettings& mitsuba, std::string variant,
                 const std::filesystem::path& scene, const PathSettings& settings);

    [[nodiscard]] std::string name() const override { return variant_; }
    [[nodiscard]] std::optional<PathRun> run() override;
    [[nodiscard]] std::string problem() const override { return problem_; }
    /// Of Mitsuba; empty where it is not available.
    [[nodiscard]] const std::string& version() const noexcept { return version_; }

  private:
    /// The child's next line, or nothing and a problem.
    std::optional<std::string> answer();

    std::string variant_;
    std::unique_ptr<ChildProcess> child_;
    std::string problem_;
    std::string version_;
};

}  // namespace weft::bench

#endif
