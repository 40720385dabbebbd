// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_TABLES_TABLES_REPORT_H
#define WEFT_BENCH_TABLES_TABLES_REPORT_H

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bench/adaptive/adaptive_report.h"
#include "bench/tables/moving_times.h"

namespace weft::bench {

// Further methods of the tables, beside those of adaptive_report.h.
inline constexpr const char* method_ais = "ais";
inline constexpr const char* method_ic = "ic";
inline constexpr const char* method_tic = "tic";

/// A scene of the tables, measured.
struct TableScene {
    AdaptiveScene measured;
    std::optional<MovingTimes> moving;  ///< of scenes without media
};

/// What is measured of a scene and its rows of the tables, with the column names of the published
/// ones. Figures have five significant digits.
[[nodiscard]] nlohmann::json table_scene_json(const TableScene& scene);

/// The lines that explain the columns.
[[nodiscard]] std::string tables_legend();
/// A scene's rows, with the published ones below; `published` is null where there are none.
[[nodiscard]] std::string table_scene_text(const nlohmann::json& scene,
                                           const nlohmann::json& published);

/// By set of scenes, `shipped` and `real`: the names, and by table plain means of its columns, each
/// over the rows that have a figure there; under `common` those over the cells alone that the
/// published table has as well, and under `published` theirs over the same cells.
[[nodiscard]] nlohmann::json tables_summary(const nlohmann::json& scenes,
                                            const nlohmann::json& published);
/// The means of a summary, with the published ones below.
[[nodiscard]] std::string tables_summary_text(const nlohmann::json& summary,
                                              const nlohmann::json& published);

}  // namespace weft::bench

#endif
