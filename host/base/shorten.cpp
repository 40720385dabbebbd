// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/shorten.h"

#include <algorithm>

namespace weft {
namespace {

bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace

std::size_t count_characters(std::string_view text) {
    return text.size() -
           static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_continuation));
}

std::string_view first_characters(std::string_view text, std::size_t count) {
    std::size_t end = 0;
    while (end < text.size() && count > 0) {
        ++end;
        while (end < text.size() && is_continuation(text[end])) ++end;
        --count;
    }
    return text.substr(0, end);
}

std::string without_middle(std::string_view text, std::size_t room) {
    constexpr std::string_view dots = "...";
    const std::size_t characters = count_characters(text);
    if (characters <= room) return std::string(text);
    const std::size_t kept = room - std::min(room, dots.size());
    const std::size_t end = kept - kept / 2;
    return std::string(first_characters(text, kept / 2)) + std::string(dots) +
           std::string(text.substr(first_characters(text, characters - end).size()));
}

}  // namespace weft
