// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_TRADEOFF_FILES_H
#define WEFT_TRADEOFF_TRADEOFF_FILES_H

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The result as JSON, without images: what was measured, on what machine, and the advice.
[[nodiscard]] nlohmann::json tradeoff_json(const TradeoffResult& result);

/// The result as CSV: a header, and a row for each point with name, family, whether it is on the
/// front, times, errors and their intervals.
[[nodiscard]] std::string tradeoff_csv(const TradeoffResult& result);

/// The front as a table for people, and the sentences of advice below it.
[[nodiscard]] std::string tradeoff_text(const TradeoffResult& result);

/// Makes a folder where it is missing. Throws Error (exit code 5).
void prepare_folder(const std::filesystem::path& folder);

/// Writes tradeoff.json, tradeoff.csv, index.html and the presets that the advice names into an
/// existing folder; then removes the presets that an earlier run wrote there and this one did not,
/// unless they have been changed. Throws Error (exit code 5).
void write_tradeoff(const std::filesystem::path& folder, const TradeoffResult& result);

}  // namespace weft

#endif
