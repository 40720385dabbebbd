// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_RAYS_RAY_REPORT_H
#define WEFT_BENCH_RAYS_RAY_REPORT_H

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/common/candidate.h"

namespace weft::bench {

// Names of the ray sets and of Weft's own candidates, in tables and JSON.
inline constexpr const char* set_primary = "primary";
inline constexpr const char* set_closest = "closest";
inline constexpr const char* set_any = "any";
inline constexpr const char* set_packets = "packets";
inline constexpr const char* candidate_native = "native";
inline constexpr const char* candidate_opencl = "opencl";

/// All candidates on one ray set of one scene.
struct SetResult {
    std::string name;
    std::uint64_t rays = 0;
    std::vector<Figures> figures;

    /// The candidate of that name, or null.
    [[nodiscard]] const Figures* find(const std::string& candidate) const;
};

/// One scene's results.
struct SceneResult {
    std::string name;
    std::size_t triangles = 0;
    std::size_t bvh_nodes = 0;
    double bvh_ms = 0.0;
    double sah_cost = 0.0;
    std::vector<SetResult> sets;
};

/// The lines that explain the columns of the table.
[[nodiscard]] std::string table_legend();
/// A line about the scene and the column titles.
[[nodiscard]] std::string table_heading(const SceneResult& scene);
/// One line of the table.
[[nodiscard]] std::string table_row(const SetResult& set);

[[nodiscard]] nlohmann::json scene_json(const SceneResult& scene);

/// Smallest ratios over the scenes; null for what was not measured.
[[nodiscard]] nlohmann::json summary_json(const std::vector<SceneResult>& scenes);

}  // namespace weft::bench

#endif
