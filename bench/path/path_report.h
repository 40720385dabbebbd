// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_REPORT_H
#define WEFT_BENCH_PATH_PATH_REPORT_H

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/common/contender.h"
#include "bench/path/path_contenders.h"

namespace weft::bench {

// Names of the contenders, in tables and JSON.
inline constexpr const char* paths_opencl = "opencl";
inline constexpr const char* paths_native = "native";
inline constexpr const char* paths_embree = "embree";
inline constexpr const char* paths_scalar = "scalar_rgb";
inline constexpr const char* paths_llvm = "llvm_ad_rgb";

/// What was measured of one path tracer in one scene.
struct PathFigures {
    Figures figures;      ///< Mitsuba's variants are yardsticks; Figures::mrays is 0 for them
    double msamples = 0;  ///< million samples per second, from the median time
    double mean = 0;      ///< of the picture's values, over the runs
    std::string problem;  ///< why there are no runs; else empty
};

/// One scene's results.
struct PathResult {
    std::string name;
    std::size_t triangles = 0;
    std::vector<PathFigures> contenders;

    /// The contender of that name where it ran, or null.
    [[nodiscard]] const PathFigures* find(const std::string& contender) const;
    /// The smallest ratio of a contender to any of Mitsuba's variants, or null.
    [[nodiscard]] nlohmann::json ratio(const std::string& contender,
                                       double Timing::*value = &Timing::ms) const;
};

/// Runs all contenders once untimed, then `repetitions` times in turn. `samples` counts those of a
/// whole picture. Whoever drops out stays in the list with its problem.
[[nodiscard]] std::vector<PathFigures> measure_paths(
    const std::vector<std::unique_ptr<PathContender>>& contenders, std::uint64_t samples,
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
