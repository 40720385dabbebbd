// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_CACHE_FOLDER_H
#define WEFT_BASE_CACHE_FOLDER_H

#include <filesystem>

namespace weft {

/// The folder of files that Weft keeps between runs: WEFT_CACHE_DIR, else $XDG_CACHE_HOME/weft,
/// else ~/.cache/weft; empty where none is known.
[[nodiscard]] std::filesystem::path default_cache_folder();

/// Makes the folder, and those above it, where they are missing, for this user alone: drivers
/// execute files in it. Throws std::filesystem::filesystem_error.
void make_cache_folder(const std::filesystem::path& folder);

}  // namespace weft

#endif
