// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/background_options.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/quote.h"
#include "base/srgb.h"

namespace weft {
namespace {

constexpr float brightest_background = 1e6F;

/// `#rgb` or `#rrggbb`.
std::optional<glm::vec3> parse_hex_colour(std::string_view text) {
    if (text.empty() || text[0] != '#' || (text.size() != 4 && text.size() != 7)) return {};
    const std::size_t digits = (text.size() - 1) / 3;
    glm::vec3 colour(0.0F);
    for (std::size_t c = 0; c < 3; ++c) {
        const char* const begin = text.data() + 1 + c * digits;
        std::uint32_t code = 0;
        const auto [end, error] = std::from_chars(begin, begin + digits, code, 16);
        if (error != std::errc() || end != begin + digits) return {};
        const std::uint32_t byte = digits == 1 ? code * 17 : code;
        colour[static_cast<glm::length_t>(c)] =
            static_cast<float>(linear_from_srgb(static_cast<double>(byte) / 255.0));
    }
    return colour;
}

/// `R,G,B`.
std::optional<glm::vec3> parse_linear_colour(std::string_view text) {
    glm::vec3 colour(0.0F);
    const char* at = text.data();
    const char* const end = at + text.size();
    for (glm::length_t c = 0; c < 3; ++c) {
        if (c > 0 && (at == end || *at++ != ',')) return {};
        const auto [next, error] = std::from_chars(at, end, colour[c]);
        if (error != std::errc() || !(colour[c] >= 0.0F && colour[c] <= brightest_background))
            return {};
        at = next;
    }
    if (at != end) return {};
    return colour;
}

}  // namespace

Background parse_background(std::string_view option, std::string_view text) {
    if (text == "transparent") return {};
    if (text == "white") return {false, glm::vec3(1.0F)};
    if (text == "black") return {false, glm::vec3(0.0F)};
    std::optional<glm::vec3> colour = parse_hex_colour(text);
    if (!colour) colour = parse_linear_colour(text);
    if (!colour)
        throw Error(ExitCode::usage, std::string(option),
                    quote(text) +
                        " is not a background, expected transparent, white, black, #rrggbb or "
                        "linear numbers R,G,B");
    return {false, *colour};
}

}  // namespace weft
