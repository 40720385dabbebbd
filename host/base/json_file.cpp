// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/json_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

using Json = nlohmann::json;

/// Stops the parser where JSON is nested too deeply, has too many values or is ambiguous, before a
/// tree is made of it.
class Watch {
  public:
    explicit Watch(const std::string& path) : path_(path) {}

    void operator()(int depth, Json::parse_event_t event, const Json& value) {
        using Event = Json::parse_event_t;
        const bool opens = event == Event::object_start || event == Event::array_start;
        if (opens && depth >= limits::max_nesting)
            throw input_error(path_, "JSON is nested deeper than " +
                                         std::to_string(limits::max_nesting) + " levels");
        if (opens || event == Event::value) ++values_;
        if (values_ > limits::max_json_values)
            throw input_error(path_, "JSON holds more than " +
                                         std::to_string(limits::max_json_values) + " values");
        if (event == Event::object_start) keys_.emplace_back();
        if (event == Event::object_end) keys_.pop_back();
        // The tree would silently keep the last value of a key alone.
        if (event == Event::key && !keys_.back().insert(value.get_ref<const std::string&>()).second)
            throw input_error(path_, "JSON has an object with the key " +
                                         quote(value.get_ref<const std::string&>()) +
                                         " twice, expected it once");
    }

  private:
    const std::string& path_;
    std::size_t values_ = 0;
    std::vector<std::set<std::string>> keys_;  ///< of the objects that are open
};

Error syntax_error(const std::string& path, std::string_view text, std::size_t byte) {
    return input_error(line_place(path, text, byte), "JSON syntax error");
}

}  // namespace

Json read_json_text(std::string_view text, const std::string& place) {
    // The parser takes NUL for the end, and would silently ignore what follows.
    const std::size_t nul = text.find('\0');
    if (nul != std::string_view::npos) throw syntax_error(place, text, nul);
    Watch watch(place);
    const auto take = [&](int depth, Json::parse_event_t event, const Json& value) {
        watch(depth, event, value);
        return true;
    };
    try {
        return Json::parse(text.begin(), text.end(), take);
    } catch (const Json::parse_error& error) {
        throw syntax_error(place, text, error.byte > 0 ? error.byte - 1 : 0);
    } catch (const Json::exception&) {
        throw number_too_large(place, text);
    }
}

Json read_json_file(const std::filesystem::path& file, std::size_t max_bytes) {
    const std::vector<std::byte> bytes = read_file(file, max_bytes);
    return read_json_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                          file.string());
}

std::string list_of(std::initializer_list<const char*> keys) {
    std::string list;
    for (const char* key : keys) list += (list.empty() ? "'" : ", '") + std::string(key) + "'";
    return list;
}

void check_keys(const JsonValue& value, const Json& json,
                std::initializer_list<const char*> known) {
    for (const auto& [key, ignored] : json.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw value.error("has the unknown key " + quote(key) + ", expected " + list_of(known));
}

}  // namespace weft
