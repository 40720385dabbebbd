// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_text.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/quote.h"

namespace weft {
namespace {

constexpr std::string_view blanks = " \t\v\f";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace

std::string_view trim_blanks(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

ObjLines::ObjLines(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
    // Some writers also store the terminating NUL of a C string, before or after the last line
    // ends.
    constexpr std::string_view ends("\0\r\n\t ", 5);
    text_ = text_.substr(0, text_.find_last_not_of(ends) + 1);
    const std::size_t nul = text_.find('\0');
    if (nul != std::string_view::npos) {
        const auto line =
            1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
        throw input_error(file_ + ":" + std::to_string(line),
                          "holds a NUL byte, expected a text file");
    }
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
}

std::string_view ObjLines::next_line() {
    const std::size_t end = std::min(text_.find_first_of("\r\n", offset_), text_.size());
    const std::string_view line = text_.substr(offset_, end - offset_);
    const bool pair = text_.substr(end, 2) == "\r\n";
    offset_ = std::min(end + (pair ? 2 : 1), text_.size());
    ++lines_;
    return line;
}

bool ObjLines::next(ObjStatement& statement) {
    while (offset_ < text_.size()) {
        std::string_view line = trim_blanks(next_line());
        if (line.empty() || line.front() == '#') continue;
        statement.line = lines_;
        if (line.back() == '\\') {
            joined_.clear();
            while (!line.empty() && line.back() == '\\') {
                joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
                line = offset_ < text_.size() ? trim_blanks(next_line()) : std::string_view();
            }
            line = trim_blanks(joined_.append(line));
        }
        if (line.empty()) continue;
        const std::size_t end = std::min(line.find_first_of(blanks), line.size());
        statement.keyword = line.substr(0, end);
        statement.rest = trim_blanks(line.substr(end));
        return true;
    }
    return false;
}

std::string ObjLines::place(const ObjStatement& statement) const {
    return file_ + ":" + std::to_string(statement.line);
}

std::string_view take_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    if (rest.empty() || rest.front() == '#') return {};
    const std::size_t end = std::min(rest.find_first_of(blanks), rest.size());
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(end);
    return word;
}

bool read_obj_number(std::string_view word, double& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const char* const end = word.data() + word.size();
    const auto [stop, code] = std::from_chars(word.data(), end, value);
    // Microsoft's runtime prints infinity and NaN as 1.#INF, -1.#IND00 or 1.#QNAN.
    if (code == std::errc() && stop != end && *stop == '#') {
        value = std::numeric_limits<double>::quiet_NaN();
        return true;
    }
    if (stop != end || code == std::errc::invalid_argument) return false;
    if (code == std::errc::result_out_of_range)
        value =
            word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos
                ? 0.0
                : std::numeric_limits<double>::infinity();
    return true;
}

std::vector<double> read_obj_numbers(std::string_view rest, std::size_t max_count,
                                     const std::string& place) {
    std::vector<double> numbers;
    while (numbers.size() < max_count) {
        const std::string_view word = take_word(rest);
        if (word.empty()) break;
        double value = 0.0;
        if (!read_obj_number(word, value))
            throw input_error(place, "bad number " + quote(word) + ", expected a decimal number");
        numbers.push_back(value);
    }
    return numbers;
}

}  // namespace weft
