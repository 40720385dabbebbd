// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_SELFTEST_REPORT_H
#define WEFT_SELFTEST_SELFTEST_REPORT_H

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "selftest/selftest_runner.h"

namespace weft::selftest {

/// Columns for the title of a check, `name: what`; no case has a longer one.
inline constexpr std::size_t title_columns = 74;

/// `name: what`.
[[nodiscard]] std::string title_of(const std::string& name, const std::string& what);

/// Whole numbers in full, others with seven digits.
[[nodiscard]] std::string number_text(double value);

/// The line above all results.
[[nodiscard]] std::string report_heading();

/// One line, aligned with all others: number, title, backend, expected, measured, tolerance, and
/// whether it passed. A failure with a note has a second line.
[[nodiscard]] std::string report_line(const CheckResult& result);

/// `N passed, M failed` and a line end.
[[nodiscard]] std::string report_totals(const SelftestTotals& totals);

/// The same results as JSON; values that are no numbers are null.
[[nodiscard]] nlohmann::json report_json(std::span<const CheckResult> results,
                                         const SelftestTotals& totals);

}  // namespace weft::selftest

#endif
