// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/reading_options.h"

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
constexpr std::array<std::string_view, 2> detail_names = {"full", "diffuse"};
constexpr double most_degrees = 36000.0;

}  // namespace

void add_reading(CLI::App& command) {
    add_value(command, "--light", "CHOICE",
              "default adds a grey sky and a distant light from above, none never does (default: "
              "where nothing lights the scene)");
    add_value(command, "--environment", "FILE",
              "Image of the light from all around, .hdr or .exr, +y up (default: the scene's)");
    add_value(command, "--environment-rotation", "DEGREES",
              "Turns that image about +y (default: 0)");
    add_value(command, "--materials", "DETAIL",
              "full renders metals, plastics and glass, diffuse everything as diffuse "
              "(default: full)");
}

SceneReading parse_reading(const CLI::App& command) {
    SceneReading reading;
    if (const auto text = value_of(command, "--light"))
        reading.light = parse_name("--light", *text, light_names) == 0 ? DefaultLight::always
                                                                       : DefaultLight::never;
    if (const auto text = value_of(command, "--environment")) reading.environment = *text;
    if (const auto text = value_of(command, "--environment-rotation"))
        reading.environment_rotation =
            parse_number("--environment-rotation", *text, -most_degrees, most_degrees);
    if (const auto text = value_of(command, "--materials"))
        reading.materials =
            static_cast<MaterialDetail>(parse_name("--materials", *text, detail_names));
    return reading;
}

nlohmann::json light_choice_json(DefaultLight choice) {
    if (choice == DefaultLight::as_needed) return nullptr;
    return choice == DefaultLight::always ? light_names[0] : light_names[1];
}

std::string_view material_detail_name(MaterialDetail detail) {
    return detail_names[static_cast<std::size_t>(detail)];
}

std::string reading_arguments(const SceneReading& reading) {
    std::string line;
    if (reading.light != DefaultLight::as_needed)
        line += " --light " + light_choice_json(reading.light).get<std::string>();
    if (!reading.environment.empty())
        line += " --environment " + shell_file(reading.environment.string());
    if (reading.environment_rotation != 0.0)
        line += fmt::format(" --environment-rotation {}", reading.environment_rotation);
    if (reading.materials != MaterialDetail::full)
        line += fmt::format(" --materials {}", material_detail_name(reading.materials));
    return line;
}

}  // namespace weft
