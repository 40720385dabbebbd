// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_SELFTEST_RUNNER_H
#define WEFT_SELFTEST_SELFTEST_RUNNER_H

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "selftest/selftest_case.h"

namespace weft::selftest {

/// The result of one check on one backend.
struct CheckResult {
    int number = 0;       ///< of the case
    std::string name;     ///< of the case
    std::string what;     ///< of the check
    std::string backend;  ///< as DeviceInfo::backend; "host" for cases that run no kernels
    double expected = 0.0;
    double measured = 0.0;   ///< NaN where the case threw
    double error = 0.0;      ///< standard error of the measured value; 0 where it is no estimate
    double tolerance = 0.0;  ///< allowed distance
    bool passed = false;
    std::string reason;  ///< of the tolerance
    std::string note;    ///< why it failed, where more is known than the numbers; or empty
};

struct SelftestTotals {
    std::size_t passed = 0;
    std::size_t failed = 0;
};

/// Runs every case on one executor after the other, or on the first alone where it needs no device,
/// and reports each result as soon as it is there. Kernels that the first executors have used are
/// compiled in advance for later ones, so executors that compile nothing should come first. An
/// exception fails all checks of the case on that executor, and nothing else. There is at least one
/// executor.
SelftestTotals run_selftest(std::span<const SelftestCase> cases,
                            std::span<Executor* const> executors,
                            const std::function<void(const CheckResult&)>& report);

}  // namespace weft::selftest

#endif
