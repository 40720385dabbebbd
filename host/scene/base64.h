// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_BASE64_H
#define WEFT_SCENE_BASE64_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Decodes standard base64 (RFC 4648, `+` and `/`); padding may be missing. Throws Error (exit
/// code 2) with `place` for any other character or an impossible length.
[[nodiscard]] std::vector<std::byte> decode_base64(std::string_view text, const std::string& place);

}  // namespace weft

#endif
