// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_NULL_DEVICE_H
#define WEFT_BASE_NULL_DEVICE_H

#include <initializer_list>

namespace weft {

/// Makes file descriptors lead to /dev/null: what is written to them is dropped, and reading finds
/// the end at once. Returns whether all of them do; those before one that fails are changed.
bool lead_to_null_device(std::initializer_list<int> descriptors) noexcept;

}  // namespace weft

#endif
