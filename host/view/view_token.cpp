// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_token.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace weft {

std::string make_view_token() {
    std::array<unsigned char, 16> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw Error(ExitCode::output, std::string("the system has no random numbers for a key: ") +
                                          std::strerror(errno));
    constexpr std::string_view digits = "0123456789abcdef";
    std::string token;
    for (const unsigned char byte : bytes) {
        token += digits[byte >> 4U];
        token += digits[byte & 0xFU];
    }
    return token;
}

bool is_same_token(std::string_view token, std::string_view given) noexcept {
    if (token.size() != given.size()) return false;
    unsigned char differs = 0;
    for (std::size_t i = 0; i < token.size(); ++i)
        differs = static_cast<unsigned char>(differs | (static_cast<unsigned char>(token[i]) ^
                                                        static_cast<unsigned char>(given[i])));
    return differs == 0;
}

}  // namespace weft
