// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_REPORT_H
#define WEFT_BENCH_PATH_PATH_REPORT_H

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/common/candidate.h"
#include "bench/path/path_candidates.h"

namespace weft::bench {

// Names of the candidates, in tables and JSON.
inline constexpr const char* paths_opencl = "opencl";
inline constexpr const char* paths_native = "native";
inline constexpr const char* paths_embree = "embree";
inline constexpr const char* paths_scalar = "scalar_rgb";
inline constexpr const char* paths_llvm = "llvm_ad_rgb";

/// What was measured of one path tracer in one scene.
struct PathFigures {
    Figures figures;      ///< Mitsuba's variants are yardsticks; Figures::mrays is 0 for them
    double msamples = 0;  ///< million samples per second, from the median time
    double mean = 0;      ///< of the image's values, over the runs
    std::string problem;  ///< why there are no runs; else empty
};

/// One scene's results.
struct PathResult {
    std::string name;
    std::size_t triangles = 0;
    std::vector<PathFigures> candidates;

    /// The candidate of that name where it ran, or null.
    [[nodiscard]] const PathFigures* find(const std::string& wanted) const;
    /// The smallest ratio of a candidate to any of Mitsuba's variants, or null.
    [[nodiscard]] nlohmann::json ratio(const std::string& wanted,
                                       double Timing::*value = &Timing::ms) const;
};

/// Runs all candidates once untimed, then `repetitions` times in turn. `samples` counts those of a
/// whole image. Whoever drops out stays in the list with its problem.
[[nodiscard]] std::vector<PathFigures> measure_paths(
    const std::vector<std::unique_ptr<PathCandidate>>& candidates, std::uint64_t samples,
    std::uint32_t repetitions);

/// The lines that explain the columns of the table, and the column titles.
[[nodiscard]] std::string path_heading();
/// One line of the table.
[[nodiscard]] std::string path_row(const PathResult& result);

[[nodiscard]] nlohmann::json path_json(const PathResult& result);

/// Smallest ratios and means over the scenes; null for what was not measured.
[[nodiscard]] nlohmann::json path_summary(const std::vector<PathResult>& results);

}  // namespace weft::bench

#endif
