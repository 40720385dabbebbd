// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/cache_folder.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace weft {

std::filesystem::path default_cache_folder() {
    const auto variable = [](const char* name) {
        const char* const value = std::getenv(name);
        return std::filesystem::path(value == nullptr ? "" : value);
    };
    if (auto folder = variable("WEFT_CACHE_DIR"); !folder.empty()) return folder;
    if (const auto folder = variable("XDG_CACHE_HOME"); folder.is_absolute())
        return folder / "weft";
    if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "weft";
    return {};
}

void make_cache_folder(const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    if (folder.empty() || fs::is_directory(folder)) return;
    if (fs::exists(folder))
        throw fs::filesystem_error("cannot make a folder", folder,
                                   std::make_error_code(std::errc::not_a_directory));
    make_cache_folder(folder.parent_path());
    if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST)
        throw fs::filesystem_error("cannot make a folder", folder,
                                   std::error_code(errno, std::generic_category()));
}

}  // namespace weft
