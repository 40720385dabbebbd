// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/json_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

using Json = nlohmann::json;

/// What is too deep or too much ends the parser before the tree is made.
Json parse(const std::string& path, std::string_view text) {
    std::size_t values = 0;
    const auto watch = [&](int depth, Json::parse_event_t event, const Json&) {
        const bool opens =
            event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
        if (opens && depth >= limits::max_nesting)
            throw input_error(path, "JSON is nested deeper than " +
                                        std::to_string(limits::max_nesting) + " levels");
        if (opens || event == Json::parse_event_t::value) ++values;
        if (values > limits::max_json_values)
            throw input_error(path, "JSON holds more than " +
                                        std::to_string(limits::max_json_values) + " values");
        return true;
    };
    try {
        return Json::parse(text.begin(), text.end(), watch);
    } catch (const Json::parse_error& error) {
        const std::string_view before = text.substr(0, error.byte > 0 ? error.byte - 1 : 0);
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        throw input_error(path + ":" + std::to_string(line), "JSON syntax error");
    } catch (const Json::exception&) {
        throw input_error(path, "JSON holds a number that is too large for a double");
    }
}

}  // namespace

Json read_json_file(const std::filesystem::path& file, std::size_t max_bytes) {
    const std::vector<std::byte> bytes = read_file(file, max_bytes);
    return parse(file.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string list_of(std::initializer_list<const char*> keys) {
    std::string list;
    for (const char* key : keys) list += (list.empty() ? "'" : ", '") + std::string(key) + "'";
    return list;
}

void check_keys(const GltfValue& value, const Json& json,
                std::initializer_list<const char*> known) {
    for (const auto& [key, ignored] : json.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw value.error("has the unknown key " + quote(key) + ", expected " + list_of(known));
}

}  // namespace weft
