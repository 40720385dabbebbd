// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_PRINT_H
#define WEFT_APP_PRINT_H

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/diagnostics.h"

namespace weft {

/// Writes a command's result to standard output and flushes it. Throws Error (exit code 5) where
/// not all of it arrives: a full disk, a pipe whose reader has gone.
void print_result(std::string_view text);

/// One line `weft: text` on standard error, whatever bytes `text` holds; a failure to write is
/// ignored, as there is nowhere left to report it.
void print_message(std::string_view text) noexcept;

/// Prints the warnings that were not printed before, one line a kind, at most
/// longest_warning_line characters; with `verbose` every place, and nothing shortened.
/// Where memory does not suffice for them, it says that instead.
void print_warnings(Diagnostics& diagnostics, bool verbose) noexcept;

/// Indented JSON with a line end. Bytes that are not UTF-8, as file names may hold, are replaced.
[[nodiscard]] std::string json_document(const nlohmann::json& json);

}  // namespace weft

#endif
