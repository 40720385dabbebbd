// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_CASE_COUNT_H
#define WEFT_SELFTEST_CASE_COUNT_H

namespace weft::selftest {

/// Number of hard cases, which are numbered from 1 on. It is apart from the cases themselves, so
/// that the command line can be read without kernels.
inline constexpr unsigned case_count = 41;

}  // namespace weft::selftest

#endif
