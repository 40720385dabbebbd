// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <cctype>
#include <vector>

namespace weft {
namespace {

constexpr int most_values = 1 << 20;

}  // namespace

Error usage_error(const std::string& message) {
    return {ExitCode::usage, message};
}

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& description) {
    return *app.add_subcommand(name, description);
}

void add_value(CLI::App& command, const std::string& names, const std::string& value_name,
               const std::string& description) {
    command.add_option(names, description)
        ->type_name(value_name)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_values(CLI::App& command, const std::string& name, const std::string& description) {
    command.add_option(name, description)
        ->type_name("")
        ->expected(1, most_values)
        ->allow_extra_args();
}

void add_flag(CLI::App& command, const std::string& name, const std::string& description) {
    command.add_flag(name, description)->disable_flag_override();
}

void add_scene(CLI::App& command) {
    add_value(command, "SCENE", "",
              "glTF (.gltf, .glb), Mitsuba XML (.xml), OBJ (.obj) or PLY (.ply) scene");
}

void add_verbose(CLI::App& command) {
    add_flag(command, "--verbose", "Names every place of a warning, not only the first");
}

std::optional<std::string> value_of(const CLI::App& command, const std::string& name) {
    const std::vector<std::string>& results = values_of(command, name.c_str());
    if (results.empty()) return std::nullopt;
    if (results.size() > 1) throw usage_error(name + ": is given more than once");
    if (results[0].empty()) throw usage_error(name + ": is empty, expected a value");
    return results[0];
}

const std::vector<std::string>& values_of(const CLI::App& command, const char* name) {
    return command.get_option(name)->results();
}

bool is_given(const CLI::App& command, const std::string& name) {
    return command.count(name) > 0;
}

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

}  // namespace weft
