// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/adaptive/published_tables.h"

#include <cstddef>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/file.h"

namespace weft::bench {

nlohmann::json read_published(const std::string& file) {
    constexpr std::size_t most_bytes = std::size_t{1} << 20;
    if (!std::filesystem::is_regular_file(file)) return {};
    const std::vector<std::byte> bytes = read_file(file, most_bytes);
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    auto json = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
    if (!json.is_object()) throw input_error(file, "is no JSON object, expected published tables");
    return json;
}

}  // namespace weft::bench
