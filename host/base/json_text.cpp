// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/quote.h"

namespace weft {
namespace {

/// Takes everything in JSON text and remembers where the parser gave up: the exceptions that it
/// throws for numbers do not say.
class FaultFinder : public nlohmann::json_sax<nlohmann::json> {
  public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t position, const std::string& last_token,
                     const nlohmann::detail::exception&) override {
        end_ = position;
        token_ = last_token;
        return false;
    }

    /// Byte after the token at which the parser gave up.
    [[nodiscard]] std::size_t end() const { return end_; }
    [[nodiscard]] const std::string& token() const { return token_; }

  private:
    std::size_t end_ = 0;
    std::string token_;
};

}  // namespace

std::string line_place(const std::string& file, std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    return file + ":" + std::to_string(line);
}

Error number_too_large(const std::string& file, std::string_view text) {
    FaultFinder fault;
    static_cast<void>(nlohmann::json::sax_parse(text.begin(), text.end(), &fault));
    const std::size_t begin = fault.end() - std::min(fault.end(), fault.token().size());
    return input_error(
        line_place(file, text, begin),
        "the number " + quote(fault.token()) + " is too large, expected at most 1.8e308");
}

std::string json_line(const nlohmann::json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace weft
