// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/selftest_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace weft::selftest {
namespace {

std::string line_of(const std::string& number, const std::string& title, const std::string& backend,
                    const std::string& expected, const std::string& measured,
                    const std::string& tolerance, const std::string& outcome) {
    return fmt::format("{:>2}  {:<{}}  {:<7}  {:>14}  {:>14}  {:>9}  {}\n", number, title,
                       title_columns, backend, expected, measured, tolerance, outcome);
}

nlohmann::json number_or_null(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

}  // namespace

std::string title_of(const std::string& name, const std::string& what) {
    return name + ": " + what;
}

std::string number_text(double value) {
    const bool whole = std::abs(value) < 1e15 && value == std::trunc(value);
    return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.7g}", value);
}

std::string report_heading() {
    return line_of("", "check", "backend", "expected", "measured", "tolerance", "result");
}

std::string report_line(const CheckResult& result) {
    std::string line =
        line_of(std::to_string(result.number), title_of(result.name, result.what), result.backend,
                number_text(result.expected), number_text(result.measured),
                fmt::format("{:.3g}", result.tolerance), result.passed ? "passed" : "FAILED");
    if (!result.passed && !result.note.empty()) line += "    " + result.note + "\n";
    return line;
}

std::string report_totals(const SelftestTotals& totals) {
    return fmt::format("{} passed, {} failed\n", totals.passed, totals.failed);
}

nlohmann::json report_json(std::span<const CheckResult> results, const SelftestTotals& totals) {
    nlohmann::json checks = nlohmann::json::array();
    for (const CheckResult& result : results)
        checks.push_back({{"number", result.number},
                          {"name", result.name},
                          {"check", result.what},
                          {"backend", result.backend},
                          {"expected", number_or_null(result.expected)},
                          {"measured", number_or_null(result.measured)},
                          {"standard_error", number_or_null(result.error)},
                          {"tolerance", number_or_null(result.tolerance)},
                          {"reason", result.reason},
                          {"note", result.note},
                          {"passed", result.passed}});
    return {{"passed", totals.passed}, {"failed", totals.failed}, {"checks", checks}};
}

}  // namespace weft::selftest
