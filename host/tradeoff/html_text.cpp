// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/html_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/base64.h"

namespace weft {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

/// Number of bytes of the character that `text` starts with; 0 where it does not start with one of
/// UTF-8 that XML allows (RFC 3629, XML 1.0 2.2).
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? std::uint32_t{static_cast<unsigned char>(text[i])} : 0U;
    };
    const std::uint32_t first = byte(0);
    if (first < 0x80)
        return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4) return 0;
    std::uint32_t code = first & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) return 0;
        code = code << 6 | (byte(i) & 0x3FU);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    const bool unknown = code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
    return overlong || surrogate || unknown ? 0 : length;
}

/// Calls `take` with every character, and with the replacement character for invalid bytes.
template <typename Take>
void for_each_character(std::string_view text, const Take& take) {
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        take(length > 0 ? text.substr(0, length) : replacement);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
}

}  // namespace

std::string escape_markup(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for_each_character(text, [&](std::string_view character) {
        if (character == "&")
            result += "&amp;";
        else if (character == "<")
            result += "&lt;";
        else if (character == ">")
            result += "&gt;";
        else if (character == "\"")
            result += "&quot;";
        else if (character == "'")
            result += "&#39;";
        else
            result += character;
    });
    return result;
}

std::string text_element(std::string_view name, std::string_view text,
                         std::string_view attributes) {
    return fmt::format("<{0}{1}{2}>{3}</{0}>", name, attributes.empty() ? "" : " ", attributes,
                       escape_markup(text));
}

std::string figure_text(double value) {
    if (!std::isfinite(value)) return "\u2013";
    if (value == 0.0) return "0";
    const double magnitude = std::abs(value);
    if (magnitude < 1e-4 || magnitude >= 1e6) return fmt::format("{:.3g}", value);
    // Rounded first, as rounding may carry into one more digit before the point.
    const std::string scientific = fmt::format("{:.2e}", magnitude);
    const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
    return fmt::format("{:.{}f}", value, std::max(0, 2 - exponent));
}

std::string round_text(double value) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : figure_text(value);
}

std::string count_text(unsigned long long value) {
    std::string digits = std::to_string(value);
    for (std::size_t place = digits.size(); place > 3; place -= 3)
        digits.insert(place - 3, "\u202F");
    return digits;
}

std::string short_count_text(unsigned long long value) {
    constexpr unsigned long long most_whole = 9999;
    if (value <= most_whole) return std::to_string(value);
    auto rest = static_cast<double>(value);
    std::string prefix;
    for (const char* const next : {"k", "M", "G", "T", "P", "E"}) {
        // Smaller ones do not become 1000 when they are rounded to three digits.
        if (rest < 999.5) break;
        rest /= 1000.0;
        prefix = next;
    }
    return figure_text(rest) + "\u202F" + prefix;
}

std::string cut_text(std::string_view text, std::size_t characters) {
    std::string result;
    std::size_t before_last = 0;
    std::size_t count = 0;
    for_each_character(text, [&](std::string_view character) {
        if (++count > characters) return;
        before_last = result.size();
        result += character;
    });
    if (count > characters) result.replace(before_last, std::string::npos, "\u2026");
    return result;
}

std::string png_uri(std::span<const std::byte> bytes) {
    return "data:image/png;base64," + encode_base64(bytes);
}

}  // namespace weft
