// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "app/choose_executor.h"
#include "app/commands.h"
#include "app/print.h"
#include "app/stats_json.h"
#include "base/file.h"
#include "base/stopwatch.h"
#include "selftest/case_registry.h"
#include "selftest/selftest_ledger.h"
#include "selftest/selftest_report.h"

namespace weft {
namespace {

using selftest::CheckResult;
using selftest::SelftestCase;
using selftest::SelftestTotals;

std::vector<SelftestCase> chosen_cases(const std::vector<int>& numbers) {
    std::vector<SelftestCase> chosen = selftest::selftest_cases();
    if (!numbers.empty())
        std::erase_if(chosen, [&](const SelftestCase& one) {
            return std::find(numbers.begin(), numbers.end(), one.number) == numbers.end();
        });
    return chosen;
}

void print_devices(const std::vector<Executor*>& executors) {
    std::string text;
    for (const Executor* const executor : executors)
        text += fmt::format("{:<7}  {} ({})\n", executor->device().backend, executor->device().name,
                            executor->device().driver);
    if (std::all_of(executors.begin(), executors.end(), [](const Executor* executor) {
            return executor->device().backend != "opencl";
        })) {
        const std::string why = why_no_opencl(0);
        text += (why.empty() ? "no OpenCL device is tested" : why) + ": native code alone\n";
    }
    print_result(text + "\n" + selftest::report_heading());
}

void write_json(const std::filesystem::path& path, const std::vector<Executor*>& executors,
                std::span<const CheckResult> results, const SelftestTotals& totals,
                double milliseconds) {
    nlohmann::json json = selftest::report_json(results, totals);
    json["seconds"] = milliseconds / 1000.0;
    json["devices"] = nlohmann::json::array();
    for (const Executor* const executor : executors)
        json["devices"].push_back(device_json(executor->device()));
    const std::string text = json_document(json);
    write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace

ExitCode selftest_command(const SelftestOptions& options) {
    const std::vector<SelftestCase> cases = chosen_cases(options.cases);
    if (options.ledger) {
        print_result(selftest::selftest_ledger(cases));
        return ExitCode::success;
    }
    const std::vector<std::unique_ptr<Executor>> owned = selftest_executors(options);
    std::vector<Executor*> executors;
    for (const auto& executor : owned) executors.push_back(executor.get());
    print_devices(executors);
    const Stopwatch watch;
    std::vector<CheckResult> results;
    const SelftestTotals totals =
        selftest::run_selftest(cases, executors, [&](const CheckResult& result) {
            results.push_back(result);
            print_result(selftest::report_line(result));
        });
    if (options.json) write_json(*options.json, executors, results, totals, watch.total());
    print_result(selftest::report_totals(totals));
    return totals.failed == 0 ? ExitCode::success : ExitCode::device;
}

}  // namespace weft
