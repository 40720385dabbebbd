// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_SCRATCH_FOLDER_H
#define WEFT_BENCH_PATH_SCRATCH_FOLDER_H

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "base/error.h"

namespace weft::bench {

/// A fresh folder for files that programs hand to each other; it vanishes with all of them.
class ScratchFolder {
  public:
    /// Throws Error (exit code 5) where none can be made.
    ScratchFolder() {
        std::error_code ignored;
        const auto parent = std::filesystem::temp_directory_path(ignored);
        std::string name = (parent / "weft-bench-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw Error(ExitCode::output, parent.string(),
                        "no folder can be made there, expected one for temporary files");
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace weft::bench

#endif
