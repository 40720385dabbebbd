// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_CASE_REGISTRY_H
#define WEFT_SELFTEST_CASE_REGISTRY_H

#include <vector>

#include "selftest/selftest_case.h"

namespace weft::selftest {

/// All hard cases, numbered from 1 on in this order. A case with a part that the host computes by
/// itself is listed twice, that part first. Making them runs nothing.
[[nodiscard]] const std::vector<SelftestCase>& selftest_cases();

}  // namespace weft::selftest

#endif
