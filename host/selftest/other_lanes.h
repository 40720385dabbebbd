// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_OTHER_LANES_H
#define WEFT_SELFTEST_OTHER_LANES_H

#include <memory>

#include "device/executor.h"

namespace weft::selftest {

/// The native build that traces with Weft's own traversal, at another packet width than
/// `executor`'s: at one lane, or at four where that has one.
[[nodiscard]] std::unique_ptr<Executor> native_at_other_lanes(const Executor& executor);

}  // namespace weft::selftest

#endif
