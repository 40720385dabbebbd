// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_BASE64_H
#define WEFT_BASE_BASE64_H

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Decodes standard base64 (RFC 4648, `+` and `/`); padding may be missing. Throws Error (exit
/// code 2) with `place` for any other character or an impossible length.
[[nodiscard]] std::vector<std::byte> decode_base64(std::string_view text, const std::string& place);

/// Standard base64 with padding, on one line.
[[nodiscard]] std::string encode_base64(std::span<const std::byte> bytes);

}  // namespace weft

#endif
