// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_COMMAND_LINE_H
#define WEFT_APP_COMMAND_LINE_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace CLI {
class App;
}

namespace weft {

/// An Error with exit code 1.
[[nodiscard]] Error usage_error(const std::string& message);

// The parser is a header library that takes long to compile, so code that only adds and reads
// options uses these functions instead.

/// Adds a command to the program.
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& description);

/// Adds an option with one value, kept as text: values are read after the whole line is known to be
/// well-formed, so that the first mistake reported is the one the user sees first. A name without
/// dashes is an argument.
void add_value(CLI::App& command, const std::string& names, const std::string& value_name,
               const std::string& description);

/// Adds an argument that takes as many values as are given, up to 2^20.
void add_values(CLI::App& command, const std::string& name, const std::string& description);

/// Adds an option without a value.
void add_flag(CLI::App& command, const std::string& name, const std::string& description);

/// Adds the argument SCENE, the file of a scene.
void add_scene(CLI::App& command);

/// Adds --verbose to a command that reads a scene.
void add_verbose(CLI::App& command);

/// The value given for an option, if any. Throws Error (exit code 1) where there are several, or it
/// is empty.
[[nodiscard]] std::optional<std::string> value_of(const CLI::App& command, const std::string& name);

/// All values given for an option, in their order.
[[nodiscard]] const std::vector<std::string>& values_of(const CLI::App& command, const char* name);

/// Whether an option is given.
[[nodiscard]] bool is_given(const CLI::App& command, const std::string& name);

/// The extension of a file name, in lower case.
[[nodiscard]] std::string extension_of(const std::filesystem::path& path);

}  // namespace weft

#endif
