// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/testing/kernel_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

namespace weft {
namespace {

enum class TokenKind { name, number, symbol };

struct Token {
    TokenKind kind;
    std::string_view text;
    int line;
    bool in_directive;
};

bool is_name_char(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}
bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Splits a C source into tokens; comments, strings and character literals are dropped.
class Scanner {
  public:
    explicit Scanner(std::string_view source) : source_(source) {}

    std::vector<Token> scan() {
        while (at_ < source_.size()) step();
        return std::move(tokens_);
    }

  private:
    char peek(std::size_t ahead = 0) const {
        return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0';
    }

    void step() {
        const char c = peek();
        if (c == '\n') {
            ++line_;
            const bool continued = at_ > 0 && source_[at_ - 1] == '\\';
            in_directive_ = in_directive_ && continued;
            line_is_blank_ = true;
            ++at_;
        } else if (c == '/' && peek(1) == '/') {
            at_ = std::min(source_.find('\n', at_), source_.size());
        } else if (c == '/' && peek(1) == '*') {
            skip_block_comment();
        } else if (c == '"' || c == '\'') {
            skip_literal(c);
        } else if (std::isspace(static_cast<unsigned char>(c))) {
            ++at_;
        } else {
            scan_token();
        }
    }

    void skip_block_comment() {
        const std::size_t end = std::min(source_.find("*/", at_ + 2), source_.size());
        for (; at_ < end; ++at_) line_ += peek() == '\n';
        at_ = std::min(at_ + 2, source_.size());
    }

    void skip_literal(char quote) {
        for (++at_; at_ < source_.size() && peek() != quote && peek() != '\n'; ++at_)
            if (peek() == '\\') ++at_;
        if (peek() == quote) ++at_;
    }

    void scan_token() {
        const std::size_t begin = at_;
        TokenKind kind = TokenKind::symbol;
        if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1)))) {
            kind = TokenKind::number;
            while (is_name_char(peek()) || peek() == '.' || is_exponent_sign()) ++at_;
        } else if (is_name_char(peek())) {
            kind = TokenKind::name;
            while (is_name_char(peek())) ++at_;
        } else {
            in_directive_ = in_directive_ || (peek() == '#' && line_is_blank_);
            ++at_;
        }
        line_is_blank_ = false;
        tokens_.push_back({kind, source_.substr(begin, at_ - begin), line_, in_directive_});
    }

    bool is_exponent_sign() const {
        if (peek() != '+' && peek() != '-') return false;
        const char before = source_[at_ - 1];
        return before == 'e' || before == 'E' || before == 'p' || before == 'P';
    }

    std::string_view source_;
    std::size_t at_ = 0;
    int line_ = 1;
    bool in_directive_ = false;
    bool line_is_blank_ = true;
    std::vector<Token> tokens_;
};

bool is_vector_type(std::string_view name) {
    constexpr std::array<std::string_view, 10> scalars = {
        "float", "double", "int", "uint", "char", "uchar", "short", "ushort", "long", "ulong"};
    constexpr std::array<std::string_view, 5> widths = {"2", "3", "4", "8", "16"};
    return std::any_of(scalars.begin(), scalars.end(), [&](std::string_view scalar) {
        if (!name.starts_with(scalar)) return false;
        const std::string_view rest = name.substr(scalar.size());
        return std::find(widths.begin(), widths.end(), rest) != widths.end();
    });
}

/// native_exp, half_sqrt and the like; their accuracy is the device's choice.
bool is_imprecise_function(std::string_view name) {
    constexpr std::array<std::string_view, 14> functions = {
        "cos",   "divide", "exp",   "exp2",  "exp10", "log",  "log2",
        "log10", "powr",   "recip", "rsqrt", "sin",   "sqrt", "tan"};
    for (const std::string_view prefix : {"native_", "half_"})
        if (name.starts_with(prefix))
            return std::find(functions.begin(), functions.end(), name.substr(prefix.size())) !=
                   functions.end();
    return false;
}

bool is_forbidden_name(std::string_view name) {
    constexpr std::array<std::string_view, 11> names = {"barrier",
                                                        "work_group_barrier",
                                                        "mem_fence",
                                                        "read_mem_fence",
                                                        "write_mem_fence",
                                                        "local",
                                                        "__local",
                                                        "printf",
                                                        "double",
                                                        "half",
                                                        "goto"};
    return std::find(names.begin(), names.end(), name) != names.end() ||
           is_imprecise_function(name);
}

/// More than one of .xyzw, or a numbered or halved selection: .xyz .s01 .s3 .lo
bool selects_lanes(std::string_view member) {
    constexpr std::string_view digits = "0123456789";
    if (member == "lo" || member == "hi" || member == "even" || member == "odd") return true;
    if (member.size() < 2) return false;
    if (member.find_first_not_of("xyzw") == std::string_view::npos) return true;
    const std::string_view lanes = member.substr(1);
    if ((member[0] != 's' && member[0] != 'S') ||
        lanes.find_first_not_of("0123456789abcdefABCDEF") != std::string_view::npos)
        return false;
    // A longer name of letters alone is more likely a word, such as seed.
    return lanes.size() == 1 || lanes.find_first_of(digits) != std::string_view::npos;
}

bool is_double_literal(std::string_view number) {
    const bool is_hex = number.starts_with("0x") || number.starts_with("0X");
    const char* const marks = is_hex ? ".pP" : ".eE";
    if (number.find_first_of(marks) == std::string_view::npos) return false;
    return number.back() != 'f' && number.back() != 'F';
}

}  // namespace

std::vector<std::string> kernel_rule_violations(std::string_view source, bool is_shim) {
    const std::vector<Token> tokens = Scanner(source).scan();
    std::vector<std::string> violations;
    const auto report = [&](const Token& token, std::string_view message) {
        violations.push_back(std::to_string(token.line) + ": '" + std::string(token.text) + "' " +
                             std::string(message));
    };
    const auto text = [&](std::size_t i) {
        return i < tokens.size() ? tokens[i].text : std::string_view();
    };
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        if (token.kind == TokenKind::name && is_forbidden_name(token.text))
            report(token, "is not in the kernel language");
        if (token.kind == TokenKind::number && is_double_literal(token.text))
            report(token, "is a double, expected an f at its end");
        if (is_shim) continue;
        if (token.text == "(" && is_vector_type(text(i + 1)) && text(i + 2) == ")" &&
            (text(i + 3) == "(" || text(i + 3) == "{"))
            report(tokens[i + 1], "begins a vector literal, expected a constructor of port.h");
        const bool after_member_access = i > 0 && (text(i - 1) == "." || text(i - 1) == ">");
        if (token.kind == TokenKind::name && after_member_access && selects_lanes(token.text))
            report(token, "selects lanes, expected one of .x .y .z .w or a function of port.h");
        const bool negates_name = token.text == "!" && i + 1 < tokens.size() &&
                                  tokens[i + 1].kind == TokenKind::name && text(i + 2) != "(";
        if (negates_name && !token.in_directive)
            report(tokens[i + 1], "is negated, expected a comparison with 0 or mask_not");
    }
    return violations;
}

}  // namespace weft
