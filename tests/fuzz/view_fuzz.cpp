// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/readers.h"

/// What libFuzzer calls; whatever is thrown from here, it counts as a crash.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    weft::fuzz::read_view_bytes(std::as_bytes(std::span(data, size)));
    return 0;
}
