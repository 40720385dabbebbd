// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/print.h"

#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/error.h"

namespace weft {

void print_result(std::string_view text) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (written && std::fflush(stdout) == 0) return;
    throw Error(ExitCode::output, "standard output",
                "cannot be written: " + std::generic_category().message(errno));
}

void print_message(std::string_view text) noexcept {
    for (const std::string_view part : {std::string_view("weft: "), text, std::string_view("\n")})
        static_cast<void>(std::fwrite(part.data(), 1, part.size(), stderr));
    std::fflush(stderr);
}

std::string json_document(const nlohmann::json& json) {
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace weft
