// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_FILES_H
#define WEFT_VIEW_VIEW_FILES_H

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace weft {

/// Names the files that a view saves, none of which replaces another.
class ViewFiles {
  public:
    /// `folder`: empty where nothing can be saved.
    explicit ViewFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// The next name that is free, such as view-001.png for ".png". Throws Error (exit code 5)
    /// where there is none.
    [[nodiscard]] std::filesystem::path next(const std::string& ending) const;
    /// Writes JSON to the next file, and returns its name. Throws Error (exit code 5).
    [[nodiscard]] std::filesystem::path write(const nlohmann::json& json,
                                              const std::string& ending) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace weft

#endif
