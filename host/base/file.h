// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_FILE_H
#define WEFT_BASE_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The whole file, at most `max_bytes` long. Throws Error (exit code 2) that names `place` (or the
/// path, where `place` is empty) when it is missing, not a regular file, too long or unreadable.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path,
                                               std::size_t max_bytes,
                                               const std::string& place = {});

/// The first bytes of a file, at most `most_bytes`: enough to tell what it is. Throws as read_file.
[[nodiscard]] std::vector<std::byte> read_file_head(const std::filesystem::path& path,
                                                    std::size_t most_bytes);

/// Resolves a relative reference inside a scene file against the folder of that file. Refuses
/// absolute paths, URI schemes, `..` components and NUL bytes with an Error (exit code 2).
/// Percent-escapes are decoded first when `percent_encoded`.
[[nodiscard]] std::filesystem::path resolve_reference(const std::filesystem::path& scene_file,
                                                      const std::string& reference,
                                                      const std::string& place,
                                                      bool percent_encoded);

/// Refuses a file that could never be written, before time is spent on what goes into it: its
/// folder is missing, or what is there is read-only, no regular file or a link that leads nowhere.
/// Throws Error (exit code 5).
void check_output(const std::filesystem::path& path);

/// What becomes of a file that write_file_atomically has written beside its name.
enum class WriteMode : std::uint8_t {
    flushed,    ///< is flushed to disk, then renamed
    unflushed,  ///< is renamed: for files that are checked when read, and can be made again
    rehearsed,  ///< is flushed and removed again, which tells how long writing takes
};

/// Writes a file so that no reader ever sees half of it: `write` fills a temporary file beside
/// `path`, which is then flushed and renamed. On any failure the temporary file is removed and the
/// old file stays, as it does where it is read-only; a new one has its permissions. Throws Error
/// (exit code 5).
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path&)>& write,
                           WriteMode mode = WriteMode::flushed);

/// `write_file_atomically` of given bytes.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes,
                           WriteMode mode = WriteMode::flushed);

}  // namespace weft

#endif
