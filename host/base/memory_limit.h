// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_MEMORY_LIMIT_H
#define WEFT_BASE_MEMORY_LIMIT_H

#include <cstdint>
#include <optional>

namespace weft {

/// The bytes of address space that this process may have; empty where they are not limited.
[[nodiscard]] std::optional<std::uint64_t> memory_limit() noexcept;

}  // namespace weft

#endif
