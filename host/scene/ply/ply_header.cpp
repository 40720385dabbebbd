// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {

namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

std::vector<std::string_view> split_words(std::string_view line) {
    std::vector<std::string_view> words;
    constexpr std::string_view blanks = " \t\r\v\f";
    std::size_t begin = line.find_first_not_of(blanks);
    while (begin != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(blanks, end);
    }
    return words;
}

class HeaderParser {
  public:
    HeaderParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    PlyHeader parse() {
        if (split_words(next_line()) != std::vector<std::string_view>{"ply"})
            throw error("not a PLY file, expected the first line 'ply'");
        while (true) {
            const std::vector<std::string_view> words = split_words(next_line());
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "end_header") break;
            if (words[0] == "format") {
                parse_format(words);
            } else if (words[0] == "element") {
                parse_element(words);
            } else if (words[0] == "property") {
                parse_property(words);
            } else {
                throw error("unknown header line " + quote(words[0]) +
                            ", expected format, element, property, comment or end_header");
            }
        }
        if (!has_format_) throw error("the header ends without a format line");
        header_.body_offset = offset_;
        header_.lines = line_;
        return std::move(header_);
    }

  private:
    [[nodiscard]] std::string place() const { return fmt::format("{}:{}", file_, line_); }
    [[nodiscard]] Error error(const std::string& message) const {
        return input_error(place(), message);
    }

    std::string_view next_line() {
        ++line_;
        const std::string_view rest = text_.substr(offset_);
        const std::size_t end = rest.substr(0, limits::max_ply_header_line + 1).find('\n');
        if (end == std::string_view::npos) {
            throw error(rest.size() > limits::max_ply_header_line
                            ? "header line too long"
                            : "the file ends inside its header, expected 'end_header'");
        }
        offset_ += end + 1;
        return rest.substr(0, end);
    }

    void parse_format(const std::vector<std::string_view>& words) {
        if (words.size() != 3 || words[2] != "1.0" || has_format_)
            throw error("bad format line, expected one 'format NAME 1.0'");
        if (words[1] == "ascii") {
            header_.format = PlyFormat::ascii;
        } else if (words[1] == "binary_little_endian") {
            header_.format = PlyFormat::little_endian;
        } else if (words[1] == "binary_big_endian") {
            header_.format = PlyFormat::big_endian;
        } else {
            throw error("unknown format " + quote(words[1]) +
                        ", expected ascii, binary_little_endian or binary_big_endian");
        }
        has_format_ = true;
    }

    void parse_element(const std::vector<std::string_view>& words) {
        if (words.size() != 3) throw error("bad element line, expected 'element NAME COUNT'");
        PlyElement element;
        element.name = words[1];
        element.place = place();
        const char* const end = words[2].data() + words[2].size();
        const auto [stop, code] = std::from_chars(words[2].data(), end, element.count);
        if (code != std::errc() || stop != end)
            throw error("bad number of elements " + quote(words[2]) +
                        ", expected a non-negative integer");
        for (const PlyElement& other : header_.elements) {
            if (other.name == element.name)
                throw error("element " + quote(element.name) + " is declared twice");
        }
        count_declaration();
        header_.elements.push_back(std::move(element));
    }

    void parse_property(const std::vector<std::string_view>& words) {
        if (header_.elements.empty())
            throw error("a property before the first element, expected an element line");
        PlyProperty property;
        property.is_list = words.size() > 1 && words[1] == "list";
        const std::size_t expected = property.is_list ? 5 : 3;
        if (words.size() != expected)
            throw error(
                "bad property line, expected 'property TYPE NAME' or "
                "'property list TYPE TYPE NAME'");
        property.name = words.back();
        property.type = parse_type(words[expected - 2]);
        if (property.is_list) {
            property.count_type = parse_type(words[2]);
            if (!ply_is_integer(property.count_type))
                throw error("list lengths of type " + quote(words[2]) +
                            ", expected an integer type");
        }
        std::vector<PlyProperty>& properties = header_.elements.back().properties;
        for (const PlyProperty& other : properties) {
            if (other.name == property.name)
                throw error("property " + quote(property.name) + " is declared twice");
        }
        count_declaration();
        properties.push_back(std::move(property));
    }

    [[nodiscard]] PlyType parse_type(std::string_view word) const {
        for (const auto& [name, type] : type_names) {
            if (name == word) return type;
        }
        throw error("unknown type " + quote(word) + ", expected char to double");
    }

    void count_declaration() {
        if (++declarations_ > limits::max_ply_declarations)
            throw error(
                fmt::format("more than {} elements and properties", limits::max_ply_declarations));
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t offset_ = 0;
    std::size_t line_ = 0;
    std::size_t declarations_ = 0;
    bool has_format_ = false;
    PlyHeader header_;
};

}  // namespace

std::size_t ply_size(PlyType type) {
    static constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

bool ply_is_integer(PlyType type) {
    return type != PlyType::float32 && type != PlyType::float64;
}

PlyHeader parse_ply_header(std::string_view text, const std::string& file) {
    return HeaderParser(text, file).parse();
}

}  // namespace weft
