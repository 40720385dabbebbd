// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "device/native/native_executor.h"
#include "selftest/case_count.h"
#include "selftest/case_registry.h"
#include "selftest/selftest_ledger.h"
#include "selftest/selftest_report.h"

// `weft selftest` without the light: what it counts, prints and survives, and what every case says
// of itself. That it notices a broken kernel is in selftest_check.sh.
namespace weft::selftest_test {
namespace {

using selftest::Check;
using selftest::CheckResult;
using selftest::Measured;
using selftest::RunsOn;
using selftest::SelftestCase;
using selftest::SelftestTotals;
using selftest::Tolerance;

const std::string reason = "it is so";

SelftestCase made_up(RunsOn runs_on, std::vector<Check> checks, std::vector<Measured> values) {
    return {1, "made up", runs_on, std::move(checks), [values](Executor&) { return values; }};
}

struct Outcome {
    SelftestTotals totals;
    std::vector<CheckResult> results;
};

/// Runs a case on both native backends.
Outcome outcome_of(const std::vector<SelftestCase>& cases) {
    const auto own = make_native_executor(NativeTraversal::own_bvh, 1);
    const auto embree = make_native_executor(NativeTraversal::embree, 1);
    const std::vector<Executor*> executors{own.get(), embree.get()};
    Outcome outcome;
    outcome.totals = selftest::run_selftest(
        cases, executors, [&](const CheckResult& result) { outcome.results.push_back(result); });
    return outcome;
}

bool passes(const Tolerance& tolerance, double expected, const Measured& measured) {
    const Outcome outcome =
        outcome_of({made_up(RunsOn::host, {{"value", expected, tolerance, reason}}, {measured})});
    EXPECT_EQ(outcome.results.size(), 1U);
    return outcome.totals.passed == 1;
}

TEST(Selftest, ValuesPassWithinTheirTolerance) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(passes(selftest::within(0.0), 2.0, 2.0));
    EXPECT_FALSE(passes(selftest::within(0.0), 2.0, 2.0000001));
    EXPECT_TRUE(passes(selftest::within(0.1), -2.0, -2.09));
    EXPECT_FALSE(passes(selftest::within(0.1), -2.0, -2.11));
    EXPECT_TRUE(passes(selftest::share(0.01), -200.0, -201.9));
    EXPECT_FALSE(passes(selftest::share(0.01), -200.0, -202.1));
    EXPECT_FALSE(passes(selftest::within(infinity), 1.0, nan));
    EXPECT_FALSE(passes(selftest::within(infinity), 1.0, infinity));
}

TEST(Selftest, EstimatesPassWithinWhatChanceDoes) {
    // 4.417 standard errors either way have the probability 1e-5, by tables of the normal
    // distribution; 7.647 by Student's with 11 degrees of freedom.
    const Tolerance known = selftest::by_chance(0.01, 0.0);
    EXPECT_NEAR(selftest::standard_errors(known), 4.4172, 1e-3);
    EXPECT_TRUE(passes(known, 100.0, selftest::Estimate{104.41, 1.0}));
    EXPECT_FALSE(passes(known, 100.0, selftest::Estimate{104.42, 1.0}));
    EXPECT_NEAR(selftest::standard_errors(selftest::by_chance(0.01, 0.0, 12)), 7.6475, 1e-3);
    // An estimate that is too uncertain says nothing.
    EXPECT_FALSE(passes(known, 100.0, selftest::Estimate{100.0, 1.1}));
    EXPECT_FALSE(
        passes(known, 100.0, selftest::Estimate{100.0, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(Selftest, RunsOnceOnTheHostAndElseOnEveryBackend) {
    const std::vector<Check> one{{"value", 1.0, {}, reason}};
    const Outcome host = outcome_of({made_up(RunsOn::host, one, {1.0})});
    ASSERT_EQ(host.results.size(), 1U);
    EXPECT_EQ(host.results[0].backend, "host");
    const Outcome devices = outcome_of({made_up(RunsOn::devices, one, {1.0})});
    ASSERT_EQ(devices.results.size(), 2U);
    EXPECT_EQ(devices.results[0].backend, "native");
    EXPECT_EQ(devices.results[1].backend, "embree");
}

TEST(Selftest, EmbreeMayHaveATolerance) {
    Check check{"value", 0.0, selftest::within(0.0), reason, selftest::within(2.0)};
    const Outcome wider = outcome_of({made_up(RunsOn::devices, {check}, {1.0})});
    EXPECT_EQ(wider.totals.passed, 1U);
    EXPECT_EQ(wider.totals.failed, 1U);
    check.own_traversal = true;
    EXPECT_EQ(outcome_of({made_up(RunsOn::devices, {check}, {1.0})}).results.size(), 1U);
}

TEST(Selftest, AFailingCaseStopsNoOther) {
    const std::vector<Check> two{{"a", 1.0, {}, reason}, {"b", 2.0, {}, reason}};
    SelftestCase throwing = made_up(RunsOn::host, two, {});
    throwing.measure = [](Executor&) -> std::vector<Measured> {
        throw std::runtime_error("the device is on fire");
    };
    const Outcome outcome = outcome_of(
        {throwing, made_up(RunsOn::host, two, {1.0}), made_up(RunsOn::host, two, {1.0, 3.0})});
    EXPECT_EQ(outcome.totals.passed, 1U);
    EXPECT_EQ(outcome.totals.failed, 5U);
    ASSERT_EQ(outcome.results.size(), 6U);
    EXPECT_EQ(outcome.results[1].note, "the device is on fire");
    EXPECT_TRUE(std::isnan(outcome.results[1].measured));
    EXPECT_EQ(outcome.results[2].note, "the case measured 1 values, expected 2");
}

TEST(Selftest, LinesAreAlignedAndSayWhatFailed) {
    CheckResult result{
        7, "name", "what", "opencl", 1.0, 0.25, 0.0, 0.5, false, reason, "because of the moon"};
    const std::string failed = selftest::report_line(result);
    EXPECT_NE(failed.find(" 7  name: what"), std::string::npos);
    EXPECT_NE(failed.find("FAILED\n    because of the moon\n"), std::string::npos);
    result.passed = true;
    result.measured = -1.234567891e-100;
    const std::string passed = selftest::report_line(result);
    EXPECT_EQ(passed.find("moon"), std::string::npos);
    EXPECT_EQ(passed.find("passed"), failed.find("FAILED"));
    EXPECT_EQ(selftest::report_heading().find("result"), failed.find("FAILED"));
    EXPECT_EQ(selftest::report_totals({3, 4}), "3 passed, 4 failed\n");
    const nlohmann::json json = selftest::report_json(std::vector{result}, {1, 0});
    EXPECT_EQ(json.at("passed"), 1);
    EXPECT_EQ(json.at("checks").at(0).at("check"), "what");
}

TEST(Selftest, HasAllHardCasesInOrder) {
    static_assert(selftest::case_count == 41);
    const std::vector<SelftestCase>& cases = selftest::selftest_cases();
    std::map<int, std::vector<const SelftestCase*>> numbered;
    int before = 1;
    std::size_t checks = 0;
    for (const SelftestCase& listed : cases) {
        EXPECT_GE(listed.number, before);
        before = listed.number;
        numbered[listed.number].push_back(&listed);
        EXPECT_FALSE(listed.name.empty());
        EXPECT_FALSE(listed.checks.empty()) << listed.name;
        EXPECT_TRUE(listed.measure) << listed.name;
        checks += listed.checks.size();
    }
    ASSERT_EQ(numbered.size(), selftest::case_count);
    EXPECT_EQ(numbered.begin()->first, 1);
    EXPECT_EQ(numbered.rbegin()->first, static_cast<int>(selftest::case_count));
    EXPECT_GE(checks, 35U);
    // In two parts only where the host needs no device for one of them.
    for (const auto& [number, parts] : numbered) {
        if (parts.size() == 1) continue;
        ASSERT_EQ(parts.size(), 2U) << number;
        EXPECT_EQ(parts[0]->name, parts[1]->name);
        EXPECT_EQ(parts[0]->runs_on, RunsOn::host) << number;
        EXPECT_EQ(parts[1]->runs_on, RunsOn::devices) << number;
    }
}

TEST(Selftest, EveryToleranceHasAReason) {
    std::set<std::string> titles;
    for (const SelftestCase& listed : selftest::selftest_cases()) {
        for (const Check& check : listed.checks) {
            const std::string title = selftest::title_of(listed.name, check.what);
            EXPECT_GT(check.reason.size(), 10U) << title;
            EXPECT_EQ(check.reason.find('\n'), std::string::npos) << title;
            EXPECT_LE(title.size(), selftest::title_columns) << title;
            EXPECT_TRUE(std::isfinite(check.expected)) << title;
            EXPECT_TRUE(titles.insert(title).second) << title << " is there twice";
            for (const double part : {check.tolerance.absolute, check.tolerance.relative,
                                      check.tolerance.largest_error})
                EXPECT_TRUE(std::isfinite(part) && part >= 0.0) << title;
        }
    }
}

TEST(Selftest, TheLedgerHasALineForEveryCheckAndBreaksNoTable) {
    const std::string ledger = selftest::selftest_ledger(selftest::selftest_cases());
    std::size_t lines = 0;
    std::size_t checks = 0;
    for (std::size_t at = 0; at < ledger.size(); at = ledger.find('\n', at) + 1) {
        const std::string line = ledger.substr(at, ledger.find('\n', at) - at);
        EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 7) << line;
        ++lines;
    }
    for (const SelftestCase& listed : selftest::selftest_cases()) checks += listed.checks.size();
    EXPECT_EQ(lines, checks + 2);
}

}  // namespace
}  // namespace weft::selftest_test
