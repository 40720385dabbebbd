// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/shell_word.h"

namespace weft {

std::string shell_word(std::string_view word) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+=:,@%-";
    if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos)
        return std::string(word);
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string shell_file(std::string_view file) {
    return shell_word(file.starts_with('-') ? "./" + std::string(file) : std::string(file));
}

}  // namespace weft
