// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_JSON_TEXT_H
#define WEFT_BASE_JSON_TEXT_H

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/error.h"

namespace weft {

/// `file:line` of a byte of a file's text, for error messages.
[[nodiscard]] std::string line_place(const std::string& file, std::string_view text,
                                     std::size_t byte);

/// The error (exit code 2) for JSON text that the parser refuses because of a number which no
/// double can hold: it names the number and its line. `text` is read once more.
[[nodiscard]] Error number_too_large(const std::string& file, std::string_view text);

/// JSON in one line of valid UTF-8: names of files, and what others have sent, may be any bytes.
[[nodiscard]] std::string json_line(const nlohmann::json& json);

}  // namespace weft

#endif
