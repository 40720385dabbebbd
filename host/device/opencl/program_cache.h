// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_PROGRAM_CACHE_H
#define WEFT_DEVICE_OPENCL_PROGRAM_CACHE_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/cache_folder.h"

namespace weft {

/// Keeps compiled programs on disk, keyed by everything they depend on. An entry that is damaged in
/// any way reads as absent; a cache that cannot be written is no error.
class ProgramCache {
  public:
    /// `folder` empty: no cache.
    explicit ProgramCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// 128-bit key, in hexadecimal, of any number of texts.
    [[nodiscard]] static std::string key(std::span<const std::string_view> parts);

    [[nodiscard]] std::optional<std::vector<unsigned char>> load(const std::string& key) const;
    void store(const std::string& key, std::span<const unsigned char> program) const;
    void remove(const std::string& key) const;

    /// Whether there is an entry, damaged or not.
    [[nodiscard]] bool contains(const std::string& key) const;
    /// Whether entries can be stored, as far as that can be told in advance; makes the folder.
    [[nodiscard]] bool writable() const;
    [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

  private:
    [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;

    std::filesystem::path folder_;
};

}  // namespace weft

#endif
