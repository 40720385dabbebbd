// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_DYNAMIC_REPORT_H
#define WEFT_BENCH_DYNAMIC_DYNAMIC_REPORT_H

#include <nlohmann/json.hpp>
#include <string>

#include "bench/dynamic/dynamic_frames.h"
#include "bench/dynamic/dynamic_methods.h"
#include "bench/dynamic/sequence_errors.h"

namespace weft::bench {

/// Milliseconds and rays of stages by their names; stages without rays are left out of the latter.
[[nodiscard]] nlohmann::json stage_sums(const std::vector<StageStats>& stages, bool rays);

/// All that is known of one frame.
[[nodiscard]] nlohmann::json frame_json(const DynamicFrame& frame, const FrameErrors& errors);
/// All frames of a method, with the means that tables show. The first frame counts for errors only:
/// in it, whatever outlasts frames is made.
[[nodiscard]] nlohmann::json method_json(const DynamicMethod& method, const nlohmann::json& frames);

[[nodiscard]] std::string sequence_heading();
/// A sequence as a table: a line for every method, then the rays of each by class.
[[nodiscard]] std::string sequence_table(const nlohmann::json& sequence);
/// Means over sequences; null for what has no value.
[[nodiscard]] nlohmann::json sequence_summary(const nlohmann::json& sequences);

[[nodiscard]] std::string validation_table(const nlohmann::json& sequence);
/// Sums over sequences.
[[nodiscard]] nlohmann::json validation_summary(const nlohmann::json& sequences);

/// The row of the method of that name in a list of methods, or null.
[[nodiscard]] const nlohmann::json* find_method(const nlohmann::json& methods,
                                                const std::string& name);
/// `json` at a path such as "/errors/relmse" as a number; empty where it is none.
[[nodiscard]] std::optional<double> number_at(const nlohmann::json& json, const char* path);
/// Mean over a list of rows with methods of the figure of one method over that of another; null
/// where no row has both. `happening` empty: all rows.
[[nodiscard]] nlohmann::json mean_ratio(const nlohmann::json& rows, const std::string& above,
                                        const std::string& below, const char* path,
                                        const std::string& event = "");

}  // namespace weft::bench

#endif
