// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_LIGHT_OPTIONS_H
#define WEFT_APP_LIGHT_OPTIONS_H

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scene/load/load_scene.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds --light, --environment and --environment-rotation to a command that reads a scene.
void add_lighting(CLI::App& command);

/// Reads them. Throws Error (exit code 1).
[[nodiscard]] SceneReading read_lighting(const CLI::App& command);

/// The name of --light that the command line uses; null for the choice without the option.
[[nodiscard]] nlohmann::json light_choice_json(DefaultLight choice);

/// Those of the options that were given, each after a blank, as the shell reads them.
[[nodiscard]] std::string lighting_arguments(const SceneReading& lighting);

}  // namespace weft

#endif
