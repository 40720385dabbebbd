// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/light_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/command_line.h"
#include "app/parse_values.h"
#include "base/shell_word.h"

namespace weft {
namespace {

constexpr std::array<std::string_view, 2> light_names = {"default", "none"};
constexpr double most_degrees = 36000.0;

}  // namespace

void add_lighting(CLI::App& command) {
    add_value(command, "--light", "CHOICE",
              "default adds a grey sky and a distant light from above, none never does (default: "
              "where nothing lights the scene)");
    add_value(command, "--environment", "FILE",
              "Image of the light from all around, .hdr or .exr, +y up (default: the scene's)");
    add_value(command, "--environment-rotation", "DEGREES",
              "Turns that image about +y (default: 0)");
}

SceneReading read_lighting(const CLI::App& command) {
    SceneReading lighting;
    if (const auto text = value_of(command, "--light"))
        lighting.light = parse_name("--light", *text, light_names) == 0 ? DefaultLight::always
                                                                        : DefaultLight::never;
    if (const auto text = value_of(command, "--environment")) lighting.environment = *text;
    if (const auto text = value_of(command, "--environment-rotation"))
        lighting.environment_rotation =
            parse_number("--environment-rotation", *text, -most_degrees, most_degrees);
    return lighting;
}

nlohmann::json light_choice_json(DefaultLight choice) {
    if (choice == DefaultLight::as_needed) return nullptr;
    return choice == DefaultLight::always ? light_names[0] : light_names[1];
}

std::string lighting_arguments(const SceneReading& lighting) {
    std::string line;
    if (lighting.light != DefaultLight::as_needed)
        line += " --light " + light_choice_json(lighting.light).get<std::string>();
    if (!lighting.environment.empty())
        line += " --environment " + shell_file(lighting.environment.string());
    if (lighting.environment_rotation != 0.0)
        line += fmt::format(" --environment-rotation {}", lighting.environment_rotation);
    return line;
}

}  // namespace weft
