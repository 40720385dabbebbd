// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_REFERENCES_FOLDER_H
#define WEFT_BENCH_COMMON_REFERENCES_FOLDER_H

#include <filesystem>

namespace weft::bench {

/// The folder of references where the command line names none: that of `weft tradeoff`, in the
/// cache folder; build/references of the source folder where no cache folder is known.
[[nodiscard]] std::filesystem::path references_folder(const std::filesystem::path& source_folder);

}  // namespace weft::bench

#endif
