// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_PARSE_OPTIONS_H
#define WEFT_TESTS_TESTING_PARSE_OPTIONS_H

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

#include "app/options.h"
#include "base/error.h"

namespace weft::test {

inline ParsedCommand parse(std::initializer_list<const char*> arguments) {
    std::vector<const char*> argv = {"weft"};
    argv.insert(argv.end(), arguments);
    return parse_command_line(static_cast<int>(argv.size()), argv.data());
}

inline RenderOptions render(std::initializer_list<const char*> arguments) {
    std::vector<const char*> argv = {"weft", "render", "scenes/box.gltf"};
    argv.insert(argv.end(), arguments);
    return std::get<RenderOptions>(parse_command_line(static_cast<int>(argv.size()), argv.data()));
}

template <typename Function>
std::string failure(const Function& function) {
    try {
        static_cast<void>(function());
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    return "no failure";
}

/// The message of a command line that must be refused.
inline std::string refusal(std::initializer_list<const char*> arguments) {
    return failure([&] { return parse(arguments); });
}

inline std::string render_refusal(std::initializer_list<const char*> arguments) {
    return failure([&] { return render(arguments); });
}

}  // namespace weft::test

#endif
