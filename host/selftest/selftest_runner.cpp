// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/selftest_runner.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace weft::selftest {
namespace {

/// The values of a case, or, where it throws, as many NaN with the error as their note.
std::vector<Measured> measure(const SelftestCase& tested, Executor& executor) {
    std::string trouble;
    try {
        std::vector<Measured> values = tested.measure(executor);
        if (values.size() == tested.checks.size()) return values;
        trouble = fmt::format("the case measured {} values, expected {}", values.size(),
                              tested.checks.size());
    } catch (const std::exception& error) {
        trouble = error.what();
    }
    Measured none(std::numeric_limits<double>::quiet_NaN());
    none.note = trouble;
    return std::vector<Measured>(tested.checks.size(), none);
}

/// Compiles kernels that will be used. Those that do not compile fail in their cases.
void compile_quietly(Executor& executor,
                     const std::map<std::pair<KernelId, std::uint32_t>, KernelUse>& used) {
    std::vector<KernelUse> uses;
    for (const auto& [key, use] : used) uses.push_back(use);
    try {
        executor.compile(uses);
    } catch (const std::exception&) {
        return;
    }
}

CheckResult judge(const SelftestCase& tested, const Check& check, const Measured& measured,
                  const std::string& backend) {
    const Tolerance& tolerance =
        backend == "embree" && check.with_embree ? *check.with_embree : check.tolerance;
    CheckResult result;
    result.number = tested.number;
    result.name = tested.name;
    result.what = check.what;
    result.backend = backend;
    result.expected = check.expected;
    result.measured = measured.value;
    result.error = measured.error;
    result.tolerance = allowed(tolerance, check.expected, measured.error);
    result.reason = check.reason;
    result.note = measured.note;
    result.passed = std::isfinite(measured.value) &&
                    std::abs(measured.value - check.expected) <= result.tolerance;
    // An estimate that is too uncertain would accept anything.
    const double largest = tolerance.largest_error * std::abs(check.expected);
    if (tolerance.largest_error > 0.0 && !(measured.error <= largest)) {
        result.passed = false;
        result.note = fmt::format("the standard error is {:.3g}, expected at most {:.3g}",
                                  measured.error, largest);
    }
    return result;
}

}  // namespace

SelftestTotals run_selftest(std::span<const SelftestCase> cases,
                            std::span<Executor* const> executors,
                            const std::function<void(const CheckResult&)>& report) {
    SelftestTotals totals;
    std::map<std::pair<KernelId, std::uint32_t>, KernelUse> used;
    for (Executor* const executor : executors) {
        compile_quietly(*executor, used);
        for (const SelftestCase& tested : cases) {
            const bool on_host = tested.runs_on == RunsOn::host;
            if (on_host && executor != executors.front()) continue;
            const std::string backend = on_host ? "host" : executor->device().backend;
            const std::vector<Measured> values = measure(tested, *executor);
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (backend == "embree" && tested.checks[i].own_traversal) continue;
                const CheckResult result = judge(tested, tested.checks[i], values[i], backend);
                ++(result.passed ? totals.passed : totals.failed);
                report(result);
            }
        }
        for (const KernelBuild& build : executor->builds())
            used.try_emplace({build.use.kernel, build.use.features}, build.use);
    }
    return totals;
}

}  // namespace weft::selftest
