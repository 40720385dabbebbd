// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_QUOTE_H
#define WEFT_BASE_QUOTE_H

#include <cstddef>
#include <string>
#include <string_view>

namespace weft {

/// Text from a file, fit for a one-line message: in single quotes, control characters replaced
/// by `?`, and cut after 80 bytes.
[[nodiscard]] inline std::string quote(std::string_view text) {
    constexpr std::size_t max_length = 80;
    std::string result = "'";
    for (const char c : text.substr(0, max_length)) {
        const auto code = static_cast<unsigned char>(c);
        result += code < 0x20 || code == 0x7F ? '?' : c;
    }
    result += text.size() > max_length ? "...'" : "'";
    return result;
}

}  // namespace weft

#endif
