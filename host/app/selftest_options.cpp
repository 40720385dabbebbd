// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/selftest_options.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/command_line.h"
#include "app/device_options.h"
#include "app/parse_values.h"
#include "selftest/case_count.h"

namespace weft {
namespace {

/// Numbers of cases, separated by commas.
std::vector<int> parse_cases(std::string_view text) {
    std::vector<int> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const int number = static_cast<int>(
            parse_unsigned("--cases", text.substr(begin, end - begin), 1, selftest::case_count));
        if (std::find(numbers.begin(), numbers.end(), number) == numbers.end())
            numbers.push_back(number);
        begin = end + 1;
    }
    return numbers;
}

}  // namespace

void add_selftest(CLI::App& app) {
    CLI::App& selftest =
        add_command(app, "selftest", "Renders what has a known answer, and says what came out");
    add_device_choice(selftest,
                      "Only this backend: opencl, embree or native (default: all of them)");
    add_value(selftest, "--cases", "LIST", "Only these cases, such as 3,16 (default: all)");
    add_value(selftest, "--json", "FILE", "Writes the results as JSON, too");
    add_flag(selftest, "--ledger", "Runs nothing: lists all cases as a Markdown table");
}

SelftestOptions read_selftest(const CLI::App& command) {
    SelftestOptions options;
    options.backend = read_backend(command);
    options.device = read_device(command);
    if (const auto text = value_of(command, "--cases")) options.cases = parse_cases(*text);
    if (const auto text = value_of(command, "--json")) options.json = *text;
    options.ledger = is_given(command, "--ledger");
    return options;
}

}  // namespace weft
