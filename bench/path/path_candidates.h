// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_CANDIDATES_H
#define WEFT_BENCH_PATH_PATH_CANDIDATES_H

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/candidate.h"
#include "bench/common/child_process.h"
#include "bench/path/mitsuba_choice.h"
#include "bench/path/path_algorithms.h"
#include "device/executor.h"
#include "render/path_renderer.h"

namespace weft::bench {

/// What renders: an algorithm of Weft and the backend that it runs on, or Mitsuba and a variant.
struct CandidateName {
    std::string algorithm;
    std::string backend;

    [[nodiscard]] std::string name() const { return algorithm + " " + backend; }
    [[nodiscard]] bool operator==(const CandidateName&) const = default;
};

/// The algorithm that candidates by Mitsuba have.
inline constexpr const char* mitsuba_algorithm = "mitsuba";

/// One image of a path tracer.
struct PathRun {
    Timing timing;
    std::uint64_t rays = 0;     ///< 0 where that is not known
    std::vector<float> values;  ///< all of red, then of green and blue, the top row first
};

/// A path tracer with a scene loaded.
class PathCandidate {
  public:
    virtual ~PathCandidate() = default;

    [[nodiscard]] virtual const CandidateName& candidate_name() const = 0;
    /// Makes everything ready for the next run, whose image is independent of those of other seeds;
    /// not timed.
    virtual void prepare(std::uint32_t seed) = 0;
    /// Renders the image once, from the first path to values in memory. Nothing where the
    /// candidate is not available, from then on.
    [[nodiscard]] virtual std::optional<PathRun> run() = 0;
    /// Why it is not available; empty where it is.
    [[nodiscard]] virtual std::string problem() const { return {}; }
};

/// An algorithm of Weft on one executor. What it is given must outlive it.
class WeftPaths : public PathCandidate {
  public:
    WeftPaths(const PathAlgorithm& algorithm, std::string backend, Executor& executor,
              const FlatScene& scene, const Camera& camera, const PathSettings& settings);

    [[nodiscard]] const CandidateName& candidate_name() const override { return candidate_name_; }
    void prepare(std::uint32_t seed) override;
    [[nodiscard]] std::optional<PathRun> run() override;

  private:
    CandidateName candidate_name_;
    const PathAlgorithm& algorithm_;
    Executor& executor_;
    const FlatScene& scene_;
    const Camera& camera_;
    PathSettings settings_;
    std::unique_ptr<FrameRenderer> renderer_;
};

/// A variant of Mitsuba 3 in a process of its own, since some end it where the machine lacks
/// something.
class MitsubaPaths : public PathCandidate {
  public:
    /// Loads the scene file; where that fails, `problem` says why. Images are handed over in
    /// `folder`; `threads` 0: all.
    MitsubaPaths(const MitsubaChoice& mitsuba, const std::filesystem::path& scene,
                 const PathSettings& settings, const std::filesystem::path& folder, int threads);

    [[nodiscard]] const CandidateName& candidate_name() const override { return candidate_name_; }
    void prepare(std::uint32_t seed) override { seed_ = seed; }
    [[nodiscard]] std::optional<PathRun> run() override;
    [[nodiscard]] std::string problem() const override { return problem_; }

  private:
    /// The child's next line, or nothing and a problem.
    std::optional<std::string> answer();
    /// What a run that has been answered says and shows.
    std::optional<PathRun> read_run(const std::string& line);

    CandidateName candidate_name_;
    std::filesystem::path image_;
    std::size_t value_count_;
    std::uint32_t seed_ = 0;
    std::unique_ptr<ChildProcess> child_;
    std::string problem_;
};

}  // namespace weft::bench

#endif
