// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/light_options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/command_line.h"
#include "app/parse_values.h"

namespace weft {
namespace {

constexpr std::array<std::string_view, 2> light_names = {"default", "none"};

}  // namespace

void add_light_choice(CLI::App& command) {
    add_value(command, "--light", "CHOICE",
              "default adds a grey sky and a distant light from above, none never does (default: "
              "where nothing lights the scene)");
}

DefaultLight read_light_choice(const CLI::App& command) {
    const auto text = value_of(command, "--light");
    if (!text) return DefaultLight::as_needed;
    return parse_name("--light", *text, light_names) == 0 ? DefaultLight::always
                                                          : DefaultLight::never;
}

nlohmann::json light_choice_json(DefaultLight choice) {
    if (choice == DefaultLight::as_needed) return nullptr;
    return choice == DefaultLight::always ? light_names[0] : light_names[1];
}

}  // namespace weft
