// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_REPORT_H
#define WEFT_BENCH_PATH_PATH_REPORT_H

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/path/path_figures.h"

namespace weft::bench {

/// One scene's results.
struct PathResult {
    std::string name;
    bool media = false;
    std::size_t triangles = 0;
    std::vector<PathFigures> candidates;
};

/// The lines that explain the columns of the table, and the column titles.
[[nodiscard]] std::string path_heading();
/// The lines of a scene. A |z| above the limit is marked.
[[nodiscard]] std::string path_rows(const PathResult& result, double z_limit);
/// A line for each candidate: its geometric means over the scenes. Empty where Mitsuba has not run.
[[nodiscard]] std::string path_means(const std::vector<PathResult>& results);

[[nodiscard]] nlohmann::json path_json(const PathResult& result);

/// Geometric means over the scenes by candidate, the smallest ratios of times, and whether all mean
/// images agree; null for what was not measured.
[[nodiscard]] nlohmann::json path_summary(const std::vector<PathResult>& results, double z_limit);

}  // namespace weft::bench

#endif
