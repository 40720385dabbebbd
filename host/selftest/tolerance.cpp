// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/tolerance.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "selftest/statistics.h"

namespace weft::selftest {
namespace {

/// A share as people write it: percents where they are not tiny.
std::string share_text(double share) {
    return share >= 1e-4 ? fmt::format("{:.4g} %", 100.0 * share)
                         : fmt::format("{:.4g} of it", share);
}

}  // namespace

double standard_errors(const Tolerance& tolerance) {
    static std::map<std::size_t, double> known;
    const auto [at, is_new] = known.try_emplace(tolerance.seeds, 0.0);
    if (is_new)
        at->second = tolerance.seeds == 0 ? sidak_limit(1, false_alarm)
                                          : student_limit(tolerance.seeds, 1, false_alarm);
    return at->second;
}

double allowed(const Tolerance& tolerance, double expected, double error) {
    const double chance = tolerance.largest_error > 0.0 ? standard_errors(tolerance) * error : 0.0;
    return tolerance.absolute + tolerance.relative * std::abs(expected) + chance;
}

std::string to_string(const Tolerance& tolerance) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : " + ") + part; };
    if (tolerance.largest_error > 0.0)
        add(fmt::format("{:.2f} standard errors of at most {}", standard_errors(tolerance),
                        share_text(tolerance.largest_error)));
    if (tolerance.relative > 0.0) add(share_text(tolerance.relative));
    if (tolerance.absolute > 0.0) add(fmt::format("{:.4g}", tolerance.absolute));
    return text.empty() ? "0" : text;
}

}  // namespace weft::selftest
