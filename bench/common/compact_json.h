// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_COMPACT_JSON_H
#define WEFT_BENCH_COMMON_COMPACT_JSON_H

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace weft::bench {

/// JSON as text that people can read as well: a value stands on one line where it fits into 100
/// columns, else its entries stand below each other, indented by two. `indent`: of its own line, of
/// which `used` columns are taken. Without a line end.
[[nodiscard]] inline std::string compact_json(const nlohmann::json& json, std::size_t indent = 0,
                                              std::size_t used = 0) {
    constexpr std::size_t columns = 100;
    constexpr std::size_t step = 2;
    std::string line = json.dump();
    if (!json.is_structured() || json.empty() || used + line.size() <= columns) return line;
    const std::string margin(indent + step, ' ');
    std::string text;
    for (const auto& [key, value] : json.items()) {
        const std::string name = json.is_object() ? nlohmann::json(key).dump() + ": " : "";
        text += (text.empty() ? "\n" : ",\n") + margin + name;
        // A comma may follow.
        text += compact_json(value, indent + step, margin.size() + name.size() + 1);
    }
    const char* const ends = json.is_object() ? "{}" : "[]";
    return ends[0] + text + "\n" + std::string(indent, ' ') + ends[1];
}

}  // namespace weft::bench

#endif
