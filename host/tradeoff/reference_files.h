// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_REFERENCE_FILES_H
#define WEFT_TRADEOFF_REFERENCE_FILES_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace weft {

/// The folder in which commands and benchmarks keep references and find those of each other, in
/// that of Weft's cache. It depends on the version, whose images may differ. Empty where no cache
/// folder is known.
[[nodiscard]] std::filesystem::path default_references_folder();

/// A file whose name holds a number of samples.
struct SampledFile {
    std::uint32_t samples = 0;
    std::filesystem::path file;
};

/// The files of a folder that are called `prefix`N`suffix`, the largest number first.
[[nodiscard]] std::vector<SampledFile> files_by_samples(const std::filesystem::path& folder,
                                                        std::string_view prefix,
                                                        std::string_view suffix);

/// The same of those called ...-N`suffix`, whatever comes before.
[[nodiscard]] std::vector<SampledFile> files_by_samples(const std::filesystem::path& folder,
                                                        std::string_view suffix);

/// A file of the folder whose name has more before `suffix`, the first in order of names; none
/// where there is none.
[[nodiscard]] std::optional<std::filesystem::path> file_ending_with(
    const std::filesystem::path& folder, std::string_view suffix);

/// The metadata as a finite number; none where it is missing or is none.
[[nodiscard]] std::optional<double> metadata_number(const Image& image, const std::string& key);

}  // namespace weft

#endif
