// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_KERNEL_RULES_H
#define WEFT_TESTS_TESTING_KERNEL_RULES_H

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Where a kernel source leaves the language subset that compiles alike as OpenCL C 1.2 and C++,
/// one text `line: what is wrong, what was expected` each. Comments and literals do not count.
/// `is_shim` is for port.h and its two halves, which alone may spell out vectors and lanes.
[[nodiscard]] std::vector<std::string> kernel_rule_violations(std::string_view source,
                                                              bool is_shim);

}  // namespace weft

#endif
