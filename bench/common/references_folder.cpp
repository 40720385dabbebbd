// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/references_folder.h"

#include "tradeoff/reference_files.h"

namespace weft::bench {

std::filesystem::path references_folder(const std::filesystem::path& source_folder) {
    const std::filesystem::path folder = default_references_folder();
    return folder.empty() ? source_folder / "build" / "references" : folder;
}

}  // namespace weft::bench
