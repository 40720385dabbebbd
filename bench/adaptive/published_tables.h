// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_ADAPTIVE_PUBLISHED_TABLES_H
#define WEFT_BENCH_ADAPTIVE_PUBLISHED_TABLES_H

#include <nlohmann/json.hpp>
#include <string>

namespace weft::bench {

/// Published figures: by table a `meaning` and `rows`, by scene and column. Null where the file is
/// not there; throws Error (exit code 2) where it is no JSON object.
[[nodiscard]] nlohmann::json read_published(const std::string& file);

}  // namespace weft::bench

#endif
