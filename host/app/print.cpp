// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/print.h"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

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

void print_warnings(Diagnostics& diagnostics, bool verbose) noexcept try {
    constexpr std::string_view mark = "warning: ";
    constexpr std::size_t room =
        longest_warning_line - std::string_view("weft: ").size() - mark.size();
    for (const Warning& warning : diagnostics.take_new()) {
        std::vector<std::string> lines;
        if (verbose)
            lines = warning_details(warning);
        else
            lines.push_back(warning_line(warning, room));
        lines.front().insert(0, mark);
        for (const std::string& line : lines) print_message(line);
    }
} catch (const std::exception&) {
    print_message("warning: no memory is left to print warnings");
}

std::string json_document(const nlohmann::json& json) {
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace weft
