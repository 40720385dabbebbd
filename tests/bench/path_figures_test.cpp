// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "bench/path/mitsuba_choice.h"
#include "bench/path/path_report.h"
#include "bench/path/path_scenes.h"

namespace weft::bench::path_figures_test {
namespace {

constexpr PathImage image{32, 32, 4};

/// A path tracer that takes a known time for noise of a known width about `mean`.
class MadeUp : public PathCandidate {
  public:
    MadeUp(CandidateName candidate_name, double ms, double deviation, double mean = 1.0)
        : candidate_name_(std::move(candidate_name)), ms_(ms), deviation_(deviation), mean_(mean) {}

    [[nodiscard]] const CandidateName& candidate_name() const override { return candidate_name_; }
    void prepare(std::uint32_t seed) override {
        generator_.seed(seed + (candidate_name_.algorithm == mitsuba_algorithm ? 1000U : 0U));
    }
    [[nodiscard]] std::optional<PathRun> run() override {
        if (fails_after_-- == 0) problem_ = "it ended by signal 6";
        if (!problem_.empty()) return std::nullopt;
        PathRun run{{ms_, ms_, 2.0 * ms_}, 1000, {}};
        std::normal_distribution<double> normal(mean_, deviation_);
        for (std::size_t i = 0; i < std::size_t{3} * image.width * image.height; ++i)
            run.values.push_back(static_cast<float>(normal(generator_)));
        return run;
    }
    [[nodiscard]] std::string problem() const override { return problem_; }

    int fails_after_ = -1;

  private:
    CandidateName candidate_name_;
    double ms_;
    double deviation_;
    double mean_;
    std::mt19937 generator_;
    std::string problem_;
};

const CandidateName theirs{mitsuba_algorithm, "llvm_ad_rgb"};
const CandidateName ours{"path", "opencl"};

/// Weft, three times as fast with twice the variance, and Mitsuba.
std::vector<std::unique_ptr<PathCandidate>> pair(double mean = 1.0) {
    std::vector<std::unique_ptr<PathCandidate>> candidates;
    candidates.push_back(std::make_unique<MadeUp>(theirs, 30.0, 0.1));
    candidates.push_back(std::make_unique<MadeUp>(ours, 10.0, 0.1 * std::sqrt(2.0), mean));
    return candidates;
}

TEST(PathFigures, EfficiencyIsVarianceTimesTime) {
    const auto figures = measure_paths(pair(), image, 5);
    ASSERT_EQ(figures.size(), 2U);
    EXPECT_FALSE(figures[0].against);
    ASSERT_TRUE(figures[1].against);
    const AgainstMitsuba& against = *figures[1].against;
    EXPECT_DOUBLE_EQ(against.time.value, 3.0);
    EXPECT_NEAR(against.variance.value, 0.5, 0.03);
    EXPECT_DOUBLE_EQ(against.efficiency.value, against.variance.value * against.time.value);
    EXPECT_NEAR(figures[0].variance.value, 0.01 / 1.01, 0.0005);
    EXPECT_EQ(figures[1].runs.size(), 5U);
    EXPECT_DOUBLE_EQ(figures[1].msamples, 32 * 32 * 4 * 1e-3 / 10.0);
    EXPECT_LT(against.means.worst_z, z_limit(block_count(32, 32)));
}

TEST(PathFigures, AnotherMeanIsSeen) {
    const auto figures = measure_paths(pair(1.05), image, 5);
    ASSERT_TRUE(figures[1].against);
    EXPECT_GT(figures[1].against->means.worst_z, z_limit(block_count(32, 32)));
    EXPECT_NEAR(figures[1].against->means.difference, 0.05, 0.01);
    const PathResult result{"scene", false, 12, figures};
    const double limit = z_limit(block_count(32, 32));
    EXPECT_NE(path_rows(result, limit).find("!"), std::string::npos);
    EXPECT_FALSE(path_summary({result}, limit)["means_agree"].get<bool>());
}

TEST(PathFigures, WhoeverDropsOutKeepsItsProblem) {
    auto candidates = pair();
    dynamic_cast<MadeUp&>(*candidates[0]).fails_after_ = 2;
    const auto figures = measure_paths(candidates, image, 4);
    EXPECT_EQ(figures[0].problem, "it ended by signal 6");
    EXPECT_FALSE(figures[0].ran());
    EXPECT_TRUE(figures[1].ran());
    EXPECT_FALSE(figures[1].against);
    EXPECT_TRUE(path_summary({{"scene", false, 12, figures}}, 4.0)["path_vs_mitsuba"].is_null());
}

TEST(PathFigures, SummariesAreGeometricMeans) {
    const auto figures = measure_paths(pair(), image, 3);
    auto faster = figures;
    faster[1].against->time.value = 12.0;
    faster[1].against->efficiency.value *= 4.0;
    const nlohmann::json summary =
        path_summary({{"a", false, 1, figures}, {"b-fog", true, 1, faster}}, 4.0);
    const double efficiency = figures[1].against->efficiency.value;
    EXPECT_NEAR(summary["path_efficiency_vs_mitsuba"].get<double>(), 2.0 * efficiency, 1e-9);
    EXPECT_NEAR(summary["means"][0]["time_ratio"].get<double>(), 6.0, 1e-9);
    EXPECT_NEAR(summary["means"][0]["efficiency_with_media"].get<double>(), 4.0 * efficiency, 1e-9);
    EXPECT_NEAR(summary["means"][0]["efficiency_min"].get<double>(), efficiency, 1e-9);
    EXPECT_DOUBLE_EQ(summary["path_vs_mitsuba"].get<double>(), 3.0);
    EXPECT_DOUBLE_EQ(summary["path_vs_mitsuba_mean"].get<double>(), 7.5);
}

TEST(PathFigures, ChoicesOfMitsubaAreRead) {
    const PythonPrograms programs{"python3", "bench"};
    const MitsubaChoice found = read_choice(
        programs,
        R"({"variant": "llvm_ad_rgb", "library": "/lib/new.so", "version": "3.9", "llvm": "19.1",
            "failed": [{"variant": "llvm_ad_rgb", "library": "/lib/newer.so", "problem": "no"}]})");
    EXPECT_TRUE(found.available());
    EXPECT_EQ(found.text(), "Mitsuba 3.9, llvm_ad_rgb with LLVM 19.1 (/lib/new.so)");
    ASSERT_EQ(found.failed.size(), 1U);
    EXPECT_EQ(found.failed[0], "llvm_ad_rgb, /lib/newer.so: no");
    const MitsubaChoice none = read_choice(programs, R"({"problem": "no module", "failed": []})");
    EXPECT_FALSE(none.available());
    EXPECT_EQ(none.text(), "No variant of Mitsuba works: no module");
    EXPECT_FALSE(read_choice(programs, "Traceback").available());
    EXPECT_EQ(choose_mitsuba({"/no/such/python", "bench"}, "").problem,
              "/no/such/python: No such file or directory");
}

TEST(PathFigures, WithoutFilesAndPythonGeneratedScenesAreLeft) {
    const PythonPrograms programs{"/no/such/python", "bench"};
    std::string problem;
    const auto scenes = path_scenes("/no/such/folder", {}, programs, "/no/such/scratch", problem);
    ASSERT_EQ(scenes.size(), 2U);
    EXPECT_EQ(scenes.front().scene.name, "box");
    EXPECT_FALSE(scenes.front().media);
    EXPECT_EQ(problem, "/no/such/python: No such file or directory");
    problem.clear();
    EXPECT_EQ(path_scenes("/no/such/folder", {"box"}, programs, "/", problem).size(), 1U);
    EXPECT_TRUE(problem.empty());
}

TEST(PathFigures, AlgorithmsAreKnownByName) {
    EXPECT_EQ(path_algorithm("path").name, "path");
    EXPECT_THROW(static_cast<void>(path_algorithm("ais")), Error);
}

}  // namespace
}  // namespace weft::bench::path_figures_test
