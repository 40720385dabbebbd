// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_REFERENCES_REFERENCES_REPORT_H
#define WEFT_BENCH_REFERENCES_REFERENCES_REPORT_H

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tradeoff/reference_floor.h"

namespace weft::bench {

/// One reference, and how far it has come.
struct ReferenceRow {
    std::string scene;
    std::string filter;     ///< `box` or `centre`
    std::string algorithm;  ///< what rendered it: `reference` or `path`
    std::string file{};     ///< its name in the folder of references
    std::uint64_t samples = 0;
    double seconds = 0.0;                   ///< of rendering, in all runs
    double minutes = 0.0;                   ///< that it took in this run, with everything
    std::optional<ReferenceFloor> floor{};  ///< empty before the first step
    std::optional<double> hdrflip{};        ///< of one half against the other
    std::optional<double> relmse{};         ///< likewise
    std::optional<double> noise_relmse{};   ///< what the noise of all samples adds to relMSE
    bool reached = false;                   ///< whether the floor is within the goal
    std::string failure{};                  ///< why there is no more; empty: nothing went wrong

    /// Whether it may get more time: it is not there yet, and nothing went wrong.
    [[nodiscard]] bool wants_more() const { return !reached && failure.empty(); }
};

[[nodiscard]] nlohmann::json row_json(const ReferenceRow& row);

/// Numbers of references and of those that reached the goal, the largest floors, all seconds.
[[nodiscard]] nlohmann::json references_summary(const std::vector<ReferenceRow>& rows);

/// All rows as a table, and a last line that says how many have reached the goal.
[[nodiscard]] std::string references_table(const std::vector<ReferenceRow>& rows,
                                           const ReferenceFloor& goal);

/// Minutes that a reference gets when it is its turn for the time `turn` (0: the first): twice as
/// many each time, so that those that need little are not kept waiting by those that need a lot,
/// but no more than are left of `limit`, of which it has used `used`.
[[nodiscard]] double turn_minutes(std::uint32_t turn, double used, double limit);

}  // namespace weft::bench

#endif
