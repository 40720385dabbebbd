// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_QUOTE_H
#define WEFT_BASE_QUOTE_H

#include <cstddef>
#include <string>
#include <string_view>

namespace weft {

/// Text fit for a one-line message: control characters replaced by `?`.
[[nodiscard]] inline std::string one_line(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F) c = '?';
    }
    return result;
}

/// Text from a file, fit for a one-line message: printable, in single quotes, and cut after 80
/// bytes.
[[nodiscard]] inline std::string quote(std::string_view text) {
    constexpr std::size_t max_length = 80;
    return "'" + one_line(text.substr(0, max_length)) + (text.size() > max_length ? "...'" : "'");
}

}  // namespace weft

#endif
