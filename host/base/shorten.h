// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_SHORTEN_H
#define WEFT_BASE_SHORTEN_H

#include <cstddef>
#include <string>
#include <string_view>

namespace weft {

/// How many characters UTF-8 text has; bytes that are not UTF-8 may count as none.
[[nodiscard]] std::size_t count_characters(std::string_view text);

/// The first `count` characters.
[[nodiscard]] std::string_view first_characters(std::string_view text, std::size_t count);

/// The text where it has at most `room` characters, else its beginning and its end around three
/// dots, in `room` characters in all.
[[nodiscard]] std::string without_middle(std::string_view text, std::size_t room);

}  // namespace weft

#endif
