// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_SELFTEST_CASE_H
#define WEFT_SELFTEST_SELFTEST_CASE_H

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "device/executor.h"
#include "selftest/statistics.h"
#include "selftest/tolerance.h"

namespace weft::selftest {

/// One number that is known beforehand. Plain data, so that it can be listed without a device.
struct Check {
    std::string what;  ///< a few words beside the case's name
    double expected = 0.0;
    Tolerance tolerance;
    std::string reason;  ///< why the tolerance is what it is, one sentence
    /// Tolerance where Embree traces, if it differs.
    std::optional<Tolerance> with_embree{};
    bool own_traversal = false;  ///< not checked with Embree, which promises nothing there
};

/// The value that a device has measured for a check.
struct Measured {
    double value = 0.0;
    double error = 0.0;  ///< standard error, of estimates
    /// Shown where the check fails, such as the step at which it did.
    std::string note{};

    Measured() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): numbers are what most cases measure
    Measured(double measured) : value(measured) {}
    // NOLINTNEXTLINE(google-explicit-constructor): and estimates the rest
    Measured(const Estimate& estimate) : value(estimate.mean), error(estimate.error) {}
};

/// Where a case runs.
enum class RunsOn : std::uint8_t {
    devices,  ///< every backend: it runs kernels
    host      ///< once: it runs none
};

/// One of the hard cases, or the part of it that runs on devices or on the host: a situation in
/// which renderers go wrong, and numbers that show it.
struct SelftestCase {
    int number = 0;
    std::string name;
    RunsOn runs_on = RunsOn::devices;
    std::vector<Check> checks;
    /// One value for each check, in their order. May throw: then all checks fail.
    std::function<std::vector<Measured>(Executor&)> measure;
};

/// A case that needs no device.
[[nodiscard]] inline SelftestCase host_case(int number, std::string name, std::vector<Check> checks,
                                            std::function<std::vector<Measured>()> measure) {
    return {number, std::move(name), RunsOn::host, std::move(checks),
            [measure = std::move(measure)](Executor&) { return measure(); }};
}

}  // namespace weft::selftest

#endif
