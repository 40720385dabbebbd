// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <span>

#include "base/error.h"
#include "base/file.h"

namespace weft {

std::filesystem::path ViewFiles::next(const std::string& ending) const {
    constexpr int most = 9999;
    if (folder_.empty())
        throw Error(ExitCode::output,
                    "nothing can be saved, expected weft view with --output FOLDER");
    for (int number = 1; number <= most; ++number) {
        std::filesystem::path file = folder_ / fmt::format("view-{:03}{}", number, ending);
        std::error_code error;
        if (!std::filesystem::exists(file, error)) return file;
    }
    throw Error(ExitCode::output, folder_.string(), "has 9999 saved views, expected fewer");
}

std::filesystem::path ViewFiles::write(const nlohmann::json& json,
                                       const std::string& ending) const {
    constexpr int indent = 2;
    std::filesystem::path file = next(ending);
    const std::string text =
        json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    write_file_atomically(file, std::as_bytes(std::span(text)));
    return file;
}

}  // namespace weft
