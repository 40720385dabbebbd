// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/cache_folder.h"

#include <cstdlib>

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
    if (folder.empty() || std::filesystem::is_directory(folder)) return;
    make_cache_folder(folder.parent_path());
    if (std::filesystem::create_directory(folder))
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

}  // namespace weft
