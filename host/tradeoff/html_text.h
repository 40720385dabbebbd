// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_HTML_TEXT_H
#define WEFT_TRADEOFF_HTML_TEXT_H

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace weft {

/// Escapes text for elements and quoted attributes of HTML and XML: `&`, `<`, `>` and both quotes
/// become references; bytes that are not UTF-8, and characters that XML does not allow, U+FFFD.
[[nodiscard]] std::string escape_markup(std::string_view text);

/// An element of text: escapes it. `attributes` are markup.
[[nodiscard]] std::string text_element(std::string_view name, std::string_view text,
                                       std::string_view attributes = {});

/// A number with three significant digits, without an exponent between 0.0001 and a million;
/// an en dash where it is not finite.
[[nodiscard]] std::string figure_text(double value);

/// A round number without trailing zeros, for settings rather than measurements; an en dash where
/// it is not finite.
[[nodiscard]] std::string round_text(double value);

/// A whole number with its digits in groups of three.
[[nodiscard]] std::string count_text(unsigned long long value);
/// A count of at most four characters beside its prefix: 9999, 12.3 k, 456 M.
[[nodiscard]] std::string short_count_text(unsigned long long value);

/// Text cut to so many characters, the last of them an ellipsis where something is missing.
[[nodiscard]] std::string cut_text(std::string_view text, std::size_t characters);

/// A `data:` URI of the bytes of a PNG file.
[[nodiscard]] std::string png_uri(std::span<const std::byte> bytes);

}  // namespace weft

#endif
