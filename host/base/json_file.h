// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_JSON_FILE_H
#define WEFT_BASE_JSON_FILE_H

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/json_value.h"

namespace weft {

/// Reads a JSON file of any origin. Throws Error (exit code 2) that names the file, and the line of
/// a syntax error, where it is longer than `max_bytes`, nested too deeply, of too many values or
/// damaged, or an object has a key twice.
[[nodiscard]] nlohmann::json read_json_file(const std::filesystem::path& file,
                                            std::size_t max_bytes);

/// The same for JSON that did not come as a file; `place` says in errors where it came from.
[[nodiscard]] nlohmann::json read_json_text(std::string_view text, const std::string& place);

/// The keys as a text for errors, such as "'a', 'b'".
[[nodiscard]] std::string list_of(std::initializer_list<const char*> keys);

/// Throws Error (exit code 2) where the object `json`, which `value` stands for, has a key that is
/// not in `known`.
void check_keys(const JsonValue& value, const nlohmann::json& json,
                std::initializer_list<const char*> known);

}  // namespace weft

#endif
