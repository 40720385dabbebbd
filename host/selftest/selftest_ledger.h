// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_SELFTEST_LEDGER_H
#define WEFT_SELFTEST_SELFTEST_LEDGER_H

#include <span>
#include <string>

#include "selftest/selftest_case.h"

namespace weft::selftest {

/// All checks as a Markdown table: number, case, expected value, tolerance, its reason, and where
/// it runs. The same text on every machine, since nothing is run for it.
[[nodiscard]] std::string selftest_ledger(std::span<const SelftestCase> cases);

}  // namespace weft::selftest

#endif
